//! The varyings of a triangle over the window.
//!
//! Barycentric coordinates l are computed in f64 from the unsnapped window positions, rounded
//! once, and weighted with 1/w: a = Σ lᵢ·rᵢ·aᵢ / Σ lᵢ·rᵢ. Inside the triangle all weights are
//! positive, so nothing cancels: the roundings add up to at most 11·2⁻²⁴·max |aᵢ|, and stay below
//! 6·2⁻²⁴·max |aᵢ| in tests against f64 (4.6 is the largest seen).

use super::{
    assemble::Chunk,
    handle::{Handle, unpack},
    setup::Triangle,
    vertex::VertexBuffer,
};
use crate::lanes::Part;

/// What the fragment stage needs besides the list.
pub(super) struct ShadeInput<'a> {
    /// Window position (y up) of the centre of the tile's first pixel.
    pub(super) origin: [f32; 2],
    /// Samples of a pixel.
    pub(super) samples: usize,
    pub(super) chunks: &'a [Chunk],
    pub(super) vertices: &'a VertexBuffer,
}

/// What interpolation needs to know of a triangle.
#[derive(Clone, Copy)]
pub(super) struct Plane<const N: usize> {
    /// Which triangle; 0 is none.
    pub(super) primitive: Handle,
    /// 1/w of each corner.
    pub(super) r: [f32; 3],
    /// Window position of the first corner.
    pub(super) origin: [f64; 2],
    /// What the barycentric coordinates of the second and third corner grow by per pixel right and up.
    pub(super) steps: [[f64; 2]; 2],
    /// Of each corner.
    pub(super) varyings: [[f32; N]; 3],
}

impl<const N: usize> Plane<N> {
    /// That of no triangle.
    pub(super) const NONE: Self =
        Self { primitive: 0, r: [0.0; 3], origin: [0.0; 2], steps: [[0.0; 2]; 2], varyings: [[0.0; N]; 3] };

    /// That of a triangle.
    #[inline(always)]
    pub(super) fn of(input: &ShadeInput<'_>, primitive: Handle) -> Self {
        let mut plane = Self::NONE;
        plane.set(input, primitive);
        plane
    }

    /// Becomes that of a triangle. In place: what is made and then copied is read back in larger pieces than it was
    /// written, and has to wait for all of them.
    #[inline(always)]
    pub(super) fn set(&mut self, input: &ShadeInput<'_>, primitive: Handle) {
        let (chunk, index) = unpack(primitive);
        let chunk = &input.chunks[chunk];
        let Triangle { vertices, scale, .. } = chunk.triangles[index];
        let corner = |vertex: u32| chunk.corner(vertex, input.vertices).window;
        let (a, b, c) = (corner(vertices[0]), corner(vertices[1]), corner(vertices[2]));
        let d = |to: f32, from: f32| f64::from(to) - f64::from(from);
        let step = |gx: f64, gy: f64| [gx * scale, gy * scale];
        self.primitive = primitive;
        self.r = [a.r, b.r, c.r];
        self.origin = [a.x.into(), a.y.into()];
        self.steps = [step(d(c.y, a.y), -d(c.x, a.x)), step(-d(b.y, a.y), d(b.x, a.x))];
        for (varyings, vertex) in self.varyings.iter_mut().zip(vertices) {
            *varyings = *chunk.varyings_of::<N>(vertex, input.vertices);
        }
    }

    /// The varyings at window positions (x, y), as [`weighted`] has them.
    #[inline(always)]
    pub(super) fn interpolate<P: Part>(&self, token: P::Token, [x, y]: [P::Double; 2]) -> Weighted<P, N> {
        let x = x - P::double(token, self.origin[0]);
        let y = y - P::double(token, self.origin[1]);
        let l1 = P::double(token, self.steps[0][0]) * x + P::double(token, self.steps[0][1]) * y;
        let l2 = P::double(token, self.steps[1][0]) * x + P::double(token, self.steps[1][1]) * y;
        let r = self.r.map(
            #[inline(always)]
            |r| P::splat(token, r),
        );
        weighted(
            token,
            [l1, l2],
            r,
            #[inline(always)]
            |corner, k| P::splat(token, self.varyings[corner][k]),
        )
    }
}

/// Varyings times their weights.
#[derive(Clone, Copy)]
pub(super) struct Weighted<P, const N: usize> {
    pub(super) sums: [P; N],
    /// The sum of the weights.
    pub(super) weight: P,
}

impl<P: Part, const N: usize> Weighted<P, N> {
    /// The varyings.
    #[inline(always)]
    pub(super) fn varyings(self, token: P::Token) -> [P; N] {
        let part = P::splat(token, 1.0) / self.weight;
        let mut varyings = self.sums;
        for varying in &mut varyings {
            *varying = *varying * part;
        }
        varyings
    }
}

/// The varyings where the second and third barycentric coordinates are these, from 1/w and number k of each corner.
#[inline(always)]
pub(super) fn weighted<P: Part, const N: usize>(
    token: P::Token,
    [l1, l2]: [P::Double; 2],
    r: [P; 3],
    varying: impl Fn(usize, usize) -> P,
) -> Weighted<P, N> {
    let l0 = P::double(token, 1.0) - l1 - l2;
    let w0 = P::narrow(l0) * r[0];
    let w1 = P::narrow(l1) * r[1];
    let w2 = P::narrow(l2) * r[2];
    let weight = w0 + w1 + w2;
    let mut sums = [weight; N];
    for (k, sum) in sums.iter_mut().enumerate() {
        *sum = w0 * varying(0, k) + w1 * varying(1, k) + w2 * varying(2, k);
    }
    Weighted { sums, weight }
}
