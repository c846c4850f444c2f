//! Phase 3: points of the cloth that are closer than twice its thickness move apart.

use super::neighbors::Neighbors;
use super::pairs::Pairs;
use super::same_cell::SameCell;
use crate::cloth::grid::{Grid, Pins};
use crate::cloth::{Counters, Points};
use crate::error::Result;
use crate::scene::{self, Cloth, Contact, Sim};

/// Contact of a cloth with itself.
#[derive(Clone, Debug)]
pub(crate) struct SelfCollision {
    search: Search,
    /// Under `sim.contact` = `coulomb`, the pairs that are too close.
    pairs: Option<Pairs>,
}

/// The search for close pairs that the scene asks for.
#[derive(Clone, Debug)]
enum Search {
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
        search: scene::SelfCollision,
        cloth: &Cloth,
        sim: &Sim,
        grid: Grid,
        x: &Points,
    ) -> Result<Option<Self>> {
        let search = match search {
            scene::SelfCollision::SameBox => Search::SameCell(Box::new(SameCell::new(cloth, sim, grid, x)?)),
            scene::SelfCollision::Neighbors => Search::Neighbors(Box::new(Neighbors::new(cloth, sim, x)?)),
            scene::SelfCollision::Off => return Ok(None),
        };
        let coulomb = sim.contact == Contact::Coulomb;
        let pairs = coulomb.then(|| Pairs::new(cloth, sim, x)).transpose()?;
        Ok(Some(Self { search, pairs }))
    }

    /// Moves close points apart; pinned points stay. Under `coulomb` the points get no speed from that, and so
    /// their `last` positions move along.
    pub(crate) fn apply(&mut self, x: &mut Points, last: &mut Points, pins: &Pins, counters: &mut Counters) {
        match (&mut self.pairs, &mut self.search) {
            (None, Search::SameCell(search)) => search.apply(x, pins, counters),
            (None, Search::Neighbors(search)) => search.apply(x, pins, counters),
            (Some(pairs), search) => {
                pairs.close.clear();
                match search {
                    Search::SameCell(search) => search.find_pairs(x, pins, pairs, counters),
                    Search::Neighbors(search) => search.find_pairs(x, pins, pairs, counters),
                }
                pairs.push_apart(x, last, pins, counters);
            }
        }
    }

    /// The pairs that were too close in this step, under `coulomb`.
    pub(crate) fn pairs(&self) -> Option<&Pairs> {
        self.pairs.as_ref()
    }

    /// Makes cells of the published method one if `hash` of their three numbers is the same.
    pub(crate) fn set_cell_hash(&mut self, hash: fn([i64; 3]) -> i64, x: &Points) {
        if let Search::SameCell(search) = &mut self.search {
            search.grid.set_hash(hash, x);
        }
    }
}
