//! Interpolation over a tile that one triangle covers.

use super::{
    handle::Handle,
    plane::{Plane, ShadeInput, weighted},
};
use crate::lanes::{MAX_PARTS, Part};

/// A triangle over some columns of a tile that it covers. What is the same for all fragments is in all lanes, and what
/// depends on the column alone is computed once.
pub(super) struct Covering<P: Part, const N: usize> {
    /// Of each part of the columns, what the barycentric coordinates of the second and third corner grow by up to there.
    along_row: [[P::Double; 2]; MAX_PARTS],
    /// What they grow by per pixel up.
    steps: [f64; 2],
    /// Window position of the tile's first row, and of the first corner.
    top: [f64; 2],
    /// 1/w of each corner.
    r: [P; 3],
    /// Of each corner.
    varyings: [[P; N]; 3],
}

impl<P: Part, const N: usize> Covering<P, N> {
    /// The triangle over `parts` parts of columns, the first of them at `left`.
    #[inline(always)]
    pub(super) fn of(
        token: P::Token,
        input: &ShadeInput<'_>,
        primitive: Handle,
        left: usize,
        parts: usize,
    ) -> Self {
        let Plane { r, origin, steps: [second, third], varyings, .. } = Plane::<N>::of(input, primitive);
        let mut along_row = [[P::double(token, 0.0); 2]; MAX_PARTS];
        for (i, along_row) in along_row.iter_mut().enumerate().take(parts) {
            let columns = P::double_from_fn(
                token,
                #[inline(always)]
                |lane| (left + i * P::WIDTH + lane) as f64,
            );
            let x = P::double(token, input.origin[0].into()) + columns - P::double(token, origin[0]);
            *along_row = [P::double(token, second[0]) * x, P::double(token, third[0]) * x];
        }
        let mut in_lanes = [[P::splat(token, 0.0); N]; 3];
        for (in_lanes, varying) in in_lanes.iter_mut().flatten().zip(varyings.iter().flatten()) {
            *in_lanes = P::splat(token, *varying);
        }
        let r = [P::splat(token, r[0]), P::splat(token, r[1]), P::splat(token, r[2])];
        let top = [input.origin[1].into(), origin[1]];
        Self { along_row, steps: [second[1], third[1]], top, r, varyings: in_lanes }
    }

    /// The varyings of each part in a row of the tile.
    #[inline(always)]
    pub(super) fn in_row(&self, token: P::Token, row: usize, varyings: &mut [[P; N]]) {
        let y = self.top[0] - row as f64 - self.top[1];
        let down = [P::double(token, self.steps[0] * y), P::double(token, self.steps[1] * y)];
        for (varyings, along_row) in varyings.iter_mut().zip(&self.along_row) {
            let l = [along_row[0] + down[0], along_row[1] + down[1]];
            *varyings = weighted(
                token,
                l,
                self.r,
                #[inline(always)]
                |corner, k| self.varyings[corner][k],
            )
            .varyings(token);
        }
    }
}
