//! Phase 1 in one sweep over the points of a cloth, and what is done with the forces on the way: under Verlet's scheme
//! phase 2. Of the published method it is these lines:
//! - every force starts at the weight; for each spring in creation order `e = x[b] - x[a]`, `l = len(e)`, and
//!   `F = e · (k · (l - l0) / l)` goes to `f[a]` and comes off `f[b]`, unless l = 0;
//! - with what [`Sweep::run`] is given, `new = x + (x - last) · velocity_retention + f · dt² / m`.
//!
//! It adds up what [`super::accumulate`] describes, in the same order. At the border of the cloth positions are copied, with room
//! beside them, so that a border is no special case: where there is no spring two other points are taken for its ends, and the pull is
//! set to zero. A row ends within a vector of points, and the next begins in it.
//!
//! Bands of rows are swept on their own, so that sums are still in the cache when they are used: each computes for itself
//! the springs of the two rows below it that end in it.

use std::ops::Range;

use fearless_simd::prelude::*;
use fearless_simd::{f64x4, f64x8};
use rayon::prelude::*;

use super::chunks::MANY;
use super::grid::Grid;
use super::springs::{FAMILIES, Springs, TO_SPARE};
use super::stencil::{self, Fixed, Lanes, MOST, Run};
use super::{Model, Points, filled};
use crate::error::Result;
use crate::lanes::level::dispatch;

/// Rows of a band of a large cloth: few enough that many threads find work, and enough that
/// the springs computed twice, about as many as two rows have, are few beside them.
const ROWS: usize = 20;

/// Buffers of a band, by component. Two rows come before its first point, two after its last, and some entries more.
#[derive(Clone, Debug)]
struct Buffers {
    /// Positions, in m; nothing where all these rows are in the cloth.
    x: [Vec<f64>; 3],
    /// Sums so far, in N.
    sums: [Vec<f64>; 3],
}

/// The sweep over the points of a cloth.
#[derive(Clone, Debug)]
pub(crate) struct Sweep {
    /// Rows of a band.
    rows: usize,
    bands: Vec<Buffers>,
}

impl Sweep {
    /// Room for a sweep over `springs`.
    ///
    /// # Errors
    /// [`crate::error::Kind::Scene`] when it does not fit in memory.
    pub(crate) fn new(springs: &Springs) -> Result<Self> {
        let height = springs.grid.height;
        let rows = if springs.grid.len() < MANY { height } else { ROWS };
        let starts = (0..height).step_by(rows);
        let bands = starts.map(|start| Buffers::new(springs.grid, start..(start + rows).min(height)));
        Ok(Self { rows, bands: bands.collect::<Result<_>>()? })
    }

    /// Computes the force on every point at `x`, its weight and its springs, in N. `finish` gets the forces on
    /// consecutive points by component, with the index of the first and their entries of `out`.
    pub(crate) fn run(
        &mut self,
        x: &Points,
        Model { springs, params, .. }: Model<'_>,
        out: &mut Points,
        finish: impl Fn(usize, [&[f64]; 3], [&mut [f64]; 3]) + Sync,
    ) {
        let Self { rows, bands } = self;
        let (rows, weight, grid) = (*rows, params.weight.into(), springs.grid);
        let families = &families(springs);
        let [ox, oy, oz] = out.components_mut().map(|out| out.par_chunks_mut(rows * grid.width));
        let bands = bands.par_iter_mut().zip(ox).zip(oy).zip(oz).enumerate();
        bands.for_each(|(band, (((buffers, ox), oy), oz))| {
            let rows = band * rows..(band * rows + rows).min(grid.height);
            let out = [ox, oy, oz];
            let mut band = Band { x, grid, families, weight, finish: &finish, rows, buffers, out };
            dispatch!(simd => band.run(simd));
        });
    }
}

impl Buffers {
    fn new(grid: Grid, rows: Range<usize>) -> Result<Self> {
        let len = (rows.len() + 4) * grid.width + TO_SPARE;
        let copied = if is_inside(grid, &rows) { 0 } else { len };
        let three = |len| Ok([filled(len, 0.0)?, filled(len, 0.0)?, filled(len, 0.0)?]);
        Ok(Self { x: three(copied)?, sums: three(len)? })
    }
}

/// Whether all that is read for a band of `rows` is in the cloth.
fn is_inside(grid: Grid, rows: &Range<usize>) -> bool {
    rows.start >= 2 && (rows.end + 2) * grid.width + TO_SPARE <= grid.len()
}

/// The families of `springs` by slot.
fn families(springs: &Springs) -> [Fixed<'_>; FAMILIES] {
    let mut families = [Fixed { k: 0.0, rest: &[] }; FAMILIES];
    for family in &springs.families {
        families[family.slot] = Fixed { k: family.stiffness, rest: &family.rest };
    }
    families
}

/// The sweep over a band of rows.
struct Band<'a, F> {
    x: &'a Points,
    grid: Grid,
    families: &'a [Fixed<'a>; FAMILIES],
    weight: [f64; 3],
    finish: &'a F,
    rows: Range<usize>,
    buffers: &'a mut Buffers,
    out: [&'a mut [f64]; 3],
}

impl<F: Fn(usize, [&[f64]; 3], [&mut [f64]; 3])> Band<'_, F> {
    /// Sweeps the band. Eight points at once need vectors of 512 bits: with narrower ones, four are faster.
    #[inline(always)]
    fn run<S: Simd>(&mut self, simd: S) {
        if S::f64s::LEN == MOST {
            self.sweep::<S, f64x8<S>, 8>(simd);
        } else {
            self.sweep::<S, f64x4<S>, 4>(simd);
        }
    }

    /// Sweeps the band, `N` points at once.
    #[inline(always)]
    fn sweep<S: Simd, V: Lanes<S, N>, const N: usize>(&mut self, simd: S) {
        // In the rows after the last of the cloth there are no springs.
        let (start, end) = (self.rows.start, (self.rows.end + 2).min(self.grid.height));
        let width = self.grid.width;
        let run = Run { first: start * width, vectors: ((end - start) * width).div_ceil(N), width };
        let Buffers { x: copies, sums } = &mut *self.buffers;
        let x = if is_inside(self.grid, &self.rows) {
            let first = (start - 2) * width;
            let [x, y, z] = self.x.components();
            [&x[first..], &y[first..], &z[first..]]
        } else {
            copy(self.x, width, start, end, copies)
        };
        stencil::sweep::<S, V, N>(simd, run, x, self.families, self.weight, sums);
        self.finish();
    }

    /// Hands on the forces on the points of the band.
    #[inline(always)]
    fn finish(&mut self) {
        let Range { start, end } = self.rows;
        let width = self.grid.width;
        let places = 2 * width..(end - start + 2) * width;
        let [x, y, z] = &self.buffers.sums;
        let sum = [&x[places.clone()], &y[places.clone()], &z[places]];
        let [x, y, z] = &mut self.out;
        (self.finish)(start * width, sum, [x, y, z]);
    }
}

/// Copies the positions from two rows above row `start` up to row `end`, as many as there are, to where a band that starts there
/// has them.
#[inline(always)]
fn copy<'a>(
    from: &Points,
    width: usize,
    start: usize,
    end: usize,
    to: &'a mut [Vec<f64>; 3],
) -> [&'a [f64]; 3] {
    let first = start.saturating_sub(2);
    let places = (first + 2 - start) * width..(end + 2 - start) * width;
    let points = first * width..end * width;
    let [x, y, z] = from.components();
    let [to_x, to_y, to_z] = to;
    to_x[places.clone()].copy_from_slice(&x[points.clone()]);
    to_y[places.clone()].copy_from_slice(&y[points.clone()]);
    to_z[places].copy_from_slice(&z[points]);
    [to_x, to_y, to_z]
}
