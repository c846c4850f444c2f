//! Texture lookup: nearest and bilinear, REPEAT on pictures (CLAMP_TO_EDGE along v on a ball, whose poles are
//! not neighbours), CLAMP_TO_EDGE within a cube face, or over its edges where that is asked for.
//!
//! Bilinear weights are exact: x = u·w - 0.5, i = floor(x), f = x - i, then mix along x and y.
//! For texture coordinates in -1..=2, a lookup in f32 is within (w + h + 2)·2⁻²² of the same formula
//! in f64: that is what the rounding of u·w - 0.5 can move the weights by. It is exact for
//! coordinates in 0..=2 where both sides are powers of two, and what is left is 2⁻²¹ (tested).

mod look_up;
mod around;
mod cube;

use crate::{
    cubemap::Cubemap,
    glsl::Vec3,
    lanes::{Lane, MAX_WIDTH, Part},
    raster::Uniform,
    scene::Filter,
    texture::Texture,
};
use around::{Around, between_packed, first_of_four, from_first, join, split};
use look_up::{Picture, look_up, side};

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
    let Sampler2d { texture, filter, wrap_v } = sampler;
    let size = [texture.width(), texture.height()];
    if <L::Part as Part>::PACKED
        && filter == Filter::Bilinear
        && let Some(packed) = texture.packed()
        && let Some(rgb) = between_packed(
            size,
            [u, v],
            #[inline(always)]
            |_| Some(packed),
        )
    {
        return rgb.into();
    }
    let mut around = Around::nowhere(u.token());
    if filter == Filter::Bilinear {
        around.find(size, [u, v]);
    }
    let mut rgb = split([u, v, v]);
    for (part, rgb) in rgb.iter_mut().enumerate().take(L::PARTS) {
        let [u, v, _] = *rgb;
        *rgb = if around.holds(part) {
            Part::bilinear(texture.texels(), &around.places[part], around.down, around.weights[part])
        } else {
            look_up(filter, [u, v], size, [Wrap::Repeat, wrap_v], &Picture(texture.texels()))
        };
    }
    join(&rgb)
}

/// `texture(sampler2D, vec2(u, v)).r` at several places, of one part.
#[inline(always)]
pub fn texture_red<P: Part, const K: usize>(sampler: Sampler2d<'_>, at: [[P; 2]; K]) -> [P; K] {
    let Sampler2d { texture, filter, wrap_v } = sampler;
    let size = [texture.width(), texture.height()];
    let (mut places, mut inside, mut weights) = ([[0; MAX_WIDTH]; K], [false; K], at);
    if filter == Filter::Bilinear {
        for k in 0..K {
            (inside[k], weights[k]) = first_of_four(size, from_first(size, at[k]), &mut places[k]);
        }
    }
    std::hint::black_box(&mut places);
    let mut reds = [P::splat(at[0][0].token(), 0.0); K];
    for (k, red) in reds.iter_mut().enumerate() {
        *red = if inside[k] {
            P::bilinear_plane(texture.red(), &places[k], side(size[0]).cast_unsigned(), weights[k])
        } else {
            let picture = Picture(texture.texels());
            let [red, ..] = look_up(filter, at[k], size, [Wrap::Repeat, wrap_v], &picture);
            red
        };
    }
    reds
}
