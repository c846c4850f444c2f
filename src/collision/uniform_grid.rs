//! The uniform grid of self-collision: which points share a cell, kept up to date from step to step.
//!
//! Space is divided into cells of one size; point x lies in the cell `floor(x / size)`, taken per
//! axis. Few points change their cell in a step, so each remembers bounds between which it surely
//! stays, and only those that left them are looked at again.

use std::mem;
use std::ops::Range;

use rayon::prelude::*;

use super::axis::Axis;
use super::cell_list::{CellKey, CellList};
use crate::cloth::{Points, chunks, filled, too_large};
use crate::error::Result;
use crate::lanes::level::dispatch_plain;

/// Points whose bounds are compared at once.
const BLOCK: usize = 8;

/// From this number on, a cell counts as far away.
const FAR: u64 = 1 << 40;

/// The points of a cloth by cell.
#[derive(Clone, Debug)]
pub(super) struct UniformGrid {
    /// The cells along x, y and z.
    axes: [Axis; 3],
    /// What tells cells apart instead of their three numbers.
    hash: Option<fn([i64; 3]) -> i64>,
    /// The largest number, but for its sign, of a cell in which a point ever lay.
    largest: u64,
    /// The cell of every point.
    keys: Vec<CellKey>,
    /// The points by cell.
    list: CellList,
    /// Room for the next `list`.
    next: CellList,
    /// Of each block, whether one of its points may have left its cell.
    dirty: Vec<bool>,
    /// The points that left a cell, each after the cell.
    leaving: Vec<(CellKey, u32)>,
    /// The points that entered a cell, each after the cell.
    entering: Vec<(CellKey, u32)>,
}

impl UniformGrid {
    /// The grid with cells of the given size, in metres, of the points at `x`.
    ///
    /// # Errors
    /// [`crate::error::Kind::Scene`] when it does not fit in memory.
    pub(super) fn new(size: [f64; 3], x: &Points) -> Result<Self> {
        let [sx, sy, sz] = size;
        let points = x.len();
        u32::try_from(points).map_err(|_| too_large())?;
        let mut grid = Self {
            axes: [Axis::new(sx, points)?, Axis::new(sy, points)?, Axis::new(sz, points)?],
            hash: None,
            largest: 0,
            keys: filled(points, CellKey::default())?,
            list: CellList::new(points)?,
            next: CellList::new(points)?,
            dirty: filled(points.div_ceil(BLOCK), false)?,
            leaving: filled(points, (CellKey::default(), 0))?,
            entering: filled(points, (CellKey::default(), 0))?,
        };
        grid.rebuild(x);
        Ok(grid)
    }

    /// Makes cells one whose numbers have the same `hash`; the points are at `x`.
    pub(super) fn set_hash(&mut self, hash: fn([i64; 3]) -> i64, x: &Points) {
        self.hash = Some(hash);
        self.rebuild(x);
    }

    /// Finds the cell of every point at `x`.
    fn rebuild(&mut self, x: &Points) {
        self.list.clear();
        self.leaving.clear();
        self.entering.clear();
        (0..x.len()).for_each(|p| self.set_cell(p, x));
        self.entering.extend(self.keys.iter().copied().zip(0..));
        self.merge();
    }

    /// All points, by cell and by index within a cell.
    pub(super) fn order(&self) -> &[u32] {
        &self.list.order
    }

    /// The cell of point `p`.
    pub(super) fn key(&self, p: u32) -> CellKey {
        self.keys[p as usize]
    }

    /// How many cells hold two or more points.
    pub(super) fn shared_cells(&self) -> usize {
        self.list.shared.len()
    }

    /// The points of shared cell `index` (below [`UniformGrid::shared_cells`]), in index order.
    pub(super) fn members(&self, index: usize) -> &[u32] {
        &self.list.order[self.list.shared[index].clone()]
    }

    /// Whether the points of each cell are surely no further apart than a cell is long, but for rounding: no two cells
    /// were made one, and none had so large a number that a coordinate in it has hardly a fraction.
    pub(super) fn is_near(&self) -> bool {
        self.hash.is_none() && self.largest < FAR
    }

    /// The largest number, but for its sign, of a cell in which a point ever lay.
    pub(super) fn largest(&self) -> u64 {
        self.largest
    }

    /// The cells with a point in order, each with the end of its points in [`UniformGrid::order`].
    pub(super) fn cells(&self) -> &[(CellKey, usize)] {
        &self.list.cells
    }

    /// Puts every point into its cell after the points moved to `x`.
    pub(super) fn update(&mut self, x: &Points) {
        self.find_dirty(x);
        self.leaving.clear();
        self.entering.clear();
        for block in 0..self.dirty.len() {
            if self.dirty[block] {
                block_of(block, x.len()).for_each(|p| self.update_point(p, x));
            }
        }
        if !self.entering.is_empty() {
            self.merge();
        }
    }

    /// Finds the blocks in which a point at `x` may have left its cell.
    fn find_dirty(&mut self, x: &Points) {
        let axes = &self.axes;
        let chunks = self.dirty.par_chunks_mut(chunks::POINTS / BLOCK);
        chunks.with_min_len(chunks::at_once(x.len())).enumerate().for_each(|(chunk, dirty)| {
            dispatch_plain!(find_dirty(axes, x, chunk * (chunks::POINTS / BLOCK), dirty));
        });
    }

    /// Puts point `p` at `x` into its cell.
    fn update_point(&mut self, p: usize, x: &Points) {
        if any_may_leave(&self.axes, x, p..p + 1) {
            let old = self.keys[p];
            self.set_cell(p, x);
            if self.keys[p] != old {
                self.leaving.push((old, number(p)));
                self.entering.push((self.keys[p], number(p)));
            }
        }
    }

    /// Computes the cell of point `p` at `x`.
    fn set_cell(&mut self, p: usize, x: &Points) {
        let [ax, ay, az] = &mut self.axes;
        let (i, j, k) = (ax.cell_of(p, x.x[p]), ay.cell_of(p, x.y[p]), az.cell_of(p, x.z[p]));
        self.largest = [i, j, k].iter().fold(self.largest, |most, n| most.max(n.unsigned_abs()));
        self.keys[p] = self.hash.map_or((i, j, k), |hash| (hash([i, j, k]), 0, 0));
    }

    /// Takes the points that left a cell out of the list, and those that entered one in.
    fn merge(&mut self) {
        let Self { list, next, leaving, entering, .. } = self;
        leaving.sort_unstable();
        entering.sort_unstable();
        next.merge(list, leaving, entering);
        mem::swap(list, next);
    }
}

/// The number of a point: [`UniformGrid::new`] takes no more points than have one.
#[expect(clippy::cast_possible_truncation, reason = "there are fewer points")]
fn number(p: usize) -> u32 {
    p as u32
}

/// The points of block `block` of so many points.
fn block_of(block: usize, points: usize) -> Range<usize> {
    block * BLOCK..(block * BLOCK + BLOCK).min(points)
}

/// Whether one of `points`, which are at `x`, may have left its cell.
#[inline(always)]
fn any_may_leave(axes: &[Axis; 3], x: &Points, points: Range<usize>) -> bool {
    let may_leave = |axis: &Axis, x: &[f64]| axis.any_may_leave(points.clone(), x);
    let [ax, ay, az] = axes;
    may_leave(ax, &x.x) | may_leave(ay, &x.y) | may_leave(az, &x.z)
}

/// Finds the blocks from `first` on in which a point at `x` may have left its cell.
#[inline(always)]
fn find_dirty(axes: &[Axis; 3], x: &Points, first: usize, dirty: &mut [bool]) {
    for (block, dirty) in (first..).zip(dirty) {
        *dirty = any_may_leave(axes, x, block_of(block, x.len()));
    }
}

#[cfg(test)]
mod tests {
    use super::super::axis::integer;
    use super::*;
    use crate::math::splitmix64;

    /// A number in -1..1 that depends on `index` alone.
    fn noise(index: u64) -> f64 {
        (splitmix64(index) >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    /// The groups of two or more points that share a cell, straight from the definition.
    fn shared_cells(size: [f64; 3], x: &Points) -> Vec<Vec<usize>> {
        let mut groups = std::collections::BTreeMap::<[i64; 3], Vec<usize>>::new();
        for p in 0..x.len() {
            let at = x.get(p);
            let key = [0, 1, 2].map(|c| integer((at[c] / size[c]).floor()));
            groups.entry(key).or_default().push(p);
        }
        groups.into_values().filter(|group| group.len() > 1).collect()
    }

    #[test]
    fn the_updated_grid_is_that_of_the_definition() {
        let size = [0.06, 0.05, 0.06];
        let mut x = Points::zeros(300).unwrap();
        for p in 0..300 {
            x.set(p, crate::scene::Vec3::new(0.06 * (p % 7) as f64, 0.0, 0.0));
        }
        let mut grid = UniformGrid::new(size, &x).unwrap();
        for step in 0..200_u64 {
            for p in 0..x.len() {
                let at = (step * 300 + p as u64) * 3;
                x.x[p] += 0.004 * noise(at);
                x.y[p] += 0.004 * noise(at + 1);
                x.z[p] += 0.004 * noise(at + 2);
            }
            grid.update(&x);
            let members = |index| grid.members(index).iter().map(|&p| p as usize).collect();
            let found: Vec<Vec<usize>> = (0..grid.shared_cells()).map(members).collect();
            assert_eq!(found, shared_cells(size, &x), "step {step}");
        }
    }
}
