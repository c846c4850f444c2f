//! The candidates of a search by point: with which others each may come close, in index order.

use crate::cloth::filled;
use crate::error::Result;

/// The partners of each point.
#[derive(Clone, Debug)]
pub(super) struct Partners {
    /// Where those of each point begin in `all`, and where the last ones end.
    starts: Vec<usize>,
    all: Vec<u32>,
}

impl Partners {
    /// For a cloth of `points` points.
    ///
    /// # Errors
    /// [`crate::error::Kind::Scene`] when they do not fit in memory.
    pub(super) fn new(points: usize) -> Result<Self> {
        Ok(Self { starts: filled(points + 2, 0)?, all: filled(2 * points, 0)? })
    }

    /// Takes those of `pairs`.
    pub(super) fn take<'a>(&mut self, pairs: impl Iterator<Item = &'a [[u32; 2]]> + Clone) {
        let Self { starts, all } = self;
        // Two places further on, so that each start becomes an end while points are put in.
        starts.fill(0);
        for &p in pairs.clone().flat_map(<[_]>::as_flattened) {
            starts[p as usize + 2] += 1;
        }
        for p in 2..starts.len() {
            starts[p] += starts[p - 1];
        }
        all.resize(starts[starts.len() - 1], 0);
        for &[p, q] in pairs.flatten() {
            for (p, q) in [(p, q), (q, p)] {
                let end = &mut starts[p as usize + 1];
                all[*end] = q;
                *end += 1;
            }
        }
        for p in 0..starts.len() - 2 {
            if starts[p + 1] - starts[p] > 1 {
                all[starts[p]..starts[p + 1]].sort_unstable();
            }
        }
    }

    /// Those of point `p`.
    pub(super) fn of(&self, p: usize) -> &[u32] {
        &self.all[self.starts[p]..self.starts[p + 1]]
    }
}
