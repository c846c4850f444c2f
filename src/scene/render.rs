//! The picture: its size, samples, background and moment.

use super::json::choice::{choice, choices};
use super::json::keys::keys;
use super::json::list::{Counts, Vector};
use super::json::object::defaults;
use super::json::range::{NOT_NEGATIVE, from_to};
use super::json::scalar::{Count, Flag, OneOf};
use crate::math::Vec3;

keys! {
    /// Size, samples, background and moment of the picture.
    pub struct Render {
        /// Width and height of the picture in pixels.
        size: [u32; 2] => [[1024, 800]] Counts(Count(1, 16384), Count(1, 16384)), local;
        /// Samples per pixel: more than 1 smooths edges.
        samples: u32 => [1] OneOf(&[1, 4, 8, 16]);
        /// Colour where nothing is drawn, in red, green and blue from 0 to 1.
        ///
        /// Linear, per channel.
        background: Vec3 => [Vec3::repeat(0.25)] Vector(NOT_NEGATIVE);
        /// Simulated time at which the picture is taken, rounded to a frame.
        time: f64 => [2.0] from_to(0.0, 1e6).unit("s");
        /// How textures are looked up.
        filter: Filter => [Filter::Bilinear] choice::<Filter>();
        /// Whether the pictures of an environment are filtered across the edges where they meet. By default each ends
        /// at its edge, and a smooth environment shows them.
        seamless: bool => [false] Flag;
    }
}

impl Render {
    /// The samples of all pixels.
    pub fn sample_count(&self) -> u64 {
        let [width, height] = self.size.map(u64::from);
        width * height * u64::from(self.samples)
    }
}

choices! {
    /// How textures are looked up (`render.filter`).
    pub enum Filter {
        /// The texel under the point.
        Nearest = "nearest",
        /// Four texels, weighted by their distance.
        Bilinear = "bilinear",
    }
}

impl Default for Render {
    /// The picture of a scene file that says nothing about it.
    fn default() -> Self {
        defaults(Self::read)
    }
}
