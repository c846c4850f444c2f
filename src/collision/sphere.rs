//! The sphere: a point inside it is put on its surface.

use super::contact::{Entry, Shape, may_reach_box};
use crate::math::{dot, length};
use crate::scene::{Sphere, Vec3};

impl Shape for Sphere {
    #[inline(always)]
    fn hit(&self, x: Vec3, _last: Vec3) -> bool {
        let l = length(x - self.origin);
        (0.0 < l) & (l < self.radius)
    }

    fn resolve(&self, x: Vec3, last: Vec3) -> Vec3 {
        let e = x - self.origin;
        let target = self.origin + e * (self.radius / length(e));
        last + (target - last) * (1.0 - self.friction)
    }

    /// From the very centre it goes straight up.
    fn depenetrate(&self, _p: usize, x: Vec3) -> Option<Vec3> {
        let e = x - self.origin;
        let l = length(e);
        if l >= self.radius {
            return None;
        }
        let direction = if l > 0.0 { e / l } else { Vec3::y() };
        Some(self.origin + direction * self.radius)
    }

    /// The first solution of `|e + s way| = radius`, with `e` from the centre to the start.
    fn enter(&self, _p: usize, from: Vec3, way: Vec3) -> Option<Entry> {
        let e = from - self.origin;
        let (distance, approach) = (length(e), dot(e, way));
        if approach >= 0.0 {
            return None;
        }
        // Of the height above the surface, not of squares of the radius: a ball may be large.
        let outside = ((distance - self.radius) * (distance + self.radius)).max(0.0);
        let discriminant = approach * approach - dot(way, way) * outside;
        let part =
            if discriminant < 0.0 { f64::INFINITY } else { outside / (discriminant.sqrt() - approach) };
        (part <= 1.0).then(|| {
            let e = e + way * part;
            let normal = e / length(e);
            Entry { part, point: self.origin + normal * self.radius, normal }
        })
    }

    #[inline(always)]
    fn is_near(&self, _p: usize, from: Vec3, to: Vec3) -> bool {
        let [lower, upper] = [-self.radius, self.radius].map(|radius| self.origin.add_scalar(radius));
        may_reach_box(from, to, lower, upper)
    }

    fn friction(&self) -> f64 {
        self.friction
    }
}
