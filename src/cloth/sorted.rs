//! Points sorted by box, and how that order follows points that go from one box to another.

use std::ops::Range;

use super::filled;
use crate::error::Result;

/// A box, as three integers.
pub(crate) type Key = (i64, i64, i64);

/// Points by box.
#[derive(Clone, Debug)]
pub(crate) struct Sorted {
    /// The points by box, and by index within a box.
    pub(crate) order: Vec<usize>,
    /// The boxes with a point, in order, each with the end of its range of `order`.
    boxes: Vec<(Key, usize)>,
    /// The boxes with two or more points, as ranges of `order`.
    pub(crate) shared: Vec<Range<usize>>,
}

impl Sorted {
    /// Room for `points` points.
    pub(crate) fn new(points: usize) -> Result<Self> {
        Ok(Self {
            order: filled(points, 0)?,
            boxes: filled(points, (Key::default(), 0))?,
            shared: filled(points / 2, 0..0)?,
        })
    }

    /// Takes all points out.
    pub(crate) fn clear(&mut self) {
        self.order.clear();
        self.boxes.clear();
        self.shared.clear();
    }

    /// Becomes `old` without the points `leaving` and with the points `coming`, each of them sorted and
    /// after the box that it leaves or comes into.
    pub(crate) fn merge(&mut self, old: &Self, mut leaving: &[(Key, usize)], mut coming: &[(Key, usize)]) {
        self.clear();
        let mut start = 0;
        for &(key, end) in &old.boxes {
            self.push_new(&mut coming, |new| new < key);
            self.push(key, &old.order[start..end], &mut leaving, &mut coming);
            start = end;
        }
        self.push_new(&mut coming, |_| true);
    }

    /// Adds the boxes at the front of `coming` that `is_new` says had no point.
    fn push_new(&mut self, coming: &mut &[(Key, usize)], is_new: impl Fn(Key) -> bool) {
        while let Some(&(key, _)) = coming.first().filter(|(key, _)| is_new(*key)) {
            self.push(key, &[], &mut [].as_slice(), coming);
        }
    }

    /// Adds the box `key`: its `members` without those at the front of `leaving` that left it, and with those at
    /// the front of `coming` that came into it, which are both taken from there.
    fn push(
        &mut self,
        key: Key,
        members: &[usize],
        leaving: &mut &[(Key, usize)],
        coming: &mut &[(Key, usize)],
    ) {
        let start = self.order.len();
        let is_next = |list: &[(Key, usize)]| list.first().is_some_and(|&(of, _)| of == key);
        if is_next(leaving) || is_next(coming) {
            for &p in members {
                while let Some(q) = take(coming, |next| next < (key, p)) {
                    self.order.push(q);
                }
                if take(leaving, |next| next == (key, p)).is_none() {
                    self.order.push(p);
                }
            }
            while let Some(q) = take(coming, |(of, _)| of == key) {
                self.order.push(q);
            }
        } else {
            self.order.extend_from_slice(members);
        }
        let end = self.order.len();
        if end > start {
            self.boxes.push((key, end));
        }
        if end > start + 1 {
            self.shared.push(start..end);
        }
    }
}

/// Takes the point at the front of `list` if `take` says so of it and its box.
fn take(list: &mut &[(Key, usize)], take: impl Fn((Key, usize)) -> bool) -> Option<usize> {
    let (&(_, p), rest) = list.split_first().filter(|&(&first, _)| take(first))?;
    *list = rest;
    Some(p)
}
