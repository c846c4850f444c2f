//! Interpolation of varyings at pixel centres, or at a sample of the pixel where the centre may lie outside.
//!
//! Barycentric coordinates l are computed in f64 from the unsnapped window positions, rounded
//! once, and weighted with 1/w: a = Σ lᵢ·rᵢ·aᵢ / Σ lᵢ·rᵢ. Inside the triangle all weights are
//! positive, so nothing cancels: the roundings add up to at most 11·2⁻²⁴·max |aᵢ|, and stay below
//! 6·2⁻²⁴·max |aᵢ| in tests against f64 (4.6 is the largest seen).

use super::{
    assemble::Chunk,
    fragments::TILE_SIDE,
    handle::{Handle, unpack},
    samples,
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

/// Triangles that are kept ready for interpolation: about as many as meet in two rows of a tile.
const PLANES: usize = 32;

/// Interpolates the varyings of fragments of one draw call in one tile.
pub(super) struct Interpolator<'a, const N: usize> {
    input: &'a ShadeInput<'a>,
    planes: [Plane<N>; PLANES],
}

impl<'a, const N: usize> Interpolator<'a, N> {
    #[inline(always)]
    pub(super) fn new(input: &'a ShadeInput<'a>) -> Self {
        Self { input, planes: [Plane::NONE; PLANES] }
    }

    /// The varyings of one part of fragments, which may belong to several triangles.
    #[inline(always)]
    pub(super) fn varyings<P: Part>(
        &mut self,
        token: P::Token,
        pixels: &[u16],
        primitives: &[Handle],
        places: &[u8],
    ) -> [P; N] {
        let mut result = [P::splat(token, 0.0); N];
        if N == 0 {
            return result;
        }
        let position = self.positions::<P>(token, pixels, places);
        let mut rest = P::lanes_with(token, primitives, primitives[0]);
        result = self.plane(primitives[0]).interpolate::<P>(token, position);
        rest ^= P::ALL_LANES;
        // A bit for each lane that waits for its triangle: no branch that depends on a single lane.
        while rest != 0 {
            let primitive = primitives[rest.trailing_zeros() as usize];
            let at = self.plane(primitive).interpolate::<P>(token, position);
            for (result, at) in result.iter_mut().zip(at) {
                *result = result.replace(primitives, primitive, at);
            }
            rest &= !P::lanes_with(token, primitives, primitive);
        }
        result
    }

    /// The window positions of the centres of pixels, or of other `places` in them.
    #[inline(always)]
    fn positions<P: Part>(&self, token: P::Token, pixels: &[u16], places: &[u8]) -> [P::Double; 2] {
        let [x, y] = self.input.origin;
        let columns = P::double_from_fn(
            token,
            #[inline(always)]
            |i| f64::from(pixels[i] % TILE_SIDE),
        );
        let rows = P::double_from_fn(
            token,
            #[inline(always)]
            |i| f64::from(pixels[i] / TILE_SIDE),
        );
        let centres = [P::double(token, x.into()) + columns, P::double(token, y.into()) - rows];
        if places.is_empty() {
            return centres;
        }
        let [right, down] = [0, 1].map(|axis| {
            P::double_from_fn(
                token,
                #[inline(always)]
                |i| self.shift(places[i], axis),
            )
        });
        [centres[0] + right, centres[1] - down]
    }

    /// How far a place is from the pixel's centre, x right and y down, in pixels.
    #[inline(always)]
    fn shift(&self, place: u8, axis: usize) -> f64 {
        let sample = usize::from(place).checked_sub(1);
        let position = sample.map_or(8, |sample| samples::positions(self.input.samples)[sample][axis]);
        f64::from(position - 8) / 16.0
    }

    /// The planes of a triangle.
    #[inline(always)]
    fn plane(&mut self, primitive: Handle) -> &Plane<N> {
        let plane = &mut self.planes[primitive as usize % PLANES];
        if plane.primitive != primitive {
            *plane = Plane::of(self.input, primitive);
        }
        plane
    }
}

/// What interpolation needs to know of a triangle.
#[derive(Clone, Copy)]
struct Plane<const N: usize> {
    /// Which triangle; 0 is none.
    primitive: Handle,
    /// 1/w of each corner.
    r: [f32; 3],
    /// Window position of the first corner.
    origin: [f64; 2],
    /// What the barycentric coordinates of the second and third corner grow by per pixel right and up.
    steps: [[f64; 2]; 2],
    /// Of each corner.
    varyings: [[f32; N]; 3],
}

impl<const N: usize> Plane<N> {
    const NONE: Self =
        Self { primitive: 0, r: [0.0; 3], origin: [0.0; 2], steps: [[0.0; 2]; 2], varyings: [[0.0; N]; 3] };

    #[inline(always)]
    fn of(input: &ShadeInput<'_>, primitive: Handle) -> Self {
        let (chunk, index) = unpack(primitive);
        let chunk = &input.chunks[chunk];
        let Triangle { vertices: [i0, i1, i2], scale, .. } = chunk.triangles[index];
        let corner = |vertex: u32| chunk.corner(vertex, input.vertices).window;
        let (a, b, c) = (corner(i0), corner(i1), corner(i2));
        let d = |to: f32, from: f32| f64::from(to) - f64::from(from);
        let step = |gx: f64, gy: f64| [gx * scale, gy * scale];
        let varyings = |vertex: u32| *chunk.varyings_of::<N>(vertex, input.vertices);
        Self {
            primitive,
            r: [a.r, b.r, c.r],
            origin: [a.x.into(), a.y.into()],
            steps: [step(d(c.y, a.y), -d(c.x, a.x)), step(-d(b.y, a.y), d(b.x, a.x))],
            varyings: [varyings(i0), varyings(i1), varyings(i2)],
        }
    }

    /// The varyings at window positions (x, y).
    #[inline(always)]
    fn interpolate<P: Part>(&self, token: P::Token, [x, y]: [P::Double; 2]) -> [P; N] {
        let x = x - P::double(token, self.origin[0]);
        let y = y - P::double(token, self.origin[1]);
        let l1 = P::double(token, self.steps[0][0]) * x + P::double(token, self.steps[0][1]) * y;
        let l2 = P::double(token, self.steps[1][0]) * x + P::double(token, self.steps[1][1]) * y;
        let l0 = P::double(token, 1.0) - l1 - l2;
        let w0 = P::narrow(l0) * self.r[0];
        let w1 = P::narrow(l1) * self.r[1];
        let w2 = P::narrow(l2) * self.r[2];
        let w = P::splat(token, 1.0) / (w0 + w1 + w2);
        let [a, b, c] = &self.varyings;
        let mut result = [w; N];
        for (k, result) in result.iter_mut().enumerate() {
            *result = (w0 * a[k] + w1 * b[k] + w2 * c[k]) * w;
        }
        result
    }
}
