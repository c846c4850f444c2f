//! Waves over the grid: an order of springs that gives the bits of the order of creation, and in which some are side by side.
//!
//! What a spring does to its ends depends on a spring before it only if both share an end. The springs that point (i, j)
//! owns end in row j at the columns i - 2 to i, in row j - 1 at i - 1 to i + 1, and in row j - 2 at i. So of the springs
//! of row j - 1, those of (i + 3, j - 1) are the last that share an end with them and must come first. Wave t is the points
//! with `i + 4 j = t`: (i + 3, j - 1) is in the wave before that of (i, j), and (i + 4, j - 1), which is in the same, shares
//! none. So the springs of one family that the points of a wave own can be treated side by side.
//!
//! A point is first an end in its own wave, because all springs lead to points created earlier, and last in
//! the one [`LIFE`] later, as the point two rows above. In between it is kept in a [`Window`], where the points of a
//! wave lie side by side by row, and so do the other ends of their springs.

use std::ops::Range;

use crate::cloth::grid::{Grid, Pins};
use crate::cloth::{Points, filled};
use crate::error::Result;

/// Columns by which a wave is further in one row than in the next.
const LEAD: usize = 4;

/// Rows that are treated side by side.
pub(super) const LANES: usize = 4;

/// The numbers of such rows.
pub(super) type Chunk = [f64; LANES];

/// Waves between the first and the last use of a point.
pub(super) const LIFE: usize = 2 * LEAD;

/// Waves in a window.
const SLOTS: usize = LIFE + 1;

/// Rows before the first: those of ends that do not exist.
const PAD: usize = 2;

/// How many numbers a window keeps of a point: its position, and how far a force moves it.
const COMPONENTS: usize = 4;

/// The points (i, j) with `i + 4 j` of one number.
#[derive(Clone, Debug)]
pub(super) struct Wave {
    number: usize,
    rows: Range<usize>,
    /// Their chunks among those of all waves.
    pub(super) chunks: Range<usize>,
}

impl Wave {
    /// The waves over `grid`.
    ///
    /// # Errors
    /// [`crate::error::Kind::Scene`] when they do not fit in memory.
    pub(super) fn all(Grid { width, height }: Grid) -> Result<Vec<Self>> {
        let mut waves = filled(width + LEAD * (height - 1), Self { number: 0, rows: 0..0, chunks: 0..0 })?;
        let mut chunks = 0;
        for (number, wave) in waves.iter_mut().enumerate() {
            let first = (number + 1).saturating_sub(width).div_ceil(LEAD);
            let rows = first..height.min(number / LEAD + 1).max(first);
            let start = chunks;
            chunks += rows.len().div_ceil(LANES);
            *wave = Self { number, rows, chunks: start..chunks };
        }
        Ok(waves)
    }

    /// Its points, and which number of its chunks each has.
    pub(super) fn points(&self, Grid { width, .. }: Grid) -> impl Iterator<Item = (usize, usize)> {
        let number = self.number;
        self.rows.clone().map(move |j| j * width + number - LEAD * j).enumerate()
    }

    /// The row of the first number of each chunk.
    #[inline(always)]
    pub(super) fn chunk_rows(&self) -> impl Iterator<Item = usize> + use<> {
        self.rows.clone().step_by(LANES)
    }
}

/// Other ends of springs, from their owners.
#[derive(Clone, Copy, Debug)]
pub(super) struct Direction {
    /// Waves before that of the owner.
    ago: usize,
    /// Rows above that of the owner.
    up: usize,
}

impl Direction {
    /// That of the point so many columns to the left and rows up.
    pub(super) fn new(left: isize, up: usize) -> Self {
        Self { ago: (LEAD * up).wrapping_add_signed(left), up }
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

    /// Where the numbers of the row `j` of wave `number` are: those of a component are [`Window::stride`] after those of
    /// the one before.
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
        let numbers = self.numbers[place + component * self.stride..].first_chunk();
        *numbers.expect("a window has so many numbers after its last row")
    }

    /// Gives some points another component.
    #[inline(always)]
    pub(super) fn set(&mut self, place: usize, component: usize, chunk: impl Into<Chunk>) {
        self.numbers[place + component * self.stride..][..LANES].copy_from_slice(&chunk.into());
    }
}
