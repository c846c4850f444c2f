//! The pairs of points that may come close during self-collision, among those in the same or in neighbouring cells.
//!
//! Points are taken in the order of their cells (`sorted.rs`). Each looks for others in the ranges of that order around
//! its cell that `surroundings.rs` finds. Of both points of a pair only the one that comes first in the order looks for
//! the other.
//!
//! Mostly no pair is found, and few ranges have more than four points. So the four points from the beginning of every range
//! on are compared at once, whether the range has so many or not, and one question is asked for all ranges: is any of
//! these points close? Only then it is asked which, and whether they are in the range. The rest of longer ranges
//! comes after that, so all points of all ranges are compared.
//!
//! Where the pairs are used, their order does not count. So parts of a large cloth look for theirs side by side.

use std::ops::Range;

use fearless_simd::prelude::*;
use fearless_simd::{f64x4, mask64x4};

use super::sorted::{LANES, Sorted};
use super::surroundings::{Places, RANGES, Surroundings};

/// How many pairs a point may find on average. A cloth that keeps its distance stays far below; one whose points are all
/// close to each other would have as many pairs as the square of their number.
const MOST: usize = 64;

/// What the search in some cells found.
#[derive(Clone, Debug, Default)]
pub(super) struct Candidates {
    /// The pairs of points, in any order; at most [`MOST`] for each point that looks for others, on average.
    pub(super) pairs: Vec<[u32; 2]>,
    /// Whether there are more, which are left out.
    pub(super) is_full: bool,
    /// How many points are in the cells around each that is searched, all together.
    pub(super) around: u64,
}

impl Candidates {
    /// Finds the pairs that a point of one of `cells` looks for and whose squared distance is at most `reach`.
    #[inline(always)]
    pub(super) fn find<S: Simd>(&mut self, simd: S, sorted: &Sorted, mut cells: Range<usize>, reach: f64) {
        self.pairs.clear();
        (self.is_full, self.around) = (false, 0);
        let most = MOST * sorted.points(cells.clone());
        let (x, order, reach) = (sorted.positions(), &sorted.order[..], f64x4::splat(simd, reach));
        let mut surroundings = Surroundings::before(sorted, cells.start);
        while !cells.is_empty() {
            let block = surroundings.advance(sorted, cells.clone());
            cells.start += block;
            for around in &surroundings.cells[..block] {
                self.around += around.pairs();
                let ([start, end], is_long) = (around.own, around.is_long());
                for place in start..end {
                    if self.pairs.len() > most {
                        self.is_full = true;
                        break;
                    }
                    let center = Center::new(simd, x, place, reach);
                    let ranges = around.ranges(place);
                    self.note_first(order, place, &ranges, center.first_close(simd, &ranges));
                    if is_long {
                        self.note_rest(simd, order, place, &ranges, &center);
                    }
                }
            }
        }
    }

    /// Notes the pairs of the point at `place` and the first points of `ranges`, if they are `close` and in the range.
    #[inline(always)]
    fn note_first<S: Simd>(
        &mut self,
        order: &[u32],
        place: u32,
        ranges: &[Places; RANGES],
        close: [mask64x4<S>; RANGES],
    ) {
        let [a, b, c, d, e] = close;
        if (a | b | c | d | e).any_true() {
            for (&places, close) in ranges.iter().zip(close) {
                self.note(order, place, places, close);
            }
        }
    }

    /// Notes the pairs of the point at `place`, which is the `center`, and those after the first of `ranges`, if they are
    /// close.
    #[inline(always)]
    fn note_rest<S: Simd>(
        &mut self,
        simd: S,
        order: &[u32],
        place: u32,
        ranges: &[Places; RANGES],
        center: &Center<'_, S>,
    ) {
        for &[start, end] in ranges {
            for first in (start..end).step_by(LANES).skip(1) {
                self.note(order, place, [first, end], center.close(simd, first));
            }
        }
    }

    /// Notes the pairs of the point at `place` and those of the [`LANES`] from `first` on that are `close` and before `end`.
    #[inline(always)]
    fn note<S: Simd>(&mut self, order: &[u32], place: u32, [first, end]: Places, close: mask64x4<S>) {
        let mut close = close.to_bitmask();
        while close != 0 {
            let other = first + close.trailing_zeros();
            if other < end {
                self.pairs.push([order[place as usize], order[other as usize]]);
            }
            close &= close - 1;
        }
    }
}

/// A point that looks for others.
struct Center<'a, S: Simd> {
    /// Where all points are.
    x: [&'a [f64]; 3],
    /// Where this one is.
    position: [f64x4<S>; 3],
    /// The squared distance up to which others are close, in m².
    reach: f64x4<S>,
}

impl<'a, S: Simd> Center<'a, S> {
    /// The point at `place` among those at `x`.
    #[inline(always)]
    fn new(simd: S, [x, y, z]: [&'a [f64]; 3], place: u32, reach: f64x4<S>) -> Self {
        let at = place as usize;
        let position = [f64x4::splat(simd, x[at]), f64x4::splat(simd, y[at]), f64x4::splat(simd, z[at])];
        Self { x: [x, y, z], position, reach }
    }

    /// Which of the first points of each range are close, and of those after a range that has fewer.
    #[inline(always)]
    fn first_close(&self, simd: S, ranges: &[Places; RANGES]) -> [mask64x4<S>; RANGES] {
        let [[a, _], [b, _], [c, _], [d, _], [e, _]] = *ranges;
        [
            self.close(simd, a),
            self.close(simd, b),
            self.close(simd, c),
            self.close(simd, d),
            self.close(simd, e),
        ]
    }

    /// Which of the points from the place `first` on are close.
    #[inline(always)]
    fn close(&self, simd: S, first: u32) -> mask64x4<S> {
        let ([px, py, pz], [x, y, z]) = (self.position, self.x);
        let places = first as usize..first as usize + LANES;
        let (x, y, z) = (&x[places.clone()], &y[places.clone()], &z[places]);
        let ex = px - f64x4::from_slice(simd, x);
        let ey = py - f64x4::from_slice(simd, y);
        let ez = pz - f64x4::from_slice(simd, z);
        (ex * ex + ey * ey + ez * ez).simd_le(self.reach)
    }
}
