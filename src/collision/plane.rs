//! The plane: a point that went through it is put back on the side from which it came.

use super::contact::{Entry, ROUNDING, Shape};
use crate::cloth::{Points, filled};
use crate::error::Result;
use crate::math::{dot, length};
use crate::scene::{self, Vec3};

/// Height above a plane at which a point is put, in metres.
const OFFSET: f64 = 1e-4;

/// Lift, relative to the coordinates, that keeps a point above a plane despite rounding.
const LIFT: f64 = 16.0 * f64::EPSILON;

/// A plane, ready for the step.
#[derive(Clone, Debug)]
pub(super) struct Plane {
    point: Vec3,
    /// Its normal, of length 1.
    normal: Vec3,
    friction: f64,
    /// Height above the plane at which a point is put that hit it, in metres.
    pub(super) offset: f64,
    /// Of each point, whether it started above the plane or in it.
    above: Vec<bool>,
}

impl Plane {
    /// The plane of a scene. If points are to be kept outside, they are at `x` at the start, and each belongs
    /// on its side of the plane.
    ///
    /// # Errors
    /// [`crate::error::Kind::Scene`] when the sides do not fit in memory.
    pub(super) fn new(plane: &scene::Plane, kept_outside: Option<&Points>) -> Result<Self> {
        let scene::Plane { point, friction, .. } = *plane;
        let normal = plane.normal / length(plane.normal);
        let mut above = Vec::new();
        if let Some(x) = kept_outside {
            above = filled(x.len(), true)?;
            (0..x.len()).for_each(|p| above[p] = dot(x.get(p) - point, normal) >= 0.0);
        }
        Ok(Self { point, normal, friction, offset: OFFSET, above })
    }

    /// The normal on the side of point `p`.
    fn outward(&self, p: usize) -> Vec3 {
        if self.above[p] { self.normal } else { -self.normal }
    }

    /// The height of `last` above the plane, in metres, and the part of the way from there to `x`
    /// at which it crosses the plane; not finite for a way along the plane.
    #[inline(always)]
    fn crossing(&self, x: Vec3, last: Vec3) -> (f64, f64) {
        let den = dot(x - last, self.normal);
        let side = dot(last - self.point, self.normal);
        (side, -side / den)
    }
}

impl Shape for Plane {
    #[inline(always)]
    fn hit(&self, x: Vec3, last: Vec3) -> bool {
        let (_, s) = self.crossing(x, last);
        (0.0..=1.0).contains(&s)
    }

    fn resolve(&self, x: Vec3, last: Vec3) -> Vec3 {
        let (side, s) = self.crossing(x, last);
        let offset = if side >= 0.0 { self.offset } else { -self.offset };
        let target = last + (x - last) * s + self.normal * offset;
        last + (target - last) * (1.0 - self.friction)
    }

    fn depenetrate(&self, p: usize, x: Vec3) -> Option<Vec3> {
        let normal = self.outward(p);
        let side = dot(x - self.point, normal);
        let lift = LIFT * (x.amax() + self.point.amax());
        (side < 0.0).then(|| x + normal * (lift - side))
    }

    fn enter(&self, p: usize, from: Vec3, way: Vec3) -> Option<Entry> {
        let normal = self.outward(p);
        let (height, change) = (dot(from - self.point, normal), dot(way, normal));
        if change >= 0.0 || height + change >= 0.0 {
            return None;
        }
        let part = height.max(0.0) / -change;
        let point = from + way * part;
        Some(Entry { part, point: self.depenetrate(p, point).unwrap_or(point), normal })
    }

    /// A way ends above the plane or goes through it.
    #[inline(always)]
    fn is_near(&self, p: usize, from: Vec3, to: Vec3) -> bool {
        let height = dot(to - self.point, self.normal);
        let height = if self.above[p] { height } else { -height };
        let sizes = [self.point, from, to].map(|x| x.x.abs() + x.y.abs() + x.z.abs());
        height.is_nan() | (height <= ROUNDING * (sizes[0] + sizes[1] + sizes[2]))
    }

    fn friction(&self) -> f64 {
        self.friction
    }
}
