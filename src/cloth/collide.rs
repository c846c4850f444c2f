//! The objects: a point that went through a plane, or into a sphere, is put back on the surface,
//! and friction takes away a part of the way from its last position to there.

use super::grid::Pins;
use super::{Counters, Points, dot, len};
use crate::scene::{Plane, Scene, Sphere, Vec3};

/// Height above a plane at which a point is put back, in metres.
pub(crate) const SURFACE_OFFSET: f64 = 1e-4;

/// The objects of a scene, ready for the step.
#[derive(Clone, Debug)]
pub(crate) struct Objects {
    planes: Vec<Plane>,
    spheres: Vec<Sphere>,
    /// Height above a plane at which a point is put back, in metres.
    pub(crate) plane_offset: f64,
}

impl Objects {
    /// The objects of `scene`. The planes' normals become unit vectors.
    pub(crate) fn new(scene: &Scene) -> Self {
        let unit = |plane: &Plane| Plane { normal: plane.normal / len(plane.normal), ..plane.clone() };
        Self {
            planes: scene.planes.iter().map(unit).collect(),
            spheres: scene.spheres.clone(),
            plane_offset: SURFACE_OFFSET,
        }
    }

    /// Resolves the contacts of every unpinned point with the planes. A point's contacts depend
    /// on that point alone, so all planes may come before all spheres.
    pub(crate) fn collide_planes(&self, x: &mut Points, last: &Points, pins: &Pins, counters: &mut Counters) {
        for plane in &self.planes {
            collide(x, last, pins, counters, |x, last| hit_plane(x, last, plane, self.plane_offset));
        }
    }

    /// Resolves the contacts of every unpinned point with the spheres.
    pub(crate) fn collide_spheres(
        &self,
        x: &mut Points,
        last: &Points,
        pins: &Pins,
        counters: &mut Counters,
    ) {
        for sphere in &self.spheres {
            collide(x, last, pins, counters, |x, last| hit_sphere(x, last, sphere));
        }
    }
}

/// Moves every unpinned point to where `hit` says that it ends, if it does.
fn collide(
    x: &mut Points,
    last: &Points,
    pins: &Pins,
    counters: &mut Counters,
    hit: impl Fn(Vec3, Vec3) -> Option<Vec3>,
) {
    for p in pins.free.iter().cloned().flatten() {
        if let Some(point) = hit(x.get(p), last.get(p)) {
            x.set(p, point);
            counters.object_moves += 1;
        }
    }
    counters.object_tests += pins.free_points();
}

/// Where a point that moved from `last` to `x` ends after it met `plane` (unit normal), if it did.
fn hit_plane(x: Vec3, last: Vec3, plane: &Plane, offset: f64) -> Option<Vec3> {
    let dir = x - last;
    let den = dot(dir, plane.normal);
    if den == 0.0 {
        return None;
    }
    let side = dot(last - plane.point, plane.normal);
    let s = -side / den;
    if !(0.0..=1.0).contains(&s) {
        return None;
    }
    let offset = if side >= 0.0 { offset } else { -offset };
    let target = last + dir * s + plane.normal * offset;
    Some(last + (target - last) * (1.0 - plane.friction))
}

/// Where a point at `x` that came from `last` ends if it is inside `sphere`.
fn hit_sphere(x: Vec3, last: Vec3, sphere: &Sphere) -> Option<Vec3> {
    let e = x - sphere.origin;
    let l = len(e);
    if !(0.0 < l && l < sphere.radius) {
        return None;
    }
    let target = sphere.origin + e * (sphere.radius / l);
    Some(last + (target - last) * (1.0 - sphere.friction))
}
