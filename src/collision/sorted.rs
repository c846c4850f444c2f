//! The points of a cloth in the order of their cells: those of a cell, and of cells after one another in a column, lie side
//! by side.
//!
//! The order is that of the grid, and cells are known by one number (`cell_number.rs`). Of cells that are so far from
//! others that their numbers are cut off several may have the same number, and the order of the grid is not that of the
//! numbers. Then points are sorted anew, which is seldom.

use std::ops::Range;

use rayon::prelude::*;

use super::cell_number::{END, number};
use super::uniform_grid::UniformGrid;
use crate::cloth::{Points, chunks, filled};
use crate::error::Result;

/// Points that are compared at once.
pub(super) const LANES: usize = 4;

/// Cells after the last, which have no point.
pub(super) const AFTER: usize = 4;

/// A cell.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cell {
    /// Its number; [`END`] after the last cell with a point.
    pub(super) number: u64,
    /// The points of the cells before.
    pub(super) before: Counts,
}

/// How many points, and how many of them are searched: both in one number, so that they are added and subtracted at once.
#[derive(Clone, Copy, Debug)]
pub(super) struct Counts(u64);

impl Counts {
    pub(super) const NONE: Self = Self(0);

    /// How many points they are.
    #[expect(clippy::cast_possible_truncation, reason = "the lower half")]
    #[inline(always)]
    pub(super) fn points(self) -> u32 {
        self.0 as u32
    }

    /// How many of them are searched.
    #[inline(always)]
    fn searched(self) -> u32 {
        (self.0 >> 32) as u32
    }

    /// These and `count` more points, so many of which are searched.
    fn and(self, count: usize, searched: u32) -> Self {
        Self(self.0 + (u64::from(searched) << 32 | count as u64))
    }

    /// All of both.
    #[inline(always)]
    pub(super) fn plus(self, others: Self) -> Self {
        Self(self.0 + others.0)
    }

    /// These without `others`.
    #[inline(always)]
    pub(super) fn less(self, others: Self) -> Self {
        Self(self.0 - others.0)
    }

    /// How many pairs are a searched point of the one and any point of the other, or the other way round.
    #[inline(always)]
    pub(super) fn pairs(self, other: Self) -> u64 {
        let product = |a: Self, b: Self| u64::from(a.searched()) * u64::from(b.points());
        product(self, other) + product(other, self)
    }
}

/// The points by cell.
#[derive(Clone, Debug)]
pub(super) struct Sorted {
    /// The cells with a point, in order, and [`AFTER`] after them.
    pub(super) cells: Vec<Cell>,
    /// The components of the positions, and after them [`LANES`] numbers of any value.
    x: [Vec<f64>; 3],
    /// The points in that order.
    pub(super) order: Vec<u32>,
}

impl Sorted {
    /// For a cloth of `points` points.
    ///
    /// # Errors
    /// [`crate::error::Kind::Scene`] when they do not fit in memory.
    pub(super) fn new(points: usize) -> Result<Self> {
        let x = || filled(points + LANES, 0.0);
        Ok(Self {
            cells: filled(points + AFTER, Cell { number: END, before: Counts::NONE })?,
            x: [x()?, x()?, x()?],
            order: filled(points, 0)?,
        })
    }

    /// Takes the points of `grid`, which are at `x`.
    pub(super) fn take(&mut self, grid: &UniformGrid, x: &Points, is_searched: impl Fn(usize) -> bool) {
        self.order.clear();
        self.order.extend_from_slice(grid.order());
        let origin = grid.cells()[0].0;
        let cells = grid.cells().iter().map(|&(key, end)| (number(key, origin), end));
        self.take_cells(cells, &is_searched);
        if !self.cells.windows(2).all(|cells| cells[0].number <= cells[1].number) {
            self.sort(|p| number(grid.key(p), origin), &is_searched);
        }
        for (x, sorted) in x.components().into_iter().zip(&mut self.x) {
            let chunks = sorted.par_chunks_mut(chunks::POINTS).zip(self.order.par_chunks(chunks::POINTS));
            chunks.with_min_len(chunks::at_once(self.order.len())).for_each(|(sorted, order)| {
                sorted.iter_mut().zip(order).for_each(|(sorted, &p)| *sorted = x[p as usize]);
            });
        }
    }

    /// Takes cells by number, each with the end of its points in the order.
    fn take_cells(&mut self, cells: impl Iterator<Item = (u64, usize)>, is_searched: impl Fn(usize) -> bool) {
        self.cells.clear();
        let (mut start, mut before) = (0, Counts::NONE);
        for (number, end) in cells {
            self.cells.push(Cell { number, before });
            let members = self.order[start..end].iter();
            before = before.and(end - start, members.map(|&p| u32::from(is_searched(p as usize))).sum());
            start = end;
        }
        self.cells.extend([Cell { number: END, before }; AFTER]);
    }

    /// Sorts the points by the number of their cell, and finds the cells anew.
    fn sort(&mut self, number_of: impl Fn(u32) -> u64, is_searched: impl Fn(usize) -> bool) {
        self.order.sort_unstable_by_key(|&p| (number_of(p), p));
        let mut cells: Vec<(u64, usize)> = Vec::new();
        for (&p, end) in self.order.iter().zip(1..) {
            match cells.last_mut() {
                Some(last) if last.0 == number_of(p) => last.1 = end,
                _ => cells.push((number_of(p), end)),
            }
        }
        self.take_cells(cells.into_iter(), is_searched);
    }

    /// How many cells have a point.
    pub(super) fn cells(&self) -> usize {
        self.cells.len() - AFTER
    }

    /// How many points are in `cells`.
    pub(super) fn points(&self, cells: Range<usize>) -> usize {
        self.cells[cells.end].before.less(self.cells[cells.start].before).points() as usize
    }

    /// The components of the positions, and [`LANES`] numbers of any value after each: all of one length.
    #[inline(always)]
    pub(super) fn positions(&self) -> [&[f64]; 3] {
        let [x, y, z] = &self.x;
        [x, &y[..x.len()], &z[..x.len()]]
    }
}
