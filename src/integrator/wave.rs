//! Waves over the grid: an order of springs that gives the bits of the order of creation, and in which some are side by side.
//!
//! What a spring does to its ends depends on a spring before it only if both share an end. The springs that point (i, j)
//! owns end in row j at the columns i - 2 to i, in row j - 1 at i - 1 to i + 1, and in row j - 2 at i. So of the springs
//! of row j - 1, those of (i + 3, j - 1) are the last that share an end with them and must come first. Wave t is the points
//! with `i + 4 j = t`: (i + 3, j - 1) is in the wave before that of (i, j), and (i + 4, j - 1), which is in the same, shares
//! none. So the springs of one family that the points of a wave own can be treated side by side.
//!
//! A point is first an end in its own wave, because all springs lead to points created earlier, and last in
//! the one [`LIFE`] later, as the point two rows above. In between it is kept in a window (`window.rs`).

use std::ops::Range;

use crate::cloth::filled;
use crate::cloth::grid::Grid;
use crate::error::Result;

/// Columns by which a wave is further in one row than in the next.
pub(super) const LEAD: usize = 4;

/// Rows that are treated side by side.
pub(super) const LANES: usize = 4;

/// The numbers of such rows.
pub(super) type Chunk = [f64; LANES];

/// Waves between the first and the last use of a point.
pub(super) const LIFE: usize = 2 * LEAD;

/// The points (i, j) with `i + 4 j` of one number.
#[derive(Clone, Debug)]
pub(super) struct Wave {
    pub(super) number: usize,
    pub(super) rows: Range<usize>,
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
    #[inline(always)]
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
