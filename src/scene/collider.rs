//! The colliders: what the cloth falls on.

use super::Material;
use super::json::key::Row;
use super::json::keys::keys;
use super::json::list::{Counts, Direction, Vector};
use super::json::object::Object;
use super::json::range::{ANY, POSITIVE, from_to};
use super::json::scalar::Count;
use crate::math::Vec3;

/// Largest latitude and longitude count of a ball. 254 such balls and the largest cloth are fewer
/// primitives than the rasteriser can number (see `raster::assemble`).
pub const MAX_RESOLUTION: u32 = 1000;

/// Something that the cloth collides with. A scene lists the planes first, then the spheres, each in
/// file order: that is the order in which the method handles and draws them.
#[derive(Clone, Debug, PartialEq)]
pub enum Collider {
    /// An infinite plane.
    Plane(Plane),
    /// A ball.
    Sphere(Sphere),
}

keys! {
    /// An infinite plane that the cloth collides with, drawn as a square of 4 m.
    pub struct Plane {
        /// A point of the plane; the drawn square is around it.
        point: Vec3 => [required] Vector(ANY.unit("m")), local;
        /// The direction at right angles to the plane, of any length.
        normal: Vec3 => [required] Direction(ANY), local;
        /// Share of the sliding motion that contact removes: 0 is smooth, 1 holds a point where it was a step before.
        friction: f64 => [required] from_to(0.0, 1.0);
        /// What the plane looks like. A key that is left out is as in the scene's `material`.
        material: Material => [inherited] Material::read_grey;
    }
}

keys! {
    /// A ball that the cloth collides with.
    pub struct Sphere {
        /// The centre `[x, y, z]`.
        origin: Vec3 => [required] Vector(ANY.unit("m")), local;
        /// The radius. The drawn ball has 0.92 of it, so that the flat triangles of the cloth do not cut into it.
        radius: f64 => [required] POSITIVE.unit("m");
        /// Share of the sliding motion that contact removes: 0 is smooth, 1 holds a point where it was a step before.
        friction: f64 => [required] from_to(0.0, 1.0);
        /// Latitude and longitude counts of the drawn ball.
        resolution: [u32; 2] => [[40, 40]] Counts(Count(2, MAX_RESOLUTION), Count(3, MAX_RESOLUTION)), local;
        /// What the ball looks like. A key that is left out is as in the scene's `material`.
        material: Material => [inherited] Material::read;
    }
}

const SPHERE: Row = Row::new("sphere", &["A ball that the cloth falls on, or a list of balls."]);
const PLANE: Row = Row::new(
    "plane",
    &[
        "A plane that the cloth falls on, or a list of planes. It has no end, but only a square of 4 m of it is drawn.",
    ],
);

impl Collider {
    /// The keys of a scene file under which colliders stand: one object each, or a list of them.
    pub const KINDS: [&'static str; 2] = ["sphere", "plane"];

    /// Reads the colliders of every kind, each in file order.
    pub(super) fn read_all(at: &mut Object) -> Vec<Self> {
        let spheres = at.each(SPHERE, |at| Self::Sphere(Sphere::read(at)));
        let planes = at.each(PLANE, |at| Self::Plane(Plane::read(at)));
        planes.into_iter().chain(spheres).collect()
    }

    /// The key of a scene file under which colliders of this kind stand.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Plane(_) => "plane",
            Self::Sphere(_) => "sphere",
        }
    }

    /// What it looks like.
    pub fn material(&self) -> &Material {
        match self {
            Self::Plane(plane) => &plane.material,
            Self::Sphere(sphere) => &sphere.material,
        }
    }

    /// What it looks like, to be changed.
    pub fn material_mut(&mut self) -> &mut Material {
        match self {
            Self::Plane(plane) => &mut plane.material,
            Self::Sphere(sphere) => &mut sphere.material,
        }
    }

    /// Part of the sliding that contact takes away (0..=1).
    pub fn friction(&self) -> f64 {
        match self {
            Self::Plane(plane) => plane.friction,
            Self::Sphere(sphere) => sphere.friction,
        }
    }

    /// The same, to be changed.
    pub fn friction_mut(&mut self) -> &mut f64 {
        match self {
            Self::Plane(plane) => &mut plane.friction,
            Self::Sphere(sphere) => &mut sphere.friction,
        }
    }

    /// Whether the cloth meets both alike: all but what pictures show is equal.
    pub fn collides_like(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Plane(a), Self::Plane(b)) => Plane { material: a.material.clone(), ..b.clone() } == *a,
            (Self::Sphere(a), Self::Sphere(b)) => {
                Sphere { material: a.material.clone(), resolution: a.resolution, ..b.clone() } == *a
            }
            (Self::Plane(_) | Self::Sphere(_), _) => false,
        }
    }
}
