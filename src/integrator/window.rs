//! The points of the last waves (`wave.rs`): those of a wave lie side by side by row, and so do the other ends of their springs.

use super::wave::{Chunk, LANES, LEAD, LIFE, Wave};
use crate::cloth::grid::{Grid, Pins};
use crate::cloth::springs::Family;
use crate::cloth::{Points, filled};
use crate::error::Result;

/// Waves in a window.
const SLOTS: usize = LIFE + 1;

/// Rows before the first: those of ends that do not exist.
const PAD: usize = 2;

/// How many numbers a window keeps of a point: its position, and how far a force moves it.
const COMPONENTS: usize = 4;

/// Other ends of springs, from their owners.
#[derive(Clone, Copy, Debug)]
pub(super) struct Direction {
    /// Waves before that of the owner.
    ago: usize,
    /// Rows above that of the owner.
    up: usize,
}

impl Direction {
    /// That of the springs of `family`.
    pub(super) fn of(family: &Family) -> Self {
        Self { ago: (LEAD * family.up).wrapping_add_signed(family.left), up: family.up }
    }
}

/// The points of the last waves, by component and row.
#[derive(Clone, Debug)]
pub(super) struct Window {
    grid: Grid,
    /// Numbers of one component of one wave.
    stride: usize,
    numbers: Vec<f64>,
}

impl Window {
    /// A window over `grid`.
    ///
    /// # Errors
    /// [`crate::error::Kind::Scene`] when it does not fit in memory.
    pub(super) fn new(grid: Grid) -> Result<Self> {
        let stride = PAD + grid.height + LANES;
        Ok(Self { grid, stride, numbers: filled(SLOTS * COMPONENTS * stride, 0.0)? })
    }

    /// Where the numbers of the row `j` of wave `number` are: those of a component are a stride after those of the
    /// one before.
    #[inline(always)]
    fn place(&self, number: usize, j: usize) -> usize {
        number % SLOTS * COMPONENTS * self.stride + PAD + j
    }

    /// Takes the points of `wave` from `x`; a force moves them by `moves`, unless they are pinned.
    #[inline(always)]
    pub(super) fn load(&mut self, wave: &Wave, x: &Points, pins: &Pins, moves: f64) {
        let place = self.place(wave.number, wave.rows.start);
        for (row, p) in wave.points(self.grid) {
            let moves = if pins.pinned[p] { 0.0 } else { moves };
            for (c, value) in [x.x[p], x.y[p], x.z[p], moves].into_iter().enumerate() {
                self.numbers[place + c * self.stride + row] = value;
            }
        }
    }

    /// Gives the points of `wave` back to `x`.
    #[inline(always)]
    pub(super) fn store(&self, wave: &Wave, x: &mut Points) {
        let place = self.place(wave.number, wave.rows.start);
        for (row, p) in wave.points(self.grid) {
            x.x[p] = self.numbers[place + row];
            x.y[p] = self.numbers[place + self.stride + row];
            x.z[p] = self.numbers[place + 2 * self.stride + row];
        }
    }

    /// Where the points of `wave` from row `j` on are, and the ends from them in a `direction`.
    #[inline(always)]
    pub(super) fn ends(&self, wave: &Wave, j: usize, direction: Direction) -> [usize; 2] {
        [self.place(wave.number, j), self.place(wave.number + SLOTS - direction.ago, j) - direction.up]
    }

    /// A component of some points: 0 to 2 of the position, 3 how far a force moves them.
    #[inline(always)]
    pub(super) fn get(&self, place: usize, component: usize) -> Chunk {
        let at = place + component * self.stride;
        self.numbers[at..at + LANES].as_chunks().0[0]
    }

    /// Gives some points another component.
    #[inline(always)]
    pub(super) fn set(&mut self, place: usize, component: usize, chunk: impl Into<Chunk>) {
        let at = place + component * self.stride;
        self.numbers[at..at + LANES].copy_from_slice(&chunk.into());
    }
}
