//! Phase 5: the stretch limit of Provot 1995. A spring that is too long is shortened to its limit
//! by moving its ends, in creation order, each seeing what the one before it did.
//!
//! Most springs are not too long, so the springs of a row, and then of a block of its points, are
//! first looked at all at once. That keeps every bit: the look comes right before their turn, so
//! it sees the positions that the pass would see, and a pass that finds no spring too long moves
//! nothing.

use std::ops::Range;

use super::grid::{Grid, Pins};
use super::springs::{Family, Springs};
use super::{Counters, Points, dot, filled};
use crate::dispatch::{Work, dispatch};
use crate::error::Result;
use crate::scene::Vec3;

/// Points in a block.
const BLOCK: usize = 8;

/// Just below 1: covers the rounding of a squared length, so that no long spring is overlooked.
const MARGIN: f64 = 1.0 - 1e-12;

/// The stretch limit of a cloth.
#[derive(Clone, Debug)]
pub(crate) struct StretchLimit {
    /// Largest length of a spring over its rest length.
    factor: f64,
    /// Passes per step.
    passes: u32,
    /// Of each family and point, a squared length that every spring over the limit reaches, in m².
    reach: Vec<Vec<f64>>,
}

impl StretchLimit {
    /// The limit of `springs` to a strain of `limit`, in so many passes a step.
    ///
    /// # Errors
    /// [`crate::error::Kind::Scene`] when it does not fit in memory.
    pub(crate) fn new(limit: f64, passes: u32, springs: &Springs) -> Result<Self> {
        let factor = 1.0 + limit;
        let mut reach = Vec::with_capacity(springs.families.len());
        for family in &springs.families {
            let mut squares = filled(family.rest.len(), 0.0)?;
            for (square, rest) in squares.iter_mut().zip(&family.rest) {
                *square = (factor * rest) * (factor * rest) * MARGIN;
            }
            reach.push(squares);
        }
        Ok(Self { factor, passes, reach })
    }

    /// Shortens the springs that are too long, in creation order.
    pub(crate) fn apply(&self, x: &mut Points, springs: &Springs, pins: &Pins, counters: &mut Counters) {
        for _ in 0..self.passes {
            dispatch(Pass { limit: self, x, springs, pins, counters });
            counters.springs_checked += springs.len() as u64;
        }
    }

    /// Whether a spring made by the points of row `j` and `columns` may be too long.
    #[inline(always)]
    fn any_long(&self, x: &Points, springs: &Springs, j: usize, columns: &Range<usize>) -> bool {
        for (family, reach) in springs.families.iter().zip(&self.reach) {
            let start = columns.start.max(family.columns.start);
            let n = columns.end.min(family.columns.end).saturating_sub(start);
            let row = j * springs.grid.width;
            if family.rows.contains(&j) && any_reaches(x, row + start, family.offset, n, reach) {
                return true;
            }
        }
        false
    }

    /// Shortens the springs made by the points of row `j` and `columns`.
    fn shorten(
        &self,
        x: &mut Points,
        springs: &Springs,
        pins: &Pins,
        j: usize,
        columns: Range<usize>,
        counters: &mut Counters,
    ) {
        for i in columns {
            let a = j * springs.grid.width + i;
            for (family, reach) in springs.families.iter().zip(&self.reach) {
                if family.rows.contains(&j) && family.columns.contains(&i) {
                    let e = x.get(a - family.offset) - x.get(a);
                    let square = dot(e, e);
                    if square >= reach[a] {
                        let moved = self.shorten_spring(x, e, square.sqrt(), family, a, pins);
                        counters.springs_limited += u64::from(moved);
                    }
                }
            }
        }
    }

    /// Shortens the spring of `family` that point `a` made, which has length `l` and leads along
    /// `e` to its other end; whether it was too long and an end could move.
    fn shorten_spring(
        &self,
        x: &mut Points,
        e: Vec3,
        l: f64,
        family: &Family,
        a: usize,
        pins: &Pins,
    ) -> bool {
        let b = a - family.offset;
        let max = self.factor * family.rest[a];
        if l <= max {
            return false;
        }
        let c = e * ((l - max) / l);
        match (pins.pinned[a], pins.pinned[b]) {
            (true, true) => return false,
            (true, false) => x.set(b, x.get(b) - c),
            (false, true) => x.set(a, x.get(a) + c),
            (false, false) => {
                x.set(a, x.get(a) + c * 0.5);
                x.set(b, x.get(b) - c * 0.5);
            }
        }
        true
    }
}

/// One pass over all springs.
struct Pass<'a> {
    limit: &'a StretchLimit,
    x: &'a mut Points,
    springs: &'a Springs,
    pins: &'a Pins,
    counters: &'a mut Counters,
}

impl Work for Pass<'_> {
    #[inline(always)]
    fn run(self) {
        let Self { limit, x, springs, pins, counters } = self;
        let Grid { width, height } = springs.grid;
        for j in 0..height {
            if !limit.any_long(x, springs, j, &(0..width)) {
                continue;
            }
            for start in (0..width).step_by(BLOCK) {
                let columns = start..(start + BLOCK).min(width);
                if limit.any_long(x, springs, j, &columns) {
                    limit.shorten(x, springs, pins, j, columns, counters);
                }
            }
        }
    }
}

/// Whether one of the `n` springs from the points at `a` to those `offset` before them reaches
/// its squared length in `reach`.
///
/// A spring over its limit does: `sqrt(d) > max` after rounding makes d at least max² but for the
/// rounding of two squares and a root, which is far below [`MARGIN`]; the comparison takes equal
/// numbers in, for lengths whose squares are too small for a relative margin.
#[inline(always)]
fn any_reaches(x: &Points, a: usize, offset: usize, n: usize, reach: &[f64]) -> bool {
    if n == 0 {
        return false;
    }
    let b = a - offset;
    let (ax, bx) = (&x.x[a..][..n], &x.x[b..][..n]);
    let (ay, by) = (&x.y[a..][..n], &x.y[b..][..n]);
    let (az, bz) = (&x.z[a..][..n], &x.z[b..][..n]);
    let reach = &reach[a..][..n];
    let mut any = false;
    for i in 0..n {
        let (ex, ey, ez) = (bx[i] - ax[i], by[i] - ay[i], bz[i] - az[i]);
        any |= ex * ex + ey * ey + ez * ez >= reach[i];
    }
    any
}
