//! Fragment stage: interpolates the varyings at the pixel centre and runs the fragment program.
//!
//! Barycentric coordinates l are computed in f64 from the unsnapped window positions, rounded
//! once, and weighted with 1/w: a = Σ lᵢ·rᵢ·aᵢ / Σ lᵢ·rᵢ. Inside the triangle all weights are
//! positive, so nothing cancels: the error is below 6 ulp of max |aᵢ| (tested against f64).

use super::{
    bin::{Chunk, Handle, place},
    setup::window_area,
    vertex::VertexBuffer,
};
use crate::{
    lanes::{Lane, WIDTH},
    shader::glsl::{FragmentProgram, Vec3, vec3},
};

/// A pixel of a tile that a primitive is seen in.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Fragment {
    /// Place of the pixel in the tile.
    pub(super) pixel: u16,
    /// Samples of the pixel in which the primitive is seen.
    pub(super) weight: u16,
    pub(super) primitive: Handle,
}

/// The fragments of one draw call in one tile, and what is needed to shade them.
pub(super) struct Fragments<'a> {
    pub(super) list: &'a [Fragment],
    /// Window position (y up) of the centre of the tile's first pixel.
    pub(super) origin: [f32; 2],
    pub(super) chunks: &'a [Chunk],
    pub(super) vertices: &'a VertexBuffer,
}

/// Shades all fragments; colours are clamped to 0..=1, NaN is 0.
#[inline(always)]
pub(super) fn shade<L: Lane, const N: usize>(
    fragments: &Fragments<'_>,
    program: &impl FragmentProgram<L, N>,
    colors: &mut Vec<[f32; 3]>,
) {
    for batch in fragments.list.chunks(L::LANES) {
        let color = program(&varyings::<L, N>(fragments, batch));
        let Vec3 { x, y, z } = vec3(clamp(color.x), clamp(color.y), clamp(color.z));
        #[expect(clippy::cast_possible_truncation, reason = "stored colours are made from f32")]
        colors.extend((0..batch.len()).map(|i| [x.lane(i) as f32, y.lane(i) as f32, z.lane(i) as f32]));
    }
}

/// The varyings of up to eight fragments, which may belong to several triangles.
#[inline(always)]
fn varyings<L: Lane, const N: usize>(fragments: &Fragments<'_>, batch: &[Fragment]) -> [L; N] {
    let mut result = [L::splat(0.0); N];
    if N == 0 {
        return result;
    }
    let mut left = [false; WIDTH];
    left[..batch.len()].fill(true);
    let [x0, y0] = fragments.origin.map(<L::Double as Lane>::splat);
    let x = x0 + L::Double::from_fn(|i| f32::from(batch.get(i).map_or(0, |f| f.pixel % 64)));
    let y = y0 - L::Double::from_fn(|i| f32::from(batch.get(i).map_or(0, |f| f.pixel / 64)));
    while let Some(next) = left.iter().position(|&left| left) {
        let primitive = batch[next].primitive;
        let mask = std::array::from_fn(|i| batch.get(i).is_some_and(|f| f.primitive == primitive));
        let at = interpolate::<L, N>(fragments, primitive, x, y);
        for (result, at) in result.iter_mut().zip(at) {
            *result = result.replace(&mask, at);
        }
        for (left, mask) in left.iter_mut().zip(mask) {
            *left &= !mask;
        }
    }
    result
}

/// The varyings of one triangle at window positions (x, y).
#[inline(always)]
fn interpolate<L: Lane, const N: usize>(
    fragments: &Fragments<'_>,
    primitive: Handle,
    x: L::Double,
    y: L::Double,
) -> [L; N] {
    let (chunk, index) = place(primitive);
    let chunk = &fragments.chunks[chunk];
    let triangle = &chunk.triangles[index];
    let [a, b, c] = &triangle.window;
    let d = |to: f32, from: f32| f64::from(to) - f64::from(from);
    let scale = 1.0 / window_area(&triangle.window);
    let plane = |gx: f64, gy: f64| {
        let [gx, gy] = [gx * scale, gy * scale].map(L::splat_double);
        gx * (x - <L::Double as Lane>::splat(a.x)) + gy * (y - <L::Double as Lane>::splat(a.y))
    };
    let l1 = plane(d(c.y, a.y), -d(c.x, a.x));
    let l2 = plane(-d(b.y, a.y), d(b.x, a.x));
    let l0 = <L::Double as Lane>::splat(1.0) - l1 - l2;
    let w0 = L::narrow(l0) * L::splat(a.r);
    let w1 = L::narrow(l1) * L::splat(b.r);
    let w2 = L::narrow(l2) * L::splat(c.r);
    let w = L::splat(1.0) / (w0 + w1 + w2);
    let [a0, a1, a2] = triangle.vertices.map(|v| chunk.varyings_of::<N>(v, fragments.vertices));
    std::array::from_fn(|k| (w0 * L::splat(a0[k]) + w1 * L::splat(a1[k]) + w2 * L::splat(a2[k])) * w)
}

/// Clamps to 0..=1; NaN gives 0.
#[inline(always)]
fn clamp<L: Lane>(x: L) -> L {
    L::splat(1.0).select_less(x, L::splat(1.0), L::splat(0.0).select_less(x, x, L::splat(0.0)))
}
