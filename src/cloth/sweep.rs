//! Phase 1 in one sweep over the rows of a cloth, and what is done with the forces on the way: under Verlet's scheme
//! phase 2. Of the published method it is these lines:
//! - every force starts at the weight; for each spring in creation order `e = x[b] - x[a]`, `l = len(e)`, and
//!   `F = e · (k · (l - l0) / l)` goes to `f[a]` and comes off `f[b]`, unless l = 0;
//! - with what [`Sweep::run`] is given, `new = x + (x - last) · velocity_retention + f · dt² / m`.
//!
//! It adds up what [`super::accumulate`] describes, in the same order. But a force is complete, and is used, three
//! rows after the springs of its point were computed, while everything is still in the cache; and while the CPU divides
//! for the springs of one row, it adds up those of the row before. Rows are copied into buffers that are
//! padded on both sides and to whole chunks of columns, so that borders are no special case: what a column without a
//! spring has there leads to a copy of a neighbour, and its pull is set to zero.
//!
//! At row j come the pulls of the springs that it owns, the first part of the sums on row j - 1, the
//! second of those on row j - 2 and the last of those on row j - 3. Bands of rows are swept on their own: each computes
//! for itself the springs of the two rows below it that end in it.

use std::ops::Range;

use fearless_simd::Simd;
use rayon::prelude::*;

use super::chunks::MANY;
use super::grid::Grid;
use super::row::{LANES, Owned, Rows, own_sum, sums_above};
use super::springs::{FAMILIES, Family, Springs};
use super::{Model, Points, filled};
use crate::error::Result;
use crate::lanes::level::{Narrow, dispatch_narrow};

/// Rows of a band of a large cloth: few enough that many threads find work, and enough that
/// the springs computed twice, about as many as a row has, are few beside them.
const ROWS: usize = 20;

/// Buffers of a band, by component.
#[derive(Clone, Debug)]
struct Buffers {
    /// Positions, in m: in place `j % 3` those of row j.
    x: [Rows; 3],
    /// What springs pull their owners with, in N: in place `j % 2` those of row j, by family.
    pulls: [Rows; 2],
    /// Sums so far, in N: in place `j % 3` those of row j.
    sums: [Rows; 3],
}

/// What of the springs of a family does not change.
#[derive(Clone, Debug)]
struct Fixed {
    /// The length up to which a spring does not pull, in metres: 0, and without end for a column without a spring.
    /// Starts with column 0.
    slack: Vec<f64>,
    /// Rest lengths in the last row, where [`Family::rest`] has no entries for the rest of a chunk.
    last_rest: Vec<f64>,
}

/// The sweep over the rows of a cloth.
#[derive(Clone, Debug)]
pub(crate) struct Sweep {
    /// Rows of a band.
    rows: usize,
    bands: Vec<Buffers>,
    /// As [`Springs::families`].
    fixed: Vec<Fixed>,
}

impl Sweep {
    /// Room for a sweep over `springs`.
    ///
    /// # Errors
    /// [`crate::error::Kind::Scene`] when it does not fit in memory.
    pub(crate) fn new(springs: &Springs) -> Result<Self> {
        let Grid { width, height } = springs.grid;
        let rows = if springs.grid.len() < MANY { height } else { ROWS };
        let three = || Ok([Rows::new(3, width)?, Rows::new(3, width)?, Rows::new(3, width)?]);
        let pulls = || Rows::new(3 * FAMILIES, width);
        let buffers = Buffers { x: three()?, pulls: [pulls()?, pulls()?], sums: three()? };
        let fixed = |family: &Family| Fixed::new(family, springs.grid);
        let fixed = springs.families.iter().map(fixed).collect::<Result<_>>()?;
        Ok(Self { rows, bands: filled(height.div_ceil(rows), buffers)?, fixed })
    }

    /// Computes the force on every point at `x`, its weight and its springs, in N. `finish` gets the forces on
    /// a row by component, with the index of its first point and its entries of `out`.
    pub(crate) fn run(
        &mut self,
        x: &Points,
        Model { springs, params, .. }: Model<'_>,
        out: &mut Points,
        finish: impl Fn(usize, [&[f64]; 3], [&mut [f64]; 3]) + Sync,
    ) {
        let Self { rows, bands, fixed } = self;
        let (rows, weight) = (*rows, params.weight.into());
        let [ox, oy, oz] = out.components_mut().map(|out| out.par_chunks_mut(rows * springs.grid.width));
        let bands = bands.par_iter_mut().zip(ox).zip(oy).zip(oz).enumerate();
        bands.for_each(|(band, (((buffers, ox), oy), oz))| {
            let rows = band * rows..(band * rows + rows).min(springs.grid.height);
            let mut band =
                Band { x, springs, fixed, weight, finish: &finish, rows, buffers, out: [ox, oy, oz] };
            dispatch_narrow!(Narrow::widest(), simd => band.run(simd));
        });
    }
}

impl Fixed {
    fn new(family: &Family, grid: Grid) -> Result<Self> {
        let columns = grid.width.next_multiple_of(LANES);
        let mut slack = filled(columns, f64::INFINITY)?;
        slack[family.columns.clone()].fill(0.0);
        let mut last_rest = filled(columns, 0.0)?;
        last_rest[..grid.width].copy_from_slice(&family.rest[grid.len() - grid.width..]);
        Ok(Self { slack, last_rest })
    }
}

/// The sweep over a band of rows.
struct Band<'a, F> {
    x: &'a Points,
    springs: &'a Springs,
    fixed: &'a [Fixed],
    weight: [f64; 3],
    finish: &'a F,
    rows: Range<usize>,
    buffers: &'a mut Buffers,
    out: [&'a mut [f64]; 3],
}

impl<F: Fn(usize, [&[f64]; 3], [&mut [f64]; 3])> Band<'_, F> {
    /// Sweeps the band.
    #[inline(always)]
    fn run<S: Simd>(&mut self, simd: S) {
        let Range { start, end } = self.rows;
        (start.saturating_sub(2)..start).for_each(|j| self.load(j));
        for j in start..end + 3 {
            if j < self.springs.grid.height {
                self.load(j);
            }
            self.sweep_row(simd, j);
            if j >= start + 3 {
                self.finish(j - 3);
            }
        }
    }

    /// Takes the positions of row `j`.
    #[inline(always)]
    fn load(&mut self, j: usize) {
        let row = j * self.springs.grid.width..(j + 1) * self.springs.grid.width;
        let [x, y, z] = self.x.components();
        let to = &mut self.buffers.x[j % 3];
        to.set(0, &x[row.clone()]);
        to.set(1, &y[row.clone()]);
        to.set(2, &z[row]);
    }

    /// Computes the springs owned by row `j` that end in the band, and adds up those of row j - 1.
    #[inline(always)]
    fn sweep_row<S: Simd>(&mut self, simd: S, j: usize) {
        let Self { springs, fixed, weight, rows, buffers, .. } = self;
        let n = springs.grid.width.div_ceil(LANES);
        let Buffers { x, pulls: [even, odd], sums } = &mut **buffers;
        let (new, old) = if j.is_multiple_of(2) { (even, odd) } else { (odd, even) };
        let [first, second, third] = sums;
        let [own, above, above2] = match j % 3 {
            0 => [third, second, first],
            1 => [first, third, second],
            _ => [second, first, third],
        };
        // Loops, because `for_each` of a range is not sure to be inlined, and then not compiled for the vectors of the CPU.
        for (c, weight) in weight.iter().enumerate() {
            let slot = 2 * c;
            let mut sum = own_sum(simd, n, old, c, *weight, own.chunks_mut(c));
            let band = (*springs, *fixed, rows.end);
            match owned(band, slot, j, x, new) {
                Some(owned) => owned.pull_and(simd, n, sum),
                None => {
                    for i in 0..n {
                        sum(i);
                    }
                }
            }
            let mut sum = sums_above(simd, n, old, c, above.chunks_mut(c), above2.chunks_mut(c));
            match owned(band, slot + 1, j, x, new) {
                Some(owned) => owned.pull_and(simd, n, sum),
                None => {
                    for i in 0..n {
                        sum(i);
                    }
                }
            }
        }
    }

    /// Hands on the forces on row `j`.
    #[inline(always)]
    fn finish(&mut self, j: usize) {
        let width = self.springs.grid.width;
        let sums = &self.buffers.sums[j % 3];
        let sum = [sums.columns(0, width), sums.columns(1, width), sums.columns(2, width)];
        let at = (j - self.rows.start) * width;
        let [x, y, z] = &mut self.out;
        let out = [&mut x[at..][..width], &mut y[at..][..width], &mut z[at..][..width]];
        (self.finish)(j * width, sum, out);
    }
}

/// The springs of family `slot` that are owned by row `j` and end above row `end`, with their places in `pulls`. If there
/// are none, their pulls are zero.
#[inline(always)]
fn owned<'a>(
    (springs, fixed, end): (&'a Springs, &'a [Fixed], usize),
    slot: usize,
    j: usize,
    x: &'a [Rows; 3],
    pulls: &'a mut Rows,
) -> Option<Owned<'a>> {
    let Grid { width, height } = springs.grid;
    let [px, py, pz] = pulls.three_mut(3 * slot);
    let family = springs.families.iter().zip(fixed).find(|(family, _)| family.slot == slot);
    let present = family.filter(|(family, _)| (family.up..height.min(end + family.up)).contains(&j));
    let Some((family, fixed)) = present else {
        px.fill([0.0; LANES]);
        py.fill([0.0; LANES]);
        pz.fill([0.0; LANES]);
        return None;
    };
    let right = -family.left;
    let (a, b) = (&x[j % 3], &x[(j - family.up) % 3]);
    let rest = family.rest.get(j * width..j * width + width.next_multiple_of(LANES));
    Some(Owned {
        k: family.stiffness,
        rest: rest.unwrap_or(&fixed.last_rest).as_chunks().0,
        slack: fixed.slack.as_chunks().0,
        a: [a.chunks(0, 0), a.chunks(1, 0), a.chunks(2, 0)],
        b: [b.chunks(0, right), b.chunks(1, right), b.chunks(2, right)],
        out: [px, py, pz],
    })
}
