//! Self-collision of the published method (`sim.self_collision` = `same_box`): points of one cell
//! that are closer than twice the thickness are moved apart.
//!
//! The cells do not influence one another: a point is moved by the members of its own cell only.
//! So going cell by cell, and in index order within each, gives what index order over the whole
//! cloth gives; and a cell in which no two points are close at its turn is left as it is.

use std::ops::Range;

use fearless_simd::Simd;
use rayon::prelude::*;

use super::cell::Cell;
use super::pairs::Pairs;
use super::separation::Separation;
use super::slots::{Screen, Slots};
use super::uniform_grid::UniformGrid;
use crate::cloth::grid::{Grid, Pins};
use crate::cloth::{Counters, Points, chunks, filled, too_large};
use crate::error::Result;
use crate::lanes::level::{Narrow, dispatch_narrow};
use crate::scene::{Cloth, Sim, Vec3};

/// Points of a part of a large cloth.
const POINTS: usize = 2048;

/// Self-collision of a cloth within each cell.
#[derive(Clone, Debug)]
pub(crate) struct SameCell {
    rule: Separation,
    screen: Screen,
    /// The points by cell.
    pub(super) grid: UniformGrid,
    /// As many shared cells each, in order.
    parts: Vec<Part>,
}

/// What the work on some cells needs and finds.
#[derive(Clone, Debug)]
struct Part {
    slots: Slots,
    /// The members that moved, and where to.
    moved: Vec<(u32, Vec3)>,
    /// Pairs that were compared.
    pairs: u64,
}

/// What the work on each cell reads.
#[derive(Clone, Copy)]
struct Work<'a> {
    rule: Separation,
    screen: Screen,
    grid: &'a UniformGrid,
    x: &'a Points,
    pinned: &'a [bool],
}

impl SameCell {
    /// Self-collision of `cloth`, whose points start at `x`.
    ///
    /// # Errors
    /// [`crate::error::Kind::Scene`] when it does not fit in memory.
    pub(super) fn new(cloth: &Cloth, sim: &Sim, grid: Grid, x: &Points) -> Result<Self> {
        let bx = 3.0 * cloth.width / grid.width as f64;
        let by = 3.0 * cloth.height / grid.height as f64;
        let rule = Separation::new(cloth, sim);
        // A small cloth is one part, with room for all that may happen, so that no step takes memory.
        let small = x.len() < chunks::MANY;
        let (parts, of_one) = if small { (1, x.len()) } else { (x.len() / POINTS, 0) };
        let room = if small { x.len() / 2 * Slots::needed(2) + 1 } else { 2 * POINTS };
        let mut moved = Vec::new();
        moved.try_reserve_exact(of_one).map_err(|_| too_large())?;
        Ok(Self {
            rule,
            screen: Screen::new(bx.max(by), &rule),
            grid: UniformGrid::new([bx, by, bx.max(by)], x)?,
            parts: filled(parts, Part { slots: Slots::new(room, of_one)?, moved, pairs: 0 })?,
        })
    }

    /// Moves apart the close points of every cell; pinned points stay.
    pub(super) fn apply(&mut self, x: &mut Points, pins: &Pins, counters: &mut Counters) {
        self.grid.update(x);
        let Self { rule, screen, grid, parts } = self;
        let (cells, count) = (grid.shared_cells(), parts.len());
        let screen = if grid.is_near() { *screen } else { Screen::ALL };
        let work = Work { rule: *rule, screen, grid, x, pinned: &pins.pinned };
        parts.par_iter_mut().enumerate().for_each(|(index, part)| {
            let cells = index * cells / count..(index + 1) * cells / count;
            part.slots.make_room(cells.clone().map(|cell| work.grid.members(cell).len()));
            dispatch_narrow!(Narrow::widest(), simd => part.run(simd, cells, &work));
        });
        counters.boxes_searched += cells as u64;
        for part in parts {
            part.moved.iter().for_each(|&(p, position)| x.set(p as usize, position));
            counters.pairs_tested += part.pairs;
            counters.self_collision_moves += part.moved.len() as u64;
        }
    }

    /// Finds the pairs of each cell that are too close at `x`.
    pub(super) fn find_pairs(&mut self, x: &Points, pins: &Pins, pairs: &mut Pairs, counters: &mut Counters) {
        self.grid.update(x);
        counters.boxes_searched += self.grid.shared_cells() as u64;
        for index in 0..self.grid.shared_cells() {
            let members = self.grid.members(index);
            for (place, &p) in members.iter().enumerate() {
                members[place + 1..].iter().for_each(|&q| pairs.add(p as usize, q as usize, x, pins));
            }
            counters.pairs_tested += (members.len() * (members.len() - 1) / 2) as u64;
        }
    }
}

impl Part {
    /// Moves apart the close points of `cells`.
    #[inline(always)]
    fn run<S: Simd>(&mut self, simd: S, cells: Range<usize>, of: &Work<'_>) {
        let Self { slots, moved, pairs } = self;
        // All cells first: what was just stored a number at a time cannot be loaded as a vector at once.
        let mut next = 0;
        for cell in cells.clone() {
            let members = of.grid.members(cell);
            slots.load(next, members, of.x);
            next += Slots::needed(members.len());
        }
        moved.clear();
        *pairs = 0;
        next = 0;
        for cell in cells {
            let members = of.grid.members(cell);
            let mut cell = Cell { members, x: of.x, screen: of.screen, start: next, slots };
            cell.separate(simd, &of.rule, of.pinned, moved);
            next += Slots::needed(members.len());
            *pairs += (members.len() * (members.len() - 1) / 2) as u64;
        }
    }
}
