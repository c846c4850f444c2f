//! The boxes of self-collision: which points share one, kept up to date from step to step.
//!
//! Space is divided into boxes of one size; point x lies in the box `floor(x / size)`, taken per
//! axis. Few points change their box in a step, so each remembers bounds between which it surely
//! stays, and only those that left them are looked at again.

use std::mem;
use std::ops::Range;

use rayon::prelude::*;

use super::sorted::{Key, Sorted};
use super::{Points, filled, pieces};
use crate::dispatch::{Work, dispatch};
use crate::error::Result;

/// Points whose bounds are compared at once.
const BLOCK: usize = 8;

/// The points of a cloth by box.
#[derive(Clone, Debug)]
pub(crate) struct Boxes {
    /// The points' places along x, y and z.
    axes: [Axis; 3],
    /// What tells boxes apart instead of their three numbers.
    hash: Option<fn([i64; 3]) -> i64>,
    /// The box of every point.
    keys: Vec<Key>,
    /// The points by box.
    sorted: Sorted,
    /// Room for the next `sorted`.
    next: Sorted,
    /// Of each block, whether one of its points may have left its box.
    restless: Vec<bool>,
    /// The points that left a box, each after the box.
    leaving: Vec<(Key, usize)>,
    /// The points that came into a box, each after the box.
    coming: Vec<(Key, usize)>,
}

impl Boxes {
    /// The boxes of the given size, in metres, of the points at `x`.
    ///
    /// # Errors
    /// [`crate::error::Kind::Scene`] when they do not fit in memory.
    pub(crate) fn new(size: [f64; 3], x: &Points) -> Result<Self> {
        let [sx, sy, sz] = size;
        let points = x.len();
        let mut boxes = Self {
            axes: [Axis::new(sx, points)?, Axis::new(sy, points)?, Axis::new(sz, points)?],
            hash: None,
            keys: filled(points, Key::default())?,
            sorted: Sorted::new(points)?,
            next: Sorted::new(points)?,
            restless: filled(points.div_ceil(BLOCK), false)?,
            leaving: filled(points, (Key::default(), 0))?,
            coming: filled(points, (Key::default(), 0))?,
        };
        boxes.sort(x);
        Ok(boxes)
    }

    /// Makes boxes one whose numbers have the same `hash`; the points are at `x`.
    pub(crate) fn tell_apart_by(&mut self, hash: fn([i64; 3]) -> i64, x: &Points) {
        self.hash = Some(hash);
        self.sort(x);
    }

    /// Sorts all points at `x` into boxes.
    fn sort(&mut self, x: &Points) {
        self.sorted.clear();
        self.leaving.clear();
        self.coming.clear();
        (0..x.len()).for_each(|p| self.place(p, x));
        self.coming.extend(self.keys.iter().copied().zip(0..));
        self.reorder();
    }

    /// All points, by box and by index within a box.
    pub(crate) fn order(&self) -> &[usize] {
        &self.sorted.order
    }

    /// The box of point `p`.
    pub(crate) fn key(&self, p: usize) -> Key {
        self.keys[p]
    }

    /// How many boxes hold two or more points.
    pub(crate) fn count(&self) -> usize {
        self.sorted.shared.len()
    }

    /// The points of box `index` (below [`Boxes::count`]), in index order.
    pub(crate) fn members(&self, index: usize) -> &[usize] {
        &self.sorted.order[self.sorted.shared[index].clone()]
    }

    /// Where the members of box `index` start among all points by box.
    pub(crate) fn start(&self, index: usize) -> usize {
        self.sorted.shared[index].start
    }

    /// Puts every point into its box after the points moved to `x`.
    pub(crate) fn update(&mut self, x: &Points) {
        self.find_restless(x);
        self.leaving.clear();
        self.coming.clear();
        for block in 0..self.restless.len() {
            if self.restless[block] {
                block_of(block, x.len()).for_each(|p| self.update_point(p, x));
            }
        }
        if !self.coming.is_empty() {
            self.reorder();
        }
    }

    /// Finds the blocks in which a point at `x` may have left its box.
    fn find_restless(&mut self, x: &Points) {
        let axes = &self.axes;
        let pieces = self.restless.par_chunks_mut(pieces::POINTS / BLOCK);
        pieces.with_min_len(pieces::at_once(x.len())).enumerate().for_each(|(piece, restless)| {
            dispatch(Look { axes, x, first: piece * (pieces::POINTS / BLOCK), restless });
        });
    }

    /// Puts point `p` at `x` into its box.
    fn update_point(&mut self, p: usize, x: &Points) {
        if any_may_leave(&self.axes, x, p..p + 1) {
            let old = self.keys[p];
            self.place(p, x);
            if self.keys[p] != old {
                self.leaving.push((old, p));
                self.coming.push((self.keys[p], p));
            }
        }
    }

    /// Finds the box of point `p` at `x`.
    fn place(&mut self, p: usize, x: &Points) {
        let [ax, ay, az] = &mut self.axes;
        let (i, j, k) = (ax.place(p, x.x[p]), ay.place(p, x.y[p]), az.place(p, x.z[p]));
        self.keys[p] = self.hash.map_or((i, j, k), |hash| (hash([i, j, k]), 0, 0));
    }

    /// Takes the points that left a box out of the order, and those that came into one in.
    fn reorder(&mut self) {
        let Self { sorted, next, leaving, coming, .. } = self;
        leaving.sort_unstable();
        coming.sort_unstable();
        next.merge(sorted, leaving, coming);
        mem::swap(sorted, next);
    }
}

/// The points of block `block` of so many points.
fn block_of(block: usize, points: usize) -> Range<usize> {
    block * BLOCK..(block * BLOCK + BLOCK).min(points)
}

/// Whether one of the points `block` at `x` may have left its box.
#[inline(always)]
fn any_may_leave(axes: &[Axis; 3], x: &Points, block: Range<usize>) -> bool {
    let may_leave = |axis: &Axis, x: &[f64]| axis.any_may_leave(block.clone(), x);
    let [ax, ay, az] = axes;
    may_leave(ax, &x.x) | may_leave(ay, &x.y) | may_leave(az, &x.z)
}

/// The look for points that may have left their boxes, from block `first` on.
struct Look<'a> {
    axes: &'a [Axis; 3],
    x: &'a Points,
    first: usize,
    restless: &'a mut [bool],
}

impl Work for Look<'_> {
    #[inline(always)]
    fn run(self) {
        for (block, restless) in (self.first..).zip(self.restless) {
            *restless = any_may_leave(self.axes, self.x, block_of(block, self.x.len()));
        }
    }
}

/// The points' places along one axis.
#[derive(Clone, Debug)]
struct Axis {
    /// Box size, in metres.
    size: f64,
    /// Per point, the first place where it surely has its number, in metres.
    lower: Vec<f64>,
    /// Per point, the last place where it surely has its number, in metres.
    upper: Vec<f64>,
}

impl Axis {
    /// Room for the places of `points` points.
    fn new(size: f64, points: usize) -> Result<Self> {
        Ok(Self { size, lower: filled(points, 0.0)?, upper: filled(points, 0.0)? })
    }

    /// Whether one of the points `block` at `x` may have left the place where it was.
    #[inline(always)]
    fn any_may_leave(&self, block: Range<usize>, x: &[f64]) -> bool {
        let (x, lower, upper) = (&x[block.clone()], &self.lower[block.clone()], &self.upper[block]);
        let mut all_stay = true;
        for ((x, lower), upper) in x.iter().zip(lower).zip(upper) {
            all_stay &= (lower <= x) & (x <= upper);
        }
        !all_stay
    }

    /// The number of the place of point `p` at `x`: `floor(x / size)`.
    ///
    /// The bounds stay away from the border by thousands of times the rounding of the division
    /// and of the bounds; where numbers are so large or so small that this cannot be said, the
    /// bounds hold nothing and the number is taken anew in every step.
    fn place(&mut self, p: usize, x: f64) -> i64 {
        let floor = (x / self.size).floor();
        let margin = 1e-12 * (floor.abs() + 1.0) * self.size;
        let sure = margin > 1e-280;
        self.lower[p] = if sure { floor * self.size + margin } else { f64::INFINITY };
        self.upper[p] = (floor + 1.0) * self.size - margin;
        number(floor)
    }
}

/// A whole number as an integer; beyond ±2⁶³ the nearest there is.
#[expect(clippy::cast_possible_truncation, reason = "a floor has no fraction, and saturation is meant")]
fn number(floor: f64) -> i64 {
    floor as i64
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::splitmix64;

    /// A number in -1..1 that depends on `index` alone.
    fn noise(index: u64) -> f64 {
        (splitmix64(index) >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    /// The groups of two or more points that share a box, straight from the definition.
    fn shared_boxes(size: [f64; 3], x: &Points) -> Vec<Vec<usize>> {
        let mut groups = std::collections::BTreeMap::<[i64; 3], Vec<usize>>::new();
        for p in 0..x.len() {
            let at = x.get(p);
            let key = [0, 1, 2].map(|c| number((at[c] / size[c]).floor()));
            groups.entry(key).or_default().push(p);
        }
        groups.into_values().filter(|group| group.len() > 1).collect()
    }

    #[test]
    fn updated_boxes_are_those_of_the_definition() {
        let size = [0.06, 0.05, 0.06];
        let mut x = Points::zeros(300).unwrap();
        for p in 0..300 {
            x.set(p, crate::scene::Vec3::new(0.06 * (p % 7) as f64, 0.0, 0.0));
        }
        let mut boxes = Boxes::new(size, &x).unwrap();
        for step in 0..200_u64 {
            for p in 0..x.len() {
                let at = (step * 300 + p as u64) * 3;
                x.x[p] += 0.004 * noise(at);
                x.y[p] += 0.004 * noise(at + 1);
                x.z[p] += 0.004 * noise(at + 2);
            }
            boxes.update(&x);
            let found: Vec<_> = (0..boxes.count()).map(|index| boxes.members(index).to_vec()).collect();
            assert_eq!(found, shared_boxes(size, &x), "step {step}");
        }
    }

    #[test]
    fn a_place_on_a_border_is_never_taken_for_sure() {
        for x in [0.0, 0.06, -0.06, 0.18, 6e30, -6e30] {
            let mut axis = Axis::new(0.06, 1).unwrap();
            axis.place(0, x);
            assert!(axis.any_may_leave(0..1, &[x]), "{x}");
        }
        let mut axis = Axis::new(0.06, 1).unwrap();
        assert_eq!(axis.place(0, -0.01), -1);
        assert!(!axis.any_may_leave(0..1, &[-0.05]), "box -1 starts at -0.06");
        assert!(axis.any_may_leave(0..1, &[0.01]), "box -1 ends at 0");
    }
}
