//! Collisions: of the cloth with the objects of the scene, and of its points with each other.
//!
//! Every object is a variant of [`Collider`] with a file of its own, and the phases of a step go
//! over one list of them, [`Colliders`]. A collider is added as a variant here, a file beside
//! `sphere.rs` that says what [`contact::Shape`] asks, and a row of the scene's list.

pub(crate) use contact::Shape;
use cuboid::Cuboid;
use plane::Plane;

use crate::cloth::grid::Pins;
use crate::cloth::{Counters, Points};
use crate::error::Result;
use crate::scene::{self, ColliderKind, Contact, Scene, Sphere};

mod axis;
mod candidates;
mod cell;
mod cell_list;
mod cell_number;
mod contact;
pub(crate) mod coulomb;
mod cuboid;
mod neighbors;
mod pairs;
mod partners;
mod plane;
mod same_cell;
pub(crate) mod self_collision;
mod separation;
mod slots;
mod sorted;
mod sphere;
mod surroundings;
mod uniform_grid;

/// An object that the cloth collides with, ready for the step.
#[derive(Clone, Debug)]
enum Collider {
    Plane(Plane),
    Sphere(Sphere),
    Cuboid(Cuboid),
}

impl Collider {
    fn shape(&self) -> &dyn Shape {
        match self {
            Self::Plane(plane) => plane,
            Self::Sphere(sphere) => sphere,
            Self::Cuboid(cuboid) => cuboid,
        }
    }
}

/// The objects of a scene in the order in which the cloth collides with them.
#[derive(Clone, Debug)]
pub(crate) struct Colliders {
    list: Vec<(ColliderKind, Collider)>,
    contact: Contact,
}

impl Colliders {
    /// The objects of `scene`, whose cloth starts at `x`.
    ///
    /// # Errors
    /// [`crate::error::Kind::Scene`] when what they remember of each point does not fit in memory.
    pub(crate) fn new(scene: &Scene, x: &Points) -> Result<Self> {
        let contact = scene.sim.contact;
        let kept_outside = (contact != Contact::Report).then_some(x);
        let prepare = |collider: &scene::Collider| {
            let prepared = match collider {
                scene::Collider::Plane(plane) => Collider::Plane(Plane::new(plane, kept_outside)?),
                scene::Collider::Sphere(sphere) => Collider::Sphere(sphere.clone()),
                scene::Collider::Cuboid(cuboid) => Collider::Cuboid(Cuboid::new(cuboid)),
            };
            Ok((collider.kind(), prepared))
        };
        Ok(Self { list: scene.colliders.iter().map(prepare).collect::<Result<_>>()?, contact })
    }

    /// Whether there is none.
    pub(crate) fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    /// How many there are.
    pub(crate) fn len(&self) -> usize {
        self.list.len()
    }

    /// Whether points that hit an object during a step are put on its surface right then.
    pub(crate) fn resolve_hits(&self) -> bool {
        self.contact != Contact::Coulomb && !self.is_empty()
    }

    /// Whether points that are inside an object at the end of a step are put outside.
    pub(crate) fn keep_outside(&self) -> bool {
        self.contact == Contact::Outside && !self.is_empty()
    }

    /// Phase 4 for the objects of one kind: resolves the contacts of every unpinned point. The contacts of
    /// a point depend on that point alone, so each object may come after the other for all points.
    pub(crate) fn resolve(
        &self,
        kind: ColliderKind,
        x: &mut Points,
        last: &Points,
        pins: &Pins,
        counters: &mut Counters,
    ) {
        if self.resolve_hits() {
            self.of(kind).for_each(|shape| shape.resolve_points(x, last, pins, counters));
        }
    }

    /// The end of a step for the objects of one kind: puts every unpinned point outside, if the scene asks
    /// for it.
    pub(crate) fn depenetrate(
        &self,
        kind: ColliderKind,
        x: &mut Points,
        pins: &Pins,
        counters: &mut Counters,
    ) {
        if self.keep_outside() {
            self.of(kind).for_each(|shape| shape.depenetrate_points(x, pins, counters));
        }
    }

    /// What each object is to points, with its kind.
    pub(crate) fn shapes(&self) -> impl Iterator<Item = (ColliderKind, &dyn Shape)> {
        self.list.iter().map(|(kind, collider)| (*kind, collider.shape()))
    }

    /// Puts points that hit a plane so many metres above it, on the side from which they came.
    pub(crate) fn set_plane_offset(&mut self, offset: f64) {
        for (_, collider) in &mut self.list {
            if let Collider::Plane(plane) = collider {
                plane.offset = offset;
            }
        }
    }

    fn of(&self, kind: ColliderKind) -> impl Iterator<Item = &dyn Shape> {
        self.list.iter().filter(move |(of, _)| *of == kind).map(|(_, collider)| collider.shape())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Vec3;

    #[test]
    fn points_leave_on_their_own_side_and_others_stay() {
        let text = r#"{"plane": {"point": [0, 1, 0], "normal": [0, 2, 0], "friction": 0},
                "sphere": {"origin": [1, 2, 3], "radius": 0.5, "friction": 0}, "sim": {"contact": "outside"}}"#;
        let scene = scene::load_text("a.json", text, &Default::default()).unwrap().scene;
        let mut x = Points::zeros(5).unwrap();
        [1.0, 1.5, 0.5, 2.0, 2.0].iter().enumerate().for_each(|(p, &y)| x.set(p, Vec3::new(0.0, y, 0.0)));
        x.set(3, Vec3::new(1.0, 2.0, 3.0));
        x.set(4, Vec3::new(1.0, 2.0, 3.25));
        let colliders = Colliders::new(&scene, &x).unwrap();
        x.set(0, Vec3::new(0.0, 0.9, 0.0));
        x.set(1, Vec3::new(0.0, -3.0, 0.0));
        x.set(2, Vec3::new(0.0, 1.25, 0.0));
        let pins = Pins { pinned: vec![false; 5], free: vec![0..2, 2..5] };
        let mut counters = Counters::default();
        for &kind in ColliderKind::ALL {
            colliders.depenetrate(kind, &mut x, &pins, &mut counters);
        }
        assert!((1.0..1.0 + 1e-13).contains(&x.y[0]) && (1.0..1.0 + 1e-13).contains(&x.y[1]), "above: {x:?}");
        assert!(x.y[2] <= 1.0 && x.y[2] > 1.0 - 1e-13, "below, where it started: {x:?}");
        assert_eq!((x.get(3), x.get(4)), (Vec3::new(1.0, 2.5, 3.0), Vec3::new(1.0, 2.0, 3.5)));
        assert_eq!(counters.object_moves, 5);
    }
}
