//! A symmetric block of 3 × 3 numbers for each point of a cloth: what the springs at the point resist with when it
//! alone moves.

use std::ops::Range;

use crate::cloth::Points;
use crate::error::Result;

/// The blocks of all points, in N/m.
#[derive(Clone, Debug)]
pub(super) struct Blocks {
    /// xx, yy and zz.
    pub(super) diagonal: Points,
    /// xy, xz and yz.
    pub(super) mixed: Points,
}

impl Blocks {
    /// Zeros for so many points.
    ///
    /// # Errors
    /// [`crate::error::Kind::Scene`] when they do not fit in memory.
    pub(super) fn zeros(points: usize) -> Result<Self> {
        Ok(Self { diagonal: Points::zeros(points)?, mixed: Points::zeros(points)? })
    }

    /// Makes all of them 0.
    pub(super) fn clear(&mut self) {
        let Self { diagonal, mixed } = self;
        diagonal
            .components_mut()
            .into_iter()
            .chain(mixed.components_mut())
            .for_each(|numbers| numbers.fill(0.0));
    }

    /// Adds `n nᵀ + all I` of the springs of a range of owners to the blocks of `points`, as many.
    #[inline(always)]
    pub(super) fn add(&mut self, points: Range<usize>, [nx, ny, nz]: [&[f64]; 3], all: &[f64]) {
        let n = points.len();
        let [nx, ny, nz] = [nx, ny, nz].map(|numbers| &numbers[..n]);
        let all = &all[..n];
        let [xx, yy, zz] = self.diagonal.components_mut().map(|numbers| &mut numbers[points.clone()][..n]);
        for i in 0..n {
            xx[i] += nx[i] * nx[i] + all[i];
            yy[i] += ny[i] * ny[i] + all[i];
            zz[i] += nz[i] * nz[i] + all[i];
        }
        let [xy, xz, yz] = self.mixed.components_mut().map(|numbers| &mut numbers[points.clone()][..n]);
        for i in 0..n {
            xy[i] += nx[i] * ny[i];
            xz[i] += nx[i] * nz[i];
            yz[i] += ny[i] * nz[i];
        }
    }
}
