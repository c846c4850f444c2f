//! The cell list: points sorted by cell, and how that order follows points that go from one cell
//! to another.

use std::ops::Range;

use crate::cloth::filled;
use crate::error::Result;

/// The number of a cell along each axis.
pub(super) type CellKey = (i64, i64, i64);

/// Points by cell.
#[derive(Clone, Debug)]
pub(super) struct CellList {
    /// The points by cell, and by index within a cell.
    pub(super) order: Vec<u32>,
    /// The cells with a point, in order, each with the end of its range of `order`.
    pub(super) cells: Vec<(CellKey, usize)>,
    /// The cells with two or more points, as ranges of `order`.
    pub(super) shared: Vec<Range<usize>>,
}

impl CellList {
    /// Room for `points` points.
    pub(super) fn new(points: usize) -> Result<Self> {
        Ok(Self {
            order: filled(points, 0)?,
            cells: filled(points, (CellKey::default(), 0))?,
            shared: filled(points / 2, 0..0)?,
        })
    }

    /// Takes all points out.
    pub(super) fn clear(&mut self) {
        self.order.clear();
        self.cells.clear();
        self.shared.clear();
    }

    /// Becomes `old` without the points `leaving` and with the points `entering`, each of them sorted and
    /// after the cell that it leaves or enters. Between the cells that change others are copied at once: in a step most.
    pub(super) fn merge(
        &mut self,
        old: &Self,
        mut leaving: &[(CellKey, u32)],
        mut entering: &[(CellKey, u32)],
    ) {
        self.clear();
        let mut rest = Stretch { cells: &old.cells, shared: &old.shared, points: 0..old.order.len() };
        loop {
            let changed = leaving.first().into_iter().chain(entering.first()).map(|&(key, _)| key).min();
            self.extend(&rest.split_off(|cell| changed.is_none_or(|key| cell < key)), &old.order);
            let Some(key) = changed else { break };
            let members = rest.split_off(|cell| cell == key).points;
            self.push(key, &old.order[members], &mut leaving, &mut entering);
        }
    }

    /// Adds a stretch of a list with that `order` that no point left or entered.
    fn extend(&mut self, Stretch { cells, shared, points }: &Stretch<'_>, order: &[u32]) {
        let (before, now) = (points.start, self.order.len());
        self.order.extend_from_slice(&order[points.clone()]);
        self.cells.extend(cells.iter().map(|&(key, end)| (key, end - before + now)));
        self.shared.extend(shared.iter().map(|of| of.start - before + now..of.end - before + now));
    }

    /// Adds the cell `key`: its `members` without those at the front of `leaving` that left it, and with those at
    /// the front of `entering` that entered it, which are both taken from there.
    fn push(
        &mut self,
        key: CellKey,
        members: &[u32],
        leaving: &mut &[(CellKey, u32)],
        entering: &mut &[(CellKey, u32)],
    ) {
        let start = self.order.len();
        for &p in members {
            while let Some(q) = take(entering, |next| next < (key, p)) {
                self.order.push(q);
            }
            if take(leaving, |next| next == (key, p)).is_none() {
                self.order.push(p);
            }
        }
        while let Some(q) = take(entering, |(of, _)| of == key) {
            self.order.push(q);
        }
        let end = self.order.len();
        if end > start {
            self.cells.push((key, end));
        }
        if end > start + 1 {
            self.shared.push(start..end);
        }
    }
}

/// A stretch of a list.
struct Stretch<'a> {
    cells: &'a [(CellKey, usize)],
    shared: &'a [Range<usize>],
    points: Range<usize>,
}

impl Stretch<'_> {
    /// Takes off its first cells, as many as `is_taken` says so of.
    fn split_off(&mut self, is_taken: impl Fn(CellKey) -> bool) -> Self {
        let count = self.cells.iter().take_while(|&&(cell, _)| is_taken(cell)).count();
        let (cells, rest) = self.cells.split_at(count);
        let end = cells.last().map_or(self.points.start, |&(_, end)| end);
        let count = self.shared.iter().take_while(|of| of.start < end).count();
        let (shared, rest_shared) = self.shared.split_at(count);
        let taken = Self { cells, shared, points: self.points.start..end };
        *self = Self { cells: rest, shared: rest_shared, points: end..self.points.end };
        taken
    }
}

/// Takes the point at the front of `list` if `take` says so of it and its cell.
fn take(list: &mut &[(CellKey, u32)], take: impl Fn((CellKey, u32)) -> bool) -> Option<u32> {
    let (&(_, p), rest) = list.split_first().filter(|&(&first, _)| take(first))?;
    *list = rest;
    Some(p)
}
