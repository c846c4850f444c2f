//! Texture lookup: nearest and bilinear, REPEAT on pictures, CLAMP_TO_EDGE within a cube face.
//!
//! Bilinear weights are exact: x = u·w - 0.5, i = floor(x), f = x - i, then mix along x and y.
//! For texture coordinates in -1..=2, a lookup in f32 is within (w + h + 2)·2⁻²² of the same formula
//! in f64: that is what the rounding of u·w - 0.5 can move the weights by. It is exact for
//! coordinates in 0..=2 where both sides are powers of two, and what is left is 2⁻²¹ (tested).

use super::glsl::{Vec3, dot, vec3};
use crate::{
    cubemap::Cubemap,
    lanes::{Lane, WIDTH},
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
    let (w, h) = (sampler.texture.width(), sampler.texture.height());
    look_up(sampler.filter, u, v, w, h, |_, i, j| sampler.texture.texels()[wrap(j, h) * w + wrap(i, w)])
}

/// `texture(samplerCube, direction).rgb`. Ties between axes: z before y before x. The zero
/// direction (and NaN) reads the middle of the +x face.
#[inline(always)]
pub fn texture_cube<L: Lane>(sampler: SamplerCube<'_>, direction: Vec3<L>) -> Vec3<L> {
    let (face, s, t) = cube_face(direction);
    let size = sampler.cubemap.size();
    look_up(sampler.filter, s, t, size, size, |lane, i, j| {
        let texture = &sampler.cubemap.faces()[clamp(to_index(face.lane(lane)), 6)];
        texture.texels()[clamp(j, size) * size + clamp(i, size)]
    })
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

/// Filters `fetch(lane, i, j)` around (u·w, v·h).
#[inline(always)]
fn look_up<L: Lane>(
    filter: Filter,
    u: L,
    v: L,
    w: usize,
    h: usize,
    fetch: impl Fn(usize, i64, i64) -> [f32; 4],
) -> Vec3<L> {
    let (x, y) = (u * size(w), v * size(h));
    match filter {
        Filter::Nearest => {
            let (i, j) = (x.floor(), y.floor());
            gather(|lane| fetch(lane, to_index(i.lane(lane)), to_index(j.lane(lane))))
        }
        Filter::Bilinear => {
            let (x, y) = (x - L::splat(0.5), y - L::splat(0.5));
            let (i, j) = (x.floor(), y.floor());
            let texel = |di: i64, dj: i64| {
                gather(|lane| fetch(lane, to_index(i.lane(lane)) + di, to_index(j.lane(lane)) + dj))
            };
            let (fx, fy) = (x - i, y - j);
            let top = mix(texel(0, 0), texel(1, 0), fx);
            let bottom = mix(texel(0, 1), texel(1, 1), fx);
            mix(top, bottom, fy)
        }
    }
}

/// `mix(a, b, f)` as a + (b - a)·f, which gives a exactly when a = b.
#[inline(always)]
fn mix<L: Lane>(a: Vec3<L>, b: Vec3<L>, f: L) -> Vec3<L> {
    a + (b - a) * f
}

/// One texel per lane, turned from pixels into channels.
#[inline(always)]
fn gather<L: Lane>(fetch: impl Fn(usize) -> [f32; 4]) -> Vec3<L> {
    let mut texels = [[0.0; 4]; WIDTH];
    for (lane, texel) in texels.iter_mut().enumerate().take(L::LANES) {
        *texel = fetch(lane);
    }
    let channel = |c: usize| L::from_fn(|lane| texels[lane][c]);
    vec3(channel(0), channel(1), channel(2))
}

#[expect(clippy::cast_precision_loss, reason = "textures are at most 16384 texels wide")]
fn size<L: Lane>(n: usize) -> L {
    L::splat(n as f32)
}

/// A texel index; anything out of range saturates, NaN becomes 0.
#[expect(clippy::cast_possible_truncation, reason = "saturates at half of the range")]
#[inline(always)]
fn to_index(value: f64) -> i64 {
    i64::from(value as i32)
}

/// REPEAT: the Euclidean modulus.
#[expect(clippy::cast_sign_loss, clippy::cast_possible_truncation, reason = "0 <= result < n")]
#[inline(always)]
fn wrap(i: i64, n: usize) -> usize {
    let n = n as i64;
    if (0..n).contains(&i) { i as usize } else { i.rem_euclid(n) as usize }
}

/// CLAMP_TO_EDGE.
#[expect(clippy::cast_sign_loss, clippy::cast_possible_truncation, reason = "0 <= result < n")]
#[inline(always)]
fn clamp(i: i64, n: usize) -> usize {
    i.clamp(0, n as i64 - 1) as usize
}
