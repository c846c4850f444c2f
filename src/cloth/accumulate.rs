//! Adds up what the springs do to each point, in the order in which the springs were created.
//!
//! The owner of a spring is the point of its two ends with the larger index, which created it. Each
//! spring is computed once, a row of one family at a time, and then added to both ends. A point
//! first gets the springs that it owns, then the other springs that end at it, in index order of
//! their owners: the right neighbour, the second to the right, and of the rows below the left, the
//! middle, the right and the second. So the springs owned by a row give the row itself the first part
//! of its sums, the row above the second part, and the row above that the last.
//!
//! Bands of rows are summed on their own: each computes for itself the springs of the two rows
//! below it that end in it.

use std::array;
use std::ops::Range;

use rayon::prelude::*;

use super::chunks::MANY;
use super::grid::Grid;
use super::real::Real;
use super::springs::{FAMILIES, Family, Springs};
use super::{Points, filled};
use crate::error::Result;
use crate::lanes::level::dispatch_plain;

/// Zeros on either side of a row, so that a neighbour outside the grid adds nothing.
const PAD: usize = 2;

/// Rows of a band of a large cloth: few enough that many threads find work, and enough that
/// the springs computed twice, about as many as a row has, are few beside them.
const ROWS: usize = 20;

/// One component of what the springs owned by a row do to their owners, one array per family.
/// Entry `PAD + i` belongs to column i and is 0 where there is no spring.
type Pulls<T> = [Vec<T>; FAMILIES];

/// The sum over the springs of every point.
#[derive(Clone, Debug)]
pub(crate) struct Accumulator<T> {
    /// The sum on every point.
    pub(crate) sum: Points<T>,
    /// Rows of a band.
    rows: usize,
    /// Of each band, room for the pulls of a row, by component.
    bands: Vec<[Pulls<T>; 3]>,
}

impl<T: Real> Accumulator<T> {
    /// Room for the sums over `springs`.
    ///
    /// # Errors
    /// [`crate::error::Kind::Scene`] when it does not fit in memory.
    pub(crate) fn new(springs: &Springs) -> Result<Self> {
        let Grid { width, height } = springs.grid;
        let rows = if springs.grid.len() < MANY { height } else { ROWS };
        let mut pulls: [Pulls<T>; 3] = array::from_fn(|_| array::from_fn(|_| Vec::new()));
        for slot in pulls.iter_mut().flatten() {
            *slot = filled(width + 2 * PAD, T::default())?;
        }
        let bands = filled(height.div_ceil(rows), pulls)?;
        Ok(Self { sum: Points::filled(springs.grid.len())?, rows, bands })
    }

    /// Adds up `constant` and what each spring does to its ends: for the springs of a family (given with its
    /// place in `springs.families`) that a range of points owns, `pull` computes what each spring adds
    /// to its owner and takes from its other end.
    pub(crate) fn accumulate(
        &mut self,
        springs: &Springs,
        constant: [T; 3],
        pull: impl Fn(usize, &Family, Range<usize>, [&mut [T]; 3]) + Sync,
    ) {
        let rows = self.rows;
        let [x, y, z] = self.sum.components_mut().map(|sum| sum.par_chunks_mut(rows * springs.grid.width));
        let bands = self.bands.par_iter_mut().zip(x).zip(y).zip(z).enumerate();
        bands.for_each(|(band, (((pulls, x), y), z))| {
            let (start, end) = (band * rows, (band * rows + rows).min(springs.grid.height));
            let mut band = Band { springs, constant, pull: &pull, rows: start..end, pulls, sum: [x, y, z] };
            dispatch_plain!(band.run());
        });
    }
}

/// The sums on a band of rows.
struct Band<'a, T, P> {
    springs: &'a Springs,
    constant: [T; 3],
    pull: &'a P,
    rows: Range<usize>,
    pulls: &'a mut [Pulls<T>; 3],
    sum: [&'a mut [T]; 3],
}

impl<T: Real, P: Fn(usize, &Family, Range<usize>, [&mut [T]; 3])> Band<'_, T, P> {
    /// Sums the band.
    #[inline(always)]
    fn run(&mut self) {
        for j in self.rows.start..self.springs.grid.height.min(self.rows.end + 2) {
            self.pull_row(j);
            self.sum_row(j);
        }
    }

    /// Computes the springs that are owned by row `j` and end in the band.
    #[inline(always)]
    fn pull_row(&mut self, j: usize) {
        for (index, family) in self.springs.families.iter().enumerate() {
            let out = self.pulls.each_mut().map(|component| component[family.slot].as_mut_slice());
            let up = family.up;
            if j < up {
                out.into_iter().for_each(|component| component.fill(T::default()));
            } else if j - up < self.rows.end {
                let (start, n) = (family.columns.start, family.columns.len());
                let a = j * self.springs.grid.width + start;
                (self.pull)(index, family, a..a + n, out.map(|out| &mut out[PAD + start..][..n]));
            }
        }
    }

    /// Adds the springs that are owned by row `j` to the sums of the band.
    #[inline(always)]
    fn sum_row(&mut self, j: usize) {
        let Self { springs, constant, rows, pulls, sum, .. } = self;
        let width = springs.grid.width;
        let above = |up: usize| {
            let row = j.checked_sub(rows.start + up).filter(|row| *row < rows.len());
            row.map(|row| row * width..(row + 1) * width)
        };
        for ((sum, pulls), constant) in sum.iter_mut().zip(pulls.iter()).zip(*constant) {
            if let Some(row) = above(0) {
                sum_own(&mut sum[row], constant, pulls);
            }
            if let Some(row) = above(1) {
                take_from_above(&mut sum[row], pulls);
            }
            if let Some(row) = above(2) {
                take_from_above2(&mut sum[row], pulls);
            }
        }
    }
}

/// Starts the sums of the row that owns `pulls`.
#[inline(always)]
fn sum_own<T: Real>(sum: &mut [T], constant: T, pulls: &Pulls<T>) {
    let n = sum.len();
    let [left, above, upper_left, upper_right, left2, above2] =
        array::from_fn(|slot| owned_by(pulls, slot, 0, n));
    let (right, right2) = (owned_by(pulls, 0, 1, n), owned_by(pulls, 4, 2, n));
    for (i, sum) in sum.iter_mut().enumerate() {
        let own = constant + left[i] + above[i] + upper_left[i] + upper_right[i] + left2[i] + above2[i];
        *sum = own - right[i] - right2[i];
    }
}

/// Continues the sums of the row above the one that owns `pulls`.
#[inline(always)]
fn take_from_above<T: Real>(sum: &mut [T], pulls: &Pulls<T>) {
    let n = sum.len();
    let (left, middle, right) =
        (owned_by(pulls, 3, -1, n), owned_by(pulls, 1, 0, n), owned_by(pulls, 2, 1, n));
    for (i, sum) in sum.iter_mut().enumerate() {
        *sum = *sum - left[i] - middle[i] - right[i];
    }
}

/// Ends the sums of the second row above the one that owns `pulls`.
#[inline(always)]
fn take_from_above2<T: Real>(sum: &mut [T], pulls: &Pulls<T>) {
    let n = sum.len();
    for (sum, &pull) in sum.iter_mut().zip(owned_by(pulls, 5, 0, n)) {
        *sum -= pull;
    }
}

/// The pulls of family `slot` on a row of `n` points by springs whose owners stand `right` columns to
/// the right.
#[inline(always)]
fn owned_by<T>(pulls: &Pulls<T>, slot: usize, right: isize, n: usize) -> &[T] {
    &pulls[slot][PAD.wrapping_add_signed(right)..][..n]
}
