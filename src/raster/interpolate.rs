//! Interpolation of varyings at pixel centres, or at a sample of the pixel where the centre may lie outside.

use super::{
    fragments::TILE_SIDE,
    handle::Handle,
    plane::{Plane, ShadeInput},
    samples,
};
use crate::lanes::Part;

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
        if N == 0 {
            return [P::splat(token, 0.0); N];
        }
        let position = self.positions::<P>(token, pixels, places);
        let mut rest = P::lanes_with(token, primitives, primitives[0]);
        let mut result = self.plane(primitives[0]).interpolate::<P>(token, position);
        rest ^= P::ALL_LANES;
        // A bit for each lane that waits for its triangle: no branch that depends on a single lane.
        while rest != 0 {
            let primitive = primitives[rest.trailing_zeros() as usize];
            let at = self.plane(primitive).interpolate::<P>(token, position);
            for (sum, at) in result.sums.iter_mut().zip(at.sums) {
                *sum = sum.replace(primitives, primitive, at);
            }
            result.weight = result.weight.replace(primitives, primitive, at.weight);
            rest &= !P::lanes_with(token, primitives, primitive);
        }
        // Once for all: a division takes long.
        result.varyings(token)
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
            plane.set(self.input, primitive);
        }
        // So that it is read from memory, number by number into all lanes. Otherwise the compiler keeps it in vectors,
        // and shuffles each number out of them.
        std::hint::black_box(plane)
    }
}
