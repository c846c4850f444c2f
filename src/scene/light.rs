//! The one light.

use super::json::keys::keys;
use super::json::list::{Direction, Vector};
use super::json::object::defaults;
use super::json::range::{ANY, NOT_NEGATIVE};
use crate::math::Vec3;

keys! {
    /// The point light.
    pub struct Light {
        /// Where the light is.
        position: Vec3 => [Vec3::new(0.5, 2.0, 2.0)] Vector(ANY.unit("m")), local;
        /// Radiant intensity in red, green and blue: how strong the light is at a distance of 1 m; it falls with the
        /// square of the distance.
        intensity: Vec3 => [Vec3::repeat(3.0)] Vector(NOT_NEGATIVE);
        /// The tint, red, green and blue, that the `custom` shader gives its highlight and ambient light; no
        /// other shader reads it. It is normalised: `[2, 2, 2]` equals `[1, 1, 1]`.
        color: Vec3 => [Vec3::repeat(1.0)] Direction(NOT_NEGATIVE);
    }
}

impl Default for Light {
    /// The light of a scene file that says nothing about it.
    fn default() -> Self {
        defaults(Self::read)
    }
}
