//! Self-collision of the published method (`sim.self_collision` = `same_box`): points of one cell
//! that are closer than twice the thickness are moved apart.
//!
//! The cells do not influence one another: a point is moved by the members of its own cell only.
//! So going cell by cell, and in index order within each, gives what index order over the whole
//! cloth gives; and a cell in which no two points are close at its turn is left as it is.

use std::ops::{Add, Range};

use super::cell::{Cell, PADDING};
use super::pairs::Pairs;
use super::separation::Separation;
use super::uniform_grid::UniformGrid;
use crate::cloth::grid::{Grid, Pins};
use crate::cloth::{Counters, Points, chunks, filled};
use crate::error::Result;
use crate::lanes::level::dispatch_plain;
use crate::scene::{Cloth, Sim};

/// Most cells of a chunk of a large cloth: about a thousand points.
const CELLS: usize = 128;

/// Just above 1: see [`Separation::new`].
const MARGIN: f64 = 1.0 + 1e-12;

/// Self-collision of a cloth within each cell.
#[derive(Clone, Debug)]
pub(crate) struct SameCell {
    rule: Separation,
    /// The points by cell.
    pub(super) grid: UniformGrid,
    /// Slots for the positions of the members of each shared cell, and [`PADDING`] more for each.
    positions: Points,
    /// Of each shared cell in which a member moved, the first of its slots.
    moved: Vec<Option<usize>>,
}

impl SameCell {
    /// Self-collision of `cloth`, whose points start at `x`.
    ///
    /// # Errors
    /// [`crate::error::Kind::Scene`] when it does not fit in memory.
    pub(super) fn new(cloth: &Cloth, sim: &Sim, grid: Grid, x: &Points) -> Result<Self> {
        let bx = 3.0 * cloth.width / grid.width as f64;
        let by = 3.0 * cloth.height / grid.height as f64;
        let most_cells = x.len() / 2;
        let slots = x.len() + PADDING * most_cells;
        Ok(Self {
            rule: Separation::new(cloth, sim, MARGIN),
            grid: UniformGrid::new([bx, by, bx.max(by)], x)?,
            positions: Points::zeros(slots)?,
            moved: filled(most_cells, None)?,
        })
    }

    /// Moves apart the close points of every cell; pinned points stay.
    pub(super) fn apply(&mut self, x: &mut Points, pins: &Pins, counters: &mut Counters) {
        self.grid.update(x);
        let Self { rule, grid, positions, moved } = self;
        let range = 0..grid.shared_cells();
        let most = if x.len() < chunks::MANY { range.len() } else { CELLS };
        let inputs = Inputs { rule: *rule, grid, x, pins };
        let whole = Cells { inputs, range, first_slot: 0, positions: positions.components_mut(), moved };
        let Tally { pairs, moves } = whole.run_in_parts(most);
        counters.boxes_searched += grid.shared_cells() as u64;
        counters.pairs_tested += pairs;
        counters.self_collision_moves += moves;
        self.write_back(x);
    }

    /// Finds the pairs of each cell that are too close at `x`.
    pub(super) fn find_pairs(&mut self, x: &Points, pins: &Pins, pairs: &mut Pairs, counters: &mut Counters) {
        self.grid.update(x);
        counters.boxes_searched += self.grid.shared_cells() as u64;
        for index in 0..self.grid.shared_cells() {
            let members = self.grid.members(index);
            for (place, &p) in members.iter().enumerate() {
                members[place + 1..].iter().for_each(|&q| pairs.add(p, q, x, pins));
            }
            counters.pairs_tested += (members.len() * (members.len() - 1) / 2) as u64;
        }
    }

    /// Takes over the positions of the cells in which a member moved.
    fn write_back(&self, x: &mut Points) {
        for (index, moved) in self.moved[..self.grid.shared_cells()].iter().enumerate() {
            let Some(slot) = *moved else { continue };
            for (at, &p) in (slot..).zip(self.grid.members(index)) {
                x.set(p, self.positions.get(at));
            }
        }
    }
}

/// How many slots the shared cells before `index` may take.
fn slots_before(grid: &UniformGrid, index: usize) -> usize {
    grid.start(index) + PADDING * index
}

/// What was done in some cells.
#[derive(Clone, Copy, Default)]
struct Tally {
    pairs: u64,
    moves: u64,
}

impl Add for Tally {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self { pairs: self.pairs + other.pairs, moves: self.moves + other.moves }
    }
}

/// What the work on each cell reads.
#[derive(Clone, Copy)]
struct Inputs<'a> {
    rule: Separation,
    grid: &'a UniformGrid,
    x: &'a Points,
    pins: &'a Pins,
}

/// Consecutive shared cells and what the work on them changes.
struct Cells<'a> {
    inputs: Inputs<'a>,
    range: Range<usize>,
    first_slot: usize,
    positions: [&'a mut [f64]; 3],
    moved: &'a mut [Option<usize>],
}

impl Cells<'_> {
    /// Works on all cells, in parts of at most `most` on several threads.
    fn run_in_parts(self, most: usize) -> Tally {
        if self.range.len() <= most {
            return dispatch_plain!(self.run());
        }
        let [a, b] = self.halves();
        let (a, b) = rayon::join(|| a.run_in_parts(most), || b.run_in_parts(most));
        a + b
    }

    /// Works on all cells, one after the other.
    #[inline(always)]
    fn run(self) -> Tally {
        let Self { inputs, range, first_slot, mut positions, moved } = self;
        let mut tally = Tally::default();
        let mut next = 0;
        for (index, moved) in range.zip(moved) {
            let members = inputs.grid.members(index);
            let slots = next..next + members.len() + PADDING;
            let positions = positions.each_mut().map(|component| &mut component[slots.clone()]);
            let mut cell = Cell::load(members, inputs.rule, inputs.x, positions);
            let moves = if cell.any_close() { cell.separate(&inputs.pins.pinned) } else { 0 };
            *moved = (moves > 0).then_some(first_slot + next);
            // A cell that stays as it is leaves its slots, which are in the cache, to the next.
            next = if moves > 0 { slots.end } else { next };
            tally.moves += moves;
            tally.pairs += (members.len() * (members.len() - 1) / 2) as u64;
        }
        tally
    }

    /// The first half of the cells, and the second.
    fn halves(self) -> [Self; 2] {
        let Self { inputs, range: Range { start, end }, first_slot, positions, moved } = self;
        let middle = start.midpoint(end);
        let slot = slots_before(inputs.grid, middle);
        let [x, y, z] = positions.map(|component| component.split_at_mut(slot - first_slot));
        let moved = moved.split_at_mut(middle - start);
        let (a, b) = ([x.0, y.0, z.0], [x.1, y.1, z.1]);
        [
            Cells { inputs, range: start..middle, first_slot, positions: a, moved: moved.0 },
            Cells { inputs, range: middle..end, first_slot: slot, positions: b, moved: moved.1 },
        ]
    }
}
