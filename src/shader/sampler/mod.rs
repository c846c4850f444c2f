//! Texture lookup: nearest and bilinear, REPEAT on pictures (CLAMP_TO_EDGE along v on a ball, whose poles are
//! not neighbours), CLAMP_TO_EDGE within a cube face, or over its edges where that is asked for.
//!
//! Bilinear weights are exact: x = u·w - 0.5, i = floor(x), f = x - i, then mix along x and y.
//! For texture coordinates in -1..=2, a lookup in f32 is within (w + h + 2)·2⁻²² of the same formula
//! in f64: that is what the rounding of u·w - 0.5 can move the weights by. It is exact for
//! coordinates in 0..=2 where both sides are powers of two, and what is left is 2⁻²¹ (tested).

mod look_up;
mod cube;

use crate::{
    cubemap::Cubemap,
    glsl::Vec3,
    lanes::{Lane, Part},
    raster::Uniform,
    scene::Filter,
    texture::Texture,
};
use look_up::{Picture, inside, look_up};

pub use cube::texture_cube;

/// `sampler2D` with REPEAT along u; the first row of the picture is at v = 0.
#[derive(Clone, Copy, Debug)]
pub struct Sampler2d<'a> {
    /// The texels.
    pub texture: &'a Texture,
    /// How texels are combined.
    pub filter: Filter,
    /// What lies above the first row and below the last.
    pub wrap_v: Wrap,
}

/// What lies beyond the edge of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wrap {
    /// The picture again (REPEAT).
    Repeat,
    /// Its last texel (CLAMP_TO_EDGE).
    Clamp,
}

/// `samplerCube` with CLAMP_TO_EDGE.
#[derive(Clone, Copy, Debug)]
pub struct SamplerCube<'a> {
    /// The six faces.
    pub cubemap: &'a Cubemap,
    /// How texels are combined.
    pub filter: Filter,
    /// Whether the texels beyond an edge are those of the next face (TEXTURE_CUBE_MAP_SEAMLESS).
    pub seamless: bool,
}

impl<'a> Uniform for Sampler2d<'a> {
    type In<L: Lane> = Self;
    #[inline(always)]
    fn in_lanes<L: Lane>(&self, _token: L::Token) -> Self {
        *self
    }
}

impl<'a> Uniform for SamplerCube<'a> {
    type In<L: Lane> = Self;
    #[inline(always)]
    fn in_lanes<L: Lane>(&self, _token: L::Token) -> Self {
        *self
    }
}

/// `texture(sampler2D, vec2(u, v)).rgb`
#[inline(always)]
pub fn texture<L: Lane>(sampler: Sampler2d<'_>, [u, v]: [L; 2]) -> Vec3<L> {
    let rgb = L::map_parts(
        [u, v, v],
        #[inline(always)]
        |[u, v, _]| picture_texel(sampler, [u, v]),
    );
    Vec3::from(rgb)
}

/// `texture` of one part.
#[inline(always)]
fn picture_texel<P: Part>(sampler: Sampler2d<'_>, [u, v]: [P; 2]) -> [P; 3] {
    let Sampler2d { texture, filter, wrap_v } = sampler;
    let size = [texture.width(), texture.height()];
    if filter == Filter::Bilinear
        && let Some((places, down, weights)) = inside(size, [u, v])
    {
        return P::bilinear(texture.for_look_ups(P::PACKED), places, down, weights);
    }
    look_up(filter, [u, v], size, [Wrap::Repeat, wrap_v], &Picture(texture.texels()))
}

/// `texture(sampler2D, vec2(u, v)).r`, of one part.
#[inline(always)]
pub fn texture_red<P: Part>(sampler: Sampler2d<'_>, [u, v]: [P; 2]) -> P {
    let Sampler2d { texture, filter, wrap_v } = sampler;
    let size = [texture.width(), texture.height()];
    if filter == Filter::Bilinear
        && let Some((places, down, weights)) = inside(size, [u, v])
    {
        return P::bilinear_plane(texture.red(), places, down, weights);
    }
    let [red, ..] = look_up(filter, [u, v], size, [Wrap::Repeat, wrap_v], &Picture(texture.texels()));
    red
}
