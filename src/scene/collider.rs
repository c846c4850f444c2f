//! The colliders: what the cloth falls on.

use std::ops::{Index, IndexMut};

use serde::{Serialize, Serializer};

use super::{Material, Vec3};

/// The list of colliders: a row is a kind with its key in a scene file and the plural of its name, in the
/// order in which the method handles and draws them. Everything that differs from kind to kind is a `match`
/// without a wildcard elsewhere, so the compiler names what a new row needs.
macro_rules! colliders {
    ($($(#[$doc:meta])* $kind:ident = $key:literal, $plural:literal;)*) => {
        /// Something that the cloth collides with.
        #[derive(Clone, Debug, PartialEq)]
        pub enum Collider {
            $($(#[$doc])* $kind($kind),)*
        }

        /// A kind of collider.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum ColliderKind {
            $($(#[$doc])* $kind,)*
        }

        impl ColliderKind {
            /// Every kind, in the order in which the method handles and draws them.
            pub const ALL: &[Self] = &[$(Self::$kind),*];

            /// The key of a scene file under which colliders of this kind stand.
            pub fn key(self) -> &'static str {
                match self {
                    $(Self::$kind => $key,)*
                }
            }

            /// The name of several of them: also that of their entry in the energy ledger.
            pub fn plural(self) -> &'static str {
                match self {
                    $(Self::$kind => $plural,)*
                }
            }
        }

        impl Collider {
            /// Its kind.
            pub fn kind(&self) -> ColliderKind {
                match self {
                    $(Self::$kind(_) => ColliderKind::$kind,)*
                }
            }

            /// What it looks like.
            pub fn material(&self) -> &Material {
                match self {
                    $(Self::$kind(collider) => &collider.material,)*
                }
            }

            /// What it looks like, to be changed.
            pub fn material_mut(&mut self) -> &mut Material {
                match self {
                    $(Self::$kind(collider) => &mut collider.material,)*
                }
            }

            /// Part of the sliding that contact takes away (0..=1), to be changed.
            pub fn friction_mut(&mut self) -> &mut f64 {
                match self {
                    $(Self::$kind(collider) => &mut collider.friction,)*
                }
            }

            /// Whether the cloth meets both alike: all but what pictures show is equal.
            pub fn collides_like(&self, other: &Self) -> bool {
                match (self, other) {
                    $((Self::$kind(a), Self::$kind(b)) => a.collides_like(b),)*
                    _ => false,
                }
            }
        }
    };
}

colliders! {
    /// An infinite plane.
    Plane = "plane", "planes";
    /// A ball.
    Sphere = "sphere", "spheres";
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

impl Plane {
    fn collides_like(&self, other: &Self) -> bool {
        Self { material: self.material.clone(), ..other.clone() } == *self
    }
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

impl Sphere {
    fn collides_like(&self, other: &Self) -> bool {
        Self { material: self.material.clone(), resolution: self.resolution, ..other.clone() } == *self
    }
}

/// A value for each kind of collider.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PerKind<T>([T; ColliderKind::ALL.len()]);

impl<T: Copy> PerKind<T> {
    /// Each value with the plural of its kind's name.
    pub fn entries(self) -> impl Iterator<Item = (&'static str, T)> {
        ColliderKind::ALL.iter().map(move |&kind| (kind.plural(), self[kind]))
    }
}

impl<T> Index<ColliderKind> for PerKind<T> {
    type Output = T;

    fn index(&self, kind: ColliderKind) -> &T {
        &self.0[kind as usize]
    }
}

impl<T> IndexMut<ColliderKind> for PerKind<T> {
    fn index_mut(&mut self, kind: ColliderKind) -> &mut T {
        &mut self.0[kind as usize]
    }
}

/// As an object with the plurals as keys.
impl<T: Copy + Serialize> Serialize for PerKind<T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.entries())
    }
}
