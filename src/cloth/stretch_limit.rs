//! Phase 5: the stretch limit of Provot 1995. A spring that is too long is shortened to its limit
//! by moving its ends, in creation order, each seeing what the one before it did.
//!
//! Most springs are not too long, so those of a block of points are first looked at all at once.
//! That keeps every bit: the look sees the positions that the pass would see, and a pass that finds
//! no spring too long moves nothing. It comes right before their turn, or, for a large cloth, on
//! several threads before the pass; then it is repeated where an end may have moved since.

use rayon::prelude::*;

use super::grid::Pins;
use super::springs::{Family, Springs};
use super::{Counters, Points, chunks, filled};
use crate::error::Result;
use crate::lanes::level::dispatch_plain;
use crate::math::dot;
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
    /// Of each family and point, a squared length that every spring over the limit reaches, in m²;
    /// NaN, which nothing reaches, for points without one.
    reach: Vec<Vec<f64>>,
    /// Of each block of a large cloth, whether a spring may be too long before the pass.
    long: Vec<bool>,
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
            let mut squares = filled(springs.grid.len(), f64::NAN)?;
            for a in family.points(springs.grid) {
                squares[a] = (factor * family.rest[a]) * (factor * family.rest[a]) * MARGIN;
            }
            reach.push(squares);
        }
        let points = springs.grid.len();
        let blocks = if points < chunks::MANY { 0 } else { points.div_ceil(BLOCK) };
        Ok(Self { factor, passes, reach, long: filled(blocks, false)? })
    }

    /// Shortens the springs that are too long, in creation order.
    pub(crate) fn apply(&mut self, x: &mut Points, springs: &Springs, pins: &Pins, counters: &mut Counters) {
        for _ in 0..self.passes {
            self.look_ahead(x, springs);
            counters.springs_limited += dispatch_plain!(self.pass(x, springs, pins));
            counters.springs_checked += springs.len() as u64;
        }
    }

    /// Finds the blocks of a large cloth in which a spring may be too long.
    fn look_ahead(&mut self, x: &Points, springs: &Springs) {
        let Self { reach, long, .. } = self;
        let at_once = chunks::POINTS / BLOCK;
        long.par_chunks_mut(at_once).enumerate().for_each(|(chunk, long)| {
            dispatch_plain!(look(x, springs, reach, chunk * at_once, long));
        });
    }

    /// Shortens each spring that is too long, in creation order; how many.
    #[inline(always)]
    fn pass(&self, x: &mut Points, springs: &Springs, pins: &Pins) -> u64 {
        // A spring ends at most two rows above; up to here an end may have moved since the look ahead.
        let two_rows = 2 * springs.grid.width;
        let mut moved_to = if self.long.is_empty() { x.len() } else { 0 };
        let mut count = 0;
        for (block, start) in (0..x.len()).step_by(BLOCK).enumerate() {
            let long =
                if start < moved_to { any_long(x, springs, &self.reach, start) } else { self.long[block] };
            if long {
                let shortened = self.shorten(x, springs, pins, start);
                count += shortened;
                if shortened > 0 {
                    moved_to = moved_to.max(start + BLOCK + two_rows);
                }
            }
        }
        count
    }

    /// Shortens the springs owned by the points from `start` on, up to a block of them; how many.
    fn shorten(&self, x: &mut Points, springs: &Springs, pins: &Pins, start: usize) -> u64 {
        let mut count = 0;
        for a in start..(start + BLOCK).min(x.len()) {
            for (family, reach) in springs.families.iter().zip(&self.reach) {
                // A point without the spring may have no other end.
                let Some(b) = a.checked_sub(family.offset) else { continue };
                let e = x.get(b) - x.get(a);
                let square = dot(e, e);
                if square >= reach[a] {
                    count += u64::from(self.shorten_spring(x, e, square.sqrt(), family, a, pins));
                }
            }
        }
        count
    }

    /// Shortens the spring of `family` that point `a` owns, which has length `l` and leads along
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

/// Looks at the blocks from `first` on: whether a spring in each may be too long.
#[inline(always)]
fn look(x: &Points, springs: &Springs, reach: &[Vec<f64>], first: usize, long: &mut [bool]) {
    for (block, long) in (first..).zip(long) {
        *long = any_long(x, springs, reach, block * BLOCK);
    }
}

/// Whether a spring owned by the points from `start` on, up to a block of them, may be too long.
/// The blocks in the first two rows, where a spring may have no other end, and the last one, if
/// it is not a whole block, always may.
///
/// A spring over its limit reaches its squared length in `reach`: `sqrt(d) > max` after rounding
/// makes d at least max² but for the rounding of two squares and a root, which is far below
/// [`MARGIN`]; the comparison takes equal numbers in, for lengths whose squares are too small
/// for a relative margin.
#[inline(always)]
fn any_long(x: &Points, springs: &Springs, reach: &[Vec<f64>], start: usize) -> bool {
    let [Some(ax), Some(ay), Some(az)] = x.components().map(|component| block(component, start)) else {
        return true;
    };
    let mut any = false;
    for (family, reach) in springs.families.iter().zip(reach) {
        let Some(b) = start.checked_sub(family.offset) else { return true };
        let [Some(bx), Some(by), Some(bz)] = x.components().map(|component| block(component, b)) else {
            return true;
        };
        let Some(reach) = block(reach, start) else { return true };
        for i in 0..BLOCK {
            let (ex, ey, ez) = (bx[i] - ax[i], by[i] - ay[i], bz[i] - az[i]);
            any |= ex * ex + ey * ey + ez * ez >= reach[i];
        }
    }
    any
}

/// The numbers of a block that begins at `start`, if it is a whole one.
#[inline(always)]
fn block(numbers: &[f64], start: usize) -> Option<&[f64; BLOCK]> {
    numbers.get(start..)?.first_chunk()
}
