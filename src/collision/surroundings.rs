//! Which points are around the cells of a block, and in the same or a later cell.
//!
//! Of the 27 cells around a point, its own included, 13 come before its own in the order of cells. The own one and the
//! next in its column are one range of points; so are the three cells of each of four more columns. For each of these the
//! first cell moves forward from cell to cell, so it is never looked for. A block of cells is treated column by
//! column, because that is a short loop.

use std::ops::Range;

use super::cell_number::{AHEAD, COLUMN, NEXT};
use super::sorted::{AFTER, Cell, Counts, LANES, Sorted};

/// Cells of a block.
const BLOCK: usize = 64;

/// Ranges around a cell.
pub(super) const RANGES: usize = AHEAD.len() + 1;

/// A range of places in the order of the points.
pub(super) type Places = [u32; 2];

/// The points of a cell and around it.
#[derive(Clone, Copy)]
pub(super) struct Around {
    /// Its own points.
    pub(super) own: Places,
    /// The end of those of the next cell in its column.
    end: u32,
    /// Those of each other column.
    columns: [Places; AHEAD.len()],
    /// How many it has itself, and how many the others have.
    counts: [Counts; 2],
}

/// The points around the cells of a block.
pub(super) struct Surroundings {
    /// Of each column, the first cell that is not before it.
    first: [usize; AHEAD.len()],
    /// Of each cell, those of the same or a later one.
    pub(super) cells: [Around; BLOCK],
}

impl Surroundings {
    /// Those of no block, before that which begins with `cell`.
    #[inline(always)]
    pub(super) fn before(sorted: &Sorted, cell: usize) -> Self {
        let (number, mut first) = (sorted.cells[cell].number, [0; AHEAD.len()]);
        for (first, ahead) in first.iter_mut().zip(AHEAD) {
            *first = sorted.cells.partition_point(|cell| cell.number < column(number, ahead));
        }
        let (none, counts) = ([0; 2], [Counts::NONE; 2]);
        Self { first, cells: [Around { own: none, end: 0, columns: [none; AHEAD.len()], counts }; BLOCK] }
    }

    /// Goes on to the first cells of `rest`; how many these are.
    #[inline(always)]
    pub(super) fn advance(&mut self, sorted: &Sorted, rest: Range<usize>) -> usize {
        let block = rest.start..rest.end.min(rest.start + BLOCK);
        self.find_own(sorted, block.clone());
        for index in 0..AHEAD.len() {
            self.find_column(sorted, block.clone(), index);
        }
        block.len()
    }

    /// Finds the points of the cells of `block` and of those that are next.
    #[inline(always)]
    fn find_own(&mut self, sorted: &Sorted, block: Range<usize>) {
        let cells = sorted.cells[block.start..block.end + 2].windows(3);
        for (cells, around) in cells.zip(&mut self.cells) {
            let [own, next, after] = cells.as_chunks().0[0];
            let end = if next.number == own.number + NEXT { after.before } else { next.before };
            (around.own, around.end) = ([own.before.points(), next.before.points()], end.points());
            around.counts = [next.before.less(own.before), end.less(next.before)];
        }
    }

    /// Finds the points of one of the columns that are around the cells of `block`.
    #[inline(always)]
    fn find_column(&mut self, sorted: &Sorted, block: Range<usize>, index: usize) {
        let mut rest = &sorted.cells[self.first[index]..];
        for (around, cell) in self.cells.iter_mut().zip(&sorted.cells[block]) {
            let start = column(cell.number, AHEAD[index]);
            // Mostly a few cells further on, which is told without a branch.
            rest = &rest[count_before(start, rest)..];
            while rest[0].number < start {
                rest = &rest[1..];
            }
            let (first, last) = (rest[0].before, rest[count_before(start + COLUMN, rest)].before);
            around.columns[index] = [first.points(), last.points()];
            around.counts[1] = around.counts[1].plus(last.less(first));
        }
        self.first[index] = sorted.cells.len() - rest.len();
    }
}

impl Around {
    /// Where the point of the cell at `place` looks for others.
    #[inline(always)]
    pub(super) fn ranges(&self, place: u32) -> [Places; RANGES] {
        let [a, b, c, d] = self.columns;
        [[place + 1, self.end], a, b, c, d]
    }

    /// Whether a range has more points than are compared at once.
    #[inline(always)]
    pub(super) fn is_long(&self) -> bool {
        let [[a, a_end], [b, b_end], [c, c_end], [d, d_end]] = self.columns;
        let longest = (a_end - a).max(b_end - b).max(c_end - c).max(d_end - d);
        longest.max(self.end - self.own[0] - 1) as usize > LANES
    }

    /// How many pairs are a searched point of the cell and a point of it or of the others, or a searched one of the others
    /// and one of the cell.
    #[inline(always)]
    pub(super) fn pairs(&self) -> u64 {
        let [own, others] = self.counts;
        // Of the cell with itself both ways are the same.
        own.pairs(own) / 2 + own.pairs(others)
    }
}

/// How many of the first three of some cells come before the one with a `number`.
#[inline(always)]
fn count_before(number: u64, cells: &[Cell]) -> usize {
    let [a, b, c, _] = &cells[..AFTER].as_chunks::<AFTER>().0[0];
    let before = |cell: &Cell| usize::from(cell.number < number);
    before(a) + before(b) + before(c)
}

/// The number of the first cell of a column around the cell `number`.
#[inline(always)]
fn column(number: u64, ahead: u64) -> u64 {
    number.wrapping_add(ahead) - NEXT
}
