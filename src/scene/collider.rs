//! The colliders: what the cloth falls on.

use std::ops::{Index, IndexMut};

use serde::{Serialize, Serializer};

use super::Material;
use super::json::key::{Listed, Row};
use super::json::keys::keys;
use super::json::list::{Counts, Direction, Vector};
use super::json::object::Object;
use super::json::range::{ANY, NOT_NEGATIVE, POSITIVE};
use super::json::scalar::Count;
use crate::math::Vec3;

/// Largest latitude and longitude count of a ball. 254 such balls and the largest cloth are fewer
/// primitives than the rasteriser can number (see `raster::handle`).
pub const MAX_RESOLUTION: u32 = 1000;

/// The list of colliders: a row is a kind with its meaning, its key in a scene file and the plural of its
/// name, in the order in which the method handles and draws them. Everything that differs from kind to kind is a `match`
/// without a wildcard elsewhere, so the compiler names what a new row needs.
macro_rules! colliders {
    ($($(#[doc = $doc:literal])* $kind:ident = $key:literal, $plural:literal;)*) => {
        /// Something that the cloth collides with.
        #[derive(Clone, Debug, PartialEq)]
        pub enum Collider {
            $($(#[doc = $doc])* $kind($kind),)*
        }

        /// A kind of collider.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum ColliderKind {
            $($(#[doc = $doc])* $kind,)*
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

            fn row(self) -> Row {
                match self {
                    $(Self::$kind => Row::new($key, &[$($doc),*]),)*
                }
            }

            fn read(self, at: &mut Object) -> Collider {
                match self {
                    $(Self::$kind => Collider::$kind($kind::read(at)),)*
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

            /// Its `friction`.
            pub fn friction(&self) -> f64 {
                match self {
                    $(Self::$kind(collider) => collider.friction,)*
                }
            }

            /// Its `friction`, to be changed.
            pub fn friction_mut(&mut self) -> &mut f64 {
                match self {
                    $(Self::$kind(collider) => &mut collider.friction,)*
                }
            }

            /// Adds every key of its own with its value, below `path`.
            pub(super) fn list(&self, path: &str, list: &mut Vec<(String, serde_json::Value)>) {
                match self {
                    $(Self::$kind(collider) => collider.list(path, list),)*
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
    /// A plane that the cloth falls on, or a list of planes. It has no end, but only a square of 4 m of it is
    /// drawn.
    Plane = "plane", "planes";
    /// A ball that the cloth falls on, or a list of balls.
    Sphere = "sphere", "spheres";
    /// A box that the cloth falls on, or a list of boxes. Its edges lie along the axes.
    Cuboid = "box", "boxes";
}

keys! {
    /// An infinite plane that the cloth collides with, drawn as a square of 4 m.
    pub struct Plane {
        /// A point of the plane; the drawn square is around it.
        point: Vec3 => [required] Vector(ANY.unit("m")), local;
        /// The direction at right angles to the plane, of any length.
        normal: Vec3 => [required] Direction(ANY), local;
        /// Share of the sliding motion that contact removes, 0 to 1: 0 is smooth, 1 holds a point where it was a step
        /// before. With `sim.contact` = `coulomb` the coefficient of friction μ, 0 and up.
        friction: f64 => [required] NOT_NEGATIVE;
        /// What the plane looks like. A key that is left out is as in the scene's `material`.
        material: Material => [inherited] Material::read_grey;
    }
}

impl Plane {
    fn collides_like(&self, other: &Self) -> bool {
        Self { material: self.material.clone(), ..other.clone() } == *self
    }
}

keys! {
    /// A ball that the cloth collides with.
    pub struct Sphere {
        /// The centre `[x, y, z]`.
        origin: Vec3 => [required] Vector(ANY.unit("m")), local;
        /// The radius. The drawn ball has 0.92 of it, so that the flat triangles of the cloth do not cut into it.
        radius: f64 => [required] POSITIVE.unit("m");
        /// Share of the sliding motion that contact removes, 0 to 1: 0 is smooth, 1 holds a point where it was a step
        /// before. With `sim.contact` = `coulomb` the coefficient of friction μ, 0 and up.
        friction: f64 => [required] NOT_NEGATIVE;
        /// Latitude and longitude counts of the drawn ball.
        resolution: [u32; 2] => [[40, 40]] Counts(Count(2, MAX_RESOLUTION), Count(3, MAX_RESOLUTION)), local;
        /// What the ball looks like. A key that is left out is as in the scene's `material`.
        material: Material => [inherited] Material::read;
    }
}

impl Sphere {
    fn collides_like(&self, other: &Self) -> bool {
        Self { material: self.material.clone(), resolution: self.resolution, ..other.clone() } == *self
    }
}

keys! {
    /// A box with edges along the axes, which the cloth collides with.
    pub struct Cuboid {
        /// The centre `[x, y, z]`.
        origin: Vec3 => [required] Vector(ANY.unit("m")), local;
        /// Lengths of the edges along x, y and z.
        size: Vec3 => [required] Vector(POSITIVE.unit("m")), local;
        /// Share of the sliding motion that contact removes, 0 to 1: 0 is smooth, 1 holds a point where it was a step
        /// before. With `sim.contact` = `coulomb` the coefficient of friction μ, 0 and up.
        friction: f64 => [required] NOT_NEGATIVE;
        /// What the box looks like. A key that is left out is as in the scene's `material`.
        material: Material => [inherited] Material::read;
    }
}

impl Cuboid {
    /// The corner with the smallest coordinates and the one with the largest.
    pub fn corners(&self) -> [Vec3; 2] {
        [self.origin - self.size * 0.5, self.origin + self.size * 0.5]
    }

    fn collides_like(&self, other: &Self) -> bool {
        Self { material: self.material.clone(), ..other.clone() } == *self
    }
}

impl Collider {
    /// Reads the colliders of every kind, each in file order. The documentation lists the kinds the other
    /// way round.
    pub(super) fn read_all(at: &mut Object) -> Vec<Self> {
        let kinds = ColliderKind::ALL.iter().rev();
        let mut colliders: Vec<_> = kinds.flat_map(|&kind| at.each(kind.row(), |at| kind.read(at))).collect();
        colliders.sort_by_key(|collider| collider.kind() as usize);
        colliders
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

impl<T> PerKind<T> {
    /// The values in the order of the kinds, to be changed.
    pub(crate) fn values_mut(&mut self) -> impl Iterator<Item = &mut T> {
        self.0.iter_mut()
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
