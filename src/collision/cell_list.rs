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
    cells: Vec<(CellKey, usize)>,
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
    /// after the cell that it leaves or enters.
    pub(super) fn merge(
        &mut self,
        old: &Self,
        mut leaving: &[(CellKey, u32)],
        mut entering: &[(CellKey, u32)],
    ) {
        self.clear();
        let mut start = 0;
        for &(key, end) in &old.cells {
            self.push_new(&mut entering, |new| new < key);
            self.push(key, &old.order[start..end], &mut leaving, &mut entering);
            start = end;
        }
        self.push_new(&mut entering, |_| true);
    }

    /// Adds the cells at the front of `entering` that `is_new` says had no point.
    fn push_new(&mut self, entering: &mut &[(CellKey, u32)], is_new: impl Fn(CellKey) -> bool) {
        while let Some(&(key, _)) = entering.first().filter(|(key, _)| is_new(*key)) {
            self.push(key, &[], &mut [].as_slice(), entering);
        }
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
        let is_next = |list: &[(CellKey, u32)]| list.first().is_some_and(|&(of, _)| of == key);
        if is_next(leaving) || is_next(entering) {
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
        } else {
            self.order.extend_from_slice(members);
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

/// Takes the point at the front of `list` if `take` says so of it and its cell.
fn take(list: &mut &[(CellKey, u32)], take: impl Fn((CellKey, u32)) -> bool) -> Option<u32> {
    let (&(_, p), rest) = list.split_first().filter(|&(&first, _)| take(first))?;
    *list = rest;
    Some(p)
}
