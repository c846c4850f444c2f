//! Phase 3: points of the cloth that are closer than twice its thickness move apart.

use super::neighbors::Neighbors;
use super::same_cell::SameCell;
use crate::cloth::grid::{Grid, Pins};
use crate::cloth::{Counters, Points};
use crate::error::Result;
use crate::scene::{Cloth, SelfCollision as Search, Sim};

/// The search for close pairs that the scene asks for.
#[derive(Clone, Debug)]
pub(crate) enum SelfCollision {
    /// Within a point's own cell alone: the published method.
    SameCell(Box<SameCell>),
    /// Among all points.
    Neighbors(Box<Neighbors>),
}

impl SelfCollision {
    /// The search `search` in `cloth`, whose points start at `x`; `None` for none.
    ///
    /// # Errors
    /// [`crate::error::Kind::Scene`] when it does not fit in memory.
    pub(crate) fn new(
        search: Search,
        cloth: &Cloth,
        sim: &Sim,
        grid: Grid,
        x: &Points,
    ) -> Result<Option<Self>> {
        Ok(match search {
            Search::SameBox => Some(Self::SameCell(Box::new(SameCell::new(cloth, sim, grid, x)?))),
            Search::Neighbors => Some(Self::Neighbors(Box::new(Neighbors::new(cloth, sim, x)?))),
            Search::Off => None,
        })
    }

    /// Moves close points apart; pinned points stay.
    pub(crate) fn apply(&mut self, x: &mut Points, pins: &Pins, counters: &mut Counters) {
        match self {
            Self::SameCell(search) => search.apply(x, pins, counters),
            Self::Neighbors(search) => search.apply(x, pins, counters),
        }
    }

    /// Makes cells of the published method one if `hash` of their three numbers is the same.
    pub(crate) fn set_cell_hash(&mut self, hash: fn([i64; 3]) -> i64, x: &Points) {
        if let Self::SameCell(search) = self {
            search.grid.set_hash(hash, x);
        }
    }
}
