//! The colliders: what the cloth falls on.

use super::{Material, Vec3};

/// Something that the cloth collides with. A scene lists the planes first, then the spheres, each in
/// file order: that is the order in which the method handles and draws them.
#[derive(Clone, Debug, PartialEq)]
pub enum Collider {
    /// An infinite plane.
    Plane(Plane),
    /// A ball.
    Sphere(Sphere),
}

/// An infinite plane that the cloth collides with, drawn as a square of 4 m.
#[derive(Clone, Debug, PartialEq)]
pub struct Plane {
    /// A point of the plane, in metres.
    pub point: Vec3,
    /// Its normal as the file gives it: any length but 0.
    pub normal: Vec3,
    /// Part of the sliding that contact takes away (0..=1).
    pub friction: f64,
    /// What the plane looks like.
    pub material: Material,
}

/// A ball that the cloth collides with.
#[derive(Clone, Debug, PartialEq)]
pub struct Sphere {
    /// Centre, in metres.
    pub origin: Vec3,
    /// Radius, in metres (> 0).
    pub radius: f64,
    /// Part of the sliding that contact takes away (0..=1).
    pub friction: f64,
    /// Latitude and longitude counts of the drawn mesh (latitude 2..=[`super::MAX_RESOLUTION`],
    /// longitude 3..=[`super::MAX_RESOLUTION`]).
    pub resolution: [u32; 2],
    /// What the ball looks like.
    pub material: Material,
}

impl Collider {
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
