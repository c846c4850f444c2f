//! Texture lookup: nearest and bilinear, REPEAT on pictures, CLAMP_TO_EDGE within a cube face.
//!
//! Bilinear weights are exact: x = u·w - 0.5, i = floor(x), f = x - i, then mix along x and y.
//! For texture coordinates in -1..=2, a lookup in f32 is within (w + h + 2)·2⁻²² of the same formula
//! in f64: that is what the rounding of u·w - 0.5 can move the weights by. It is exact for
//! coordinates in 0..=2 where both sides are powers of two, and what is left is 2⁻²¹ (tested).

use std::hint::black_box;

use super::glsl::{Vec3, dot, vec3};
use crate::{
    cubemap::Cubemap,
    lanes::{Lane, WIDTH, Wide},
    scene::Filter,
    texture::Texture,
};

/// `sampler2D` with REPEAT; the first row of the picture is at v = 0.
#[derive(Clone, Copy, Debug)]
pub struct Sampler2d<'a> {
    /// The texels.
    pub texture: &'a Texture,
    /// How texels are combined.
    pub filter: Filter,
}

/// `samplerCube` with CLAMP_TO_EDGE.
#[derive(Clone, Copy, Debug)]
pub struct SamplerCube<'a> {
    /// The six faces.
    pub cubemap: &'a Cubemap,
    /// How texels are combined.
    pub filter: Filter,
}

/// `texture(sampler2D, vec2(u, v)).rgb`
#[inline(always)]
pub fn texture<L: Lane>(sampler: Sampler2d<'_>, u: L, v: L) -> Vec3<L> {
    let Sampler2d { texture, filter } = sampler;
    let size = [texture.width(), texture.height()];
    look_up(filter, [u, v], size, Edge::Repeat, &[texture.texels(); WIDTH])
}

/// `texture(samplerCube, direction).rgb`. Ties between axes: z before y before x. The zero
/// direction (and NaN, and one whose squared length is 0 in f32) reads the middle of the +x face.
#[inline(always)]
pub fn texture_cube<L: Lane>(sampler: SamplerCube<'_>, direction: Vec3<L>) -> Vec3<L> {
    let (face, s, t) = cube_face(direction);
    let (faces, size) = (sampler.cubemap.faces(), sampler.cubemap.size());
    let mut texels = [faces[0].texels(); WIDTH];
    for (texels, face) in texels.iter_mut().zip(face.to_whole().0) {
        *texels = faces[face.cast_unsigned() as usize].texels();
    }
    look_up(sampler.filter, [s, t], [size; 2], Edge::Clamp, &texels)
}

/// Face number (posx, negx, posy, negy, posz, negz) and coordinates (s, t) in 0..=1 of a direction.
#[inline(always)]
fn cube_face<L: Lane>(r: Vec3<L>) -> (L, L, L) {
    let zero = L::splat(0.0);
    let (ax, ay, az) = (r.x.abs(), r.y.abs(), r.z.abs());
    // First +x / -x, then y where it is at least as long, then z where it is as long as both.
    let positive = |component: L, yes: L, no: L| component.select_less(zero, no, yes);
    let mut face = positive(r.x, L::splat(0.0), L::splat(1.0));
    let (mut sc, mut tc, mut ma) = (positive(r.x, -r.z, r.z), -r.y, ax);
    let (y_face, y_tc) = (positive(r.y, L::splat(2.0), L::splat(3.0)), positive(r.y, r.z, -r.z));
    let on_y = |y: L, x: L| ay.select_less(ax, x, y);
    (face, sc, tc, ma) = (on_y(y_face, face), on_y(r.x, sc), on_y(y_tc, tc), on_y(ay, ma));
    let (z_face, z_sc) = (positive(r.z, L::splat(4.0), L::splat(5.0)), positive(r.z, r.x, -r.x));
    let on_z = |z: L, other: L| az.select_less(ma, other, z);
    (face, sc, tc, ma) = (on_z(z_face, face), on_z(z_sc, sc), on_z(-r.y, tc), on_z(az, ma));
    let half = L::splat(0.5);
    let length = dot(r, r);
    let or_middle = |value: L, middle: L| zero.select_less(length, value, middle);
    let coordinate = |c: L| or_middle((c / ma + L::splat(1.0)) * half, half);
    (or_middle(face, zero), coordinate(sc), coordinate(tc))
}

/// A column or row of texels per lane, 0..n.
type Places = Wide<u32>;

/// What lies beyond the edge of a picture.
#[derive(Clone, Copy)]
enum Edge {
    /// REPEAT
    Repeat,
    /// CLAMP_TO_EDGE
    Clamp,
}

/// Filters texels around (u·w, v·h) of each lane's picture.
#[inline(always)]
fn look_up<L: Lane>(
    filter: Filter,
    [u, v]: [L; 2],
    [w, h]: [usize; 2],
    edge: Edge,
    texels: &[&[[f32; 4]]; WIDTH],
) -> Vec3<L> {
    let (w, h) = (side(w), side(h));
    let (x, y) = (u * size(w), v * size(h));
    match filter {
        Filter::Nearest => {
            let ([i, _], [j, _]) = (edge.neighbors(x.floor(), w), edge.neighbors(y.floor(), h));
            gather(texels, w, &i, &j)
        }
        Filter::Bilinear => {
            let (x, y) = (x - L::splat(0.5), y - L::splat(0.5));
            let (i, j) = (x.floor(), y.floor());
            let (fx, fy) = (x - i, y - j);
            let ([i0, i1], [j0, j1]) = (edge.neighbors(i, w), edge.neighbors(j, h));
            let top = mix(gather(texels, w, &i0, &j0), gather(texels, w, &i1, &j0), fx);
            let bottom = mix(gather(texels, w, &i0, &j1), gather(texels, w, &i1, &j1), fx);
            mix(top, bottom, fy)
        }
    }
}

/// `mix(a, b, f)` as a + (b - a)·f, which gives a exactly when a = b.
#[inline(always)]
fn mix<L: Lane>(a: Vec3<L>, b: Vec3<L>, f: L) -> Vec3<L> {
    a + (b - a) * f
}

/// The texel in column i and row j of each lane's picture of width `w`, turned from pixels into channels.
#[inline(always)]
fn gather<L: Lane>(texels: &[&[[f32; 4]]; WIDTH], w: u32, i: &Places, j: &Places) -> Vec3<L> {
    let mut places = Wide([0; WIDTH]);
    for (place, (i, j)) in places.0.iter_mut().zip(i.0.iter().zip(&j.0)) {
        *place = j * w + i;
    }
    // Through memory: computed side by side, then read one by one.
    let places = black_box(places);
    let mut fetched = [[0.0; 4]; WIDTH];
    for (lane, texel) in fetched.iter_mut().enumerate().take(L::LANES) {
        *texel = texels[lane][places.0[lane] as usize];
    }
    let channel = |c: usize| L::from_fn(|lane| fetched[lane][c]);
    vec3(channel(0), channel(1), channel(2))
}

/// A side of a texture as indices are counted.
#[expect(clippy::cast_possible_truncation, reason = "textures are at most 16384 texels wide")]
#[inline(always)]
fn side(n: usize) -> u32 {
    n as u32
}

#[expect(clippy::cast_precision_loss, reason = "textures are at most 16384 texels wide")]
#[inline(always)]
fn size<L: Lane>(n: u32) -> L {
    L::splat(n as f32)
}

impl Edge {
    /// The columns (or rows) i and i + 1, brought into 0..n.
    #[inline(always)]
    fn neighbors<L: Lane>(self, i: L, n: u32) -> [Places; 2] {
        match self {
            Self::Repeat => repeat(i.to_whole(), n),
            Self::Clamp => clamp(i.to_whole(), n),
        }
    }
}

/// The Euclidean modulus of i and of i + 1.
#[inline(always)]
fn repeat(i: Wide<i32>, n: u32) -> [Places; 2] {
    let mut first = i.each(i32::cast_unsigned);
    // Nearly always all are inside; a division costs more than the rest of the look-up.
    if first.0.iter().fold(false, |outside, &i| outside | (i >= n)) {
        first = i.each(|i| i.rem_euclid(n.cast_signed()).cast_unsigned());
    }
    // Through memory, or the compiler goes on with each by itself.
    let first = black_box(first);
    [first, first.each(|i| if i + 1 == n { 0 } else { i + 1 })]
}

/// i and i + 1, clamped.
#[inline(always)]
fn clamp(i: Wide<i32>, n: u32) -> [Places; 2] {
    let last = n.cast_signed() - 1;
    let before = i.each(|i| i.clamp(-1, last));
    [before.each(|i| i.max(0).cast_unsigned()), before.each(|i| (i + 1).min(last).cast_unsigned())]
}
