//! The sphere: a point inside it is put on its surface.

use super::contact::Shape;
use crate::cloth::len;
use crate::scene::{Sphere, Vec3};

impl Shape for Sphere {
    #[inline(always)]
    fn hit(&self, x: Vec3, _last: Vec3) -> bool {
        let l = len(x - self.origin);
        (0.0 < l) & (l < self.radius)
    }

    fn resolve(&self, x: Vec3, last: Vec3) -> Vec3 {
        let e = x - self.origin;
        let target = self.origin + e * (self.radius / len(e));
        last + (target - last) * (1.0 - self.friction)
    }

    /// From the very centre it goes straight up.
    fn depenetrate(&self, _p: usize, x: Vec3) -> Option<Vec3> {
        let e = x - self.origin;
        let l = len(e);
        if l >= self.radius {
            return None;
        }
        let direction = if l > 0.0 { e / l } else { Vec3::y() };
        Some(self.origin + direction * self.radius)
    }

    fn lift(&self) -> f64 {
        0.0
    }

    fn depth(&self, x: Vec3) -> f64 {
        (self.radius - len(x - self.origin)).max(0.0)
    }
}
