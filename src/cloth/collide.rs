//! The objects: a point that went through a plane, or into a sphere, is put back on the surface,
//! and friction takes away a part of the way from its last position to there.
//!
//! Few points meet an object in a step, so a block of points is first asked all at once whether one
//! of them does. It is the same question, with the same rounding, that is then asked of each.

use std::ops::Range;

use rayon::prelude::*;

use super::grid::Pins;
use super::{Counters, Points, dot, len, pieces};
use crate::dispatch::{Work, dispatch};
use crate::scene::{Plane, Scene, Sphere, Vec3};

/// Height above a plane at which a point is put back, in metres.
pub(crate) const SURFACE_OFFSET: f64 = 1e-4;

/// Points that are asked at once.
const BLOCK: usize = 8;

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
            planes: scene.planes().map(unit).collect(),
            spheres: scene.spheres().cloned().collect(),
            plane_offset: SURFACE_OFFSET,
        }
    }

    /// Resolves the contacts of every unpinned point with the planes. A point's contacts depend
    /// on that point alone, so all planes may come before all spheres.
    pub(crate) fn collide_planes(&self, x: &mut Points, last: &Points, pins: &Pins, counters: &mut Counters) {
        for plane in &self.planes {
            collide(x, last, pins, counters, &Raised { plane, offset: self.plane_offset });
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
            collide(x, last, pins, counters, sphere);
        }
    }
}

/// What points are put back from.
trait Object: Sync {
    /// Whether a point that moved from `last` to `x` met the object.
    fn is_met(&self, x: Vec3, last: Vec3) -> bool;

    /// Where a point ends that met the object on its way from `last` to `x`.
    fn put_back(&self, x: Vec3, last: Vec3) -> Vec3;
}

/// A plane with a unit normal, and the height above it at which points are put back, in metres.
struct Raised<'a> {
    plane: &'a Plane,
    offset: f64,
}

impl Raised<'_> {
    /// The height of `last` above the plane, in metres, and the part of the way from there to `x`
    /// after which the plane is met; not finite for a way along the plane.
    #[inline(always)]
    fn crossing(&self, x: Vec3, last: Vec3) -> (f64, f64) {
        let den = dot(x - last, self.plane.normal);
        let side = dot(last - self.plane.point, self.plane.normal);
        (side, -side / den)
    }
}

impl Object for Raised<'_> {
    #[inline(always)]
    fn is_met(&self, x: Vec3, last: Vec3) -> bool {
        let (_, s) = self.crossing(x, last);
        (0.0..=1.0).contains(&s)
    }

    fn put_back(&self, x: Vec3, last: Vec3) -> Vec3 {
        let Self { plane, offset } = *self;
        let (side, s) = self.crossing(x, last);
        let offset = if side >= 0.0 { offset } else { -offset };
        let target = last + (x - last) * s + plane.normal * offset;
        last + (target - last) * (1.0 - plane.friction)
    }
}

impl Object for Sphere {
    #[inline(always)]
    fn is_met(&self, x: Vec3, _last: Vec3) -> bool {
        let l = len(x - self.origin);
        (0.0 < l) & (l < self.radius)
    }

    fn put_back(&self, x: Vec3, last: Vec3) -> Vec3 {
        let e = x - self.origin;
        let target = self.origin + e * (self.radius / len(e));
        last + (target - last) * (1.0 - self.friction)
    }
}

/// Puts every unpinned point back that met `object`.
fn collide(x: &mut Points, last: &Points, pins: &Pins, counters: &mut Counters, object: &impl Object) {
    let pieces = x.cut_mut().zip(last.cut()).zip(pieces::cut(&pins.pinned));
    let moves = pieces.map(|((x, last), pinned)| {
        let mut moves = 0;
        dispatch(Collide { x, last, pinned, object, moves: &mut moves });
        moves
    });
    counters.object_moves += moves.sum::<u64>();
    counters.object_tests += pins.free_points();
}

/// The phase for one piece of the points and one object.
struct Collide<'a, O> {
    x: [&'a mut [f64]; 3],
    last: [&'a [f64]; 3],
    pinned: &'a [bool],
    object: &'a O,
    moves: &'a mut u64,
}

impl<O: Object> Work for Collide<'_, O> {
    #[inline(always)]
    fn run(mut self) {
        for start in (0..self.pinned.len()).step_by(BLOCK) {
            let block = start..(start + BLOCK).min(self.pinned.len());
            if self.is_met_in(block.clone()) {
                block.for_each(|p| self.collide_point(p));
            }
        }
    }
}

impl<O: Object> Collide<'_, O> {
    /// Whether one of the points `block` met the object.
    #[inline(always)]
    fn is_met_in(&self, block: Range<usize>) -> bool {
        let n = block.len();
        let [x, y, z] = self.x.each_ref().map(|x| &x[block.clone()][..n]);
        let [last_x, last_y, last_z] = self.last.map(|last| &last[block.clone()][..n]);
        let mut any = false;
        for i in 0..n {
            let (x, last) = (Vec3::new(x[i], y[i], z[i]), Vec3::new(last_x[i], last_y[i], last_z[i]));
            any |= self.object.is_met(x, last);
        }
        any
    }

    /// Puts point `p` back if it met the object.
    fn collide_point(&mut self, p: usize) {
        let x = Vec3::from(self.x.each_ref().map(|x| x[p]));
        let last = Vec3::from(self.last.map(|last| last[p]));
        if !self.pinned[p] && self.object.is_met(x, last) {
            let point = self.object.put_back(x, last);
            self.x.iter_mut().zip(&point).for_each(|(x, &to)| x[p] = to);
            *self.moves += 1;
        }
    }
}
