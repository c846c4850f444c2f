//! Sums what the springs do to each point, in the order in which the springs were created.
//!
//! What each spring does is computed once, a row of one family at a time, and then summed per point:
//! first the point's own springs, then those that end at it, in index order of the points that
//! made them. Those are the right neighbour's, the second to the right's, and of the rows below
//! the left, the middle, the right and the second.

use std::array;
use std::ops::Range;

use super::grid::Grid;
use super::real::Real;
use super::springs::{FAMILIES, Family, SpringKind, Springs};
use super::{Points, filled};
use crate::error::Result;

/// Zeros on either side of a row, so that a neighbour outside the grid adds nothing.
const PAD: usize = 2;

/// One component of what a row's springs do to the points that made them, one array per family.
/// Entry `PAD + i` belongs to column i and is 0 where there is no spring.
type Pulls<T> = [Vec<T>; FAMILIES];

/// The sum over the springs of every point, and room for the springs of three rows.
#[derive(Clone, Debug)]
pub(crate) struct Gather<T> {
    /// The sum on every point.
    pub(crate) sum: Points<T>,
    /// The pulls of row j, by component, in entry j mod 3.
    rows: [[Pulls<T>; 3]; 3],
    /// Adds up the pulls on one row.
    add_up: AddUp<T>,
}

/// Sums one component on a row: out, constant, pulls of its row and the two below.
type AddUp<T> = fn(&mut [T], T, &Pulls<T>, &Pulls<T>, &Pulls<T>);

impl<T: Real> Gather<T> {
    /// Room for the sums over `springs`.
    ///
    /// # Errors
    /// [`crate::error::Kind::Scene`] when it does not fit in memory.
    pub(crate) fn new(springs: &Springs) -> Result<Self> {
        let mut rows: [[Pulls<T>; 3]; 3] =
            array::from_fn(|_| array::from_fn(|_| array::from_fn(|_| Vec::new())));
        for pulls in rows.iter_mut().flatten() {
            for family in &springs.families {
                pulls[family.slot] = filled(springs.grid.width + 2 * PAD, T::default())?;
            }
        }
        Ok(Self { sum: Points::filled(springs.grid.len())?, rows, add_up: add_up_for(springs) })
    }

    /// Sums `constant` and what each spring does to its ends: `pull` computes, for the springs of a
    /// family (its place in `springs.families`) that `n` points from index `a` on made, what each
    /// adds to its own point and takes from its other end.
    pub(crate) fn sum_up(
        &mut self,
        springs: &Springs,
        constant: [T; 3],
        pull: impl Fn(usize, &Family, Range<usize>, [&mut [T]; 3]),
    ) {
        let Grid { width, height } = springs.grid;
        for j in 0..height + 2 {
            self.pull_row(springs, j, &pull);
            if let Some(done) = j.checked_sub(2) {
                self.sum_row(done, done * width..(done + 1) * width, constant);
            }
        }
    }

    /// Computes what the springs do that the points of row `j` made.
    fn pull_row(
        &mut self,
        springs: &Springs,
        j: usize,
        pull: impl Fn(usize, &Family, Range<usize>, [&mut [T]; 3]),
    ) {
        let pulls = &mut self.rows[j % 3];
        for (index, family) in springs.families.iter().enumerate() {
            let out = pulls.each_mut().map(|component| component[family.slot].as_mut_slice());
            if family.rows.contains(&j) {
                let (start, n) = (family.columns.start, family.columns.len());
                let a = j * springs.grid.width + start;
                pull(index, family, a..a + n, out.map(|out| &mut out[PAD + start..][..n]));
            } else {
                out.into_iter().for_each(|component| component.fill(T::default()));
            }
        }
    }

    /// Sums on row `j`, whose points are `points`.
    fn sum_row(&mut self, j: usize, points: Range<usize>, constant: [T; 3]) {
        let [own, below, below2] = [0, 1, 2].map(|rows| &self.rows[(j + rows) % 3]);
        let sum = [&mut self.sum.x, &mut self.sum.y, &mut self.sum.z];
        for (c, sum) in sum.into_iter().enumerate() {
            (self.add_up)(&mut sum[points.clone()], constant[c], &own[c], &below[c], &below2[c]);
        }
    }
}

/// The sum for the kinds that `springs` has.
fn add_up_for<T: Real>(springs: &Springs) -> AddUp<T> {
    let has = |kind| springs.has(kind);
    match (has(SpringKind::Structural), has(SpringKind::Shearing), has(SpringKind::Bending)) {
        (false, false, false) => add_up::<T, false, false, false>,
        (false, false, true) => add_up::<T, false, false, true>,
        (false, true, false) => add_up::<T, false, true, false>,
        (false, true, true) => add_up::<T, false, true, true>,
        (true, false, false) => add_up::<T, true, false, false>,
        (true, false, true) => add_up::<T, true, false, true>,
        (true, true, false) => add_up::<T, true, true, false>,
        (true, true, true) => add_up::<T, true, true, true>,
    }
}

/// Sums one component on a row in creation order.
fn add_up<T: Real, const STRUCTURAL: bool, const SHEARING: bool, const BENDING: bool>(
    out: &mut [T],
    constant: T,
    own: &Pulls<T>,
    below: &Pulls<T>,
    below2: &Pulls<T>,
) {
    let n = out.len();
    let [left, above] = [0, 1].map(|slot| made_by(own, slot, 0, n, STRUCTURAL));
    let [upper_left, upper_right] = [2, 3].map(|slot| made_by(own, slot, 0, n, SHEARING));
    let [left2, above2] = [4, 5].map(|slot| made_by(own, slot, 0, n, BENDING));
    let from_right = made_by(own, 0, 1, n, STRUCTURAL);
    let from_right2 = made_by(own, 4, 2, n, BENDING);
    let from_lower_left = made_by(below, 3, -1, n, SHEARING);
    let from_below = made_by(below, 1, 0, n, STRUCTURAL);
    let from_lower_right = made_by(below, 2, 1, n, SHEARING);
    let from_below2 = made_by(below2, 5, 0, n, BENDING);
    for (i, out) in out.iter_mut().enumerate() {
        let mut f = constant;
        if STRUCTURAL {
            f = f + left[i] + above[i];
        }
        if SHEARING {
            f = f + upper_left[i] + upper_right[i];
        }
        if BENDING {
            f = f + left2[i] + above2[i];
        }
        if STRUCTURAL {
            f = f - from_right[i];
        }
        if BENDING {
            f = f - from_right2[i];
        }
        if SHEARING {
            f = f - from_lower_left[i];
        }
        if STRUCTURAL {
            f = f - from_below[i];
        }
        if SHEARING {
            f = f - from_lower_right[i];
        }
        if BENDING {
            f = f - from_below2[i];
        }
        *out = f;
    }
}

/// The pulls of family `slot` that a row of `n` points gets from the points `right` columns to
/// its right; nothing when the family does not exist.
fn made_by<T>(pulls: &Pulls<T>, slot: usize, right: isize, n: usize, exists: bool) -> &[T] {
    if exists { &pulls[slot][PAD.wrapping_add_signed(right)..][..n] } else { &[] }
}
