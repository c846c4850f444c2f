//! The system of a grid of 2 × 2 points, solved exactly: `A = L D Lᵀ` (Golub and Van Loan, *Matrix
//! Computations*, 4.1).

use super::block_jacobi::at_least;
use super::matrix::Matrix;
use crate::cloth::Points;
use crate::cloth::grid::Pins;
use crate::cloth::springs::Springs;
use crate::error::Result;

/// Points of the grid.
const POINTS: usize = 4;

/// Unknowns: the components of the points, axis by axis.
const N: usize = 3 * POINTS;

/// The factors of the matrix.
#[derive(Clone, Debug)]
pub(super) struct Dense {
    /// The columns of L; what stands above its diagonal is not read.
    lower: [[f64; N]; N],
    /// D⁻¹; 0 for pinned points.
    scale: [f64; N],
    unit: Points,
    product: Points,
}

impl Dense {
    /// Room for the factors.
    ///
    /// # Errors
    /// [`crate::error::Kind::Scene`] when it does not fit in memory.
    pub(super) fn new() -> Result<Self> {
        let [unit, product] = [Points::zeros(POINTS)?, Points::zeros(POINTS)?];
        Ok(Self { lower: [[0.0; N]; N], scale: [0.0; N], unit, product })
    }

    /// Factors `matrix`. As in block Jacobi no pivot is below the least inertia, but by rounding.
    pub(super) fn update(&mut self, matrix: &mut Matrix, springs: &Springs, pins: &Pins) {
        let mut columns = self.columns(matrix, springs, pins);
        let least = matrix.inertia.iter().copied().fold(f64::INFINITY, f64::min);
        for k in 0..N {
            let column = columns[k];
            self.scale[k] = if pins.pinned[k % POINTS] { 0.0 } else { 1.0 / at_least(column[k], least) };
            self.lower[k] = column.map(|entry| entry * self.scale[k]);
            for (later, part) in columns.iter_mut().zip(self.lower[k]).skip(k + 1) {
                later.iter_mut().zip(column).for_each(|(entry, own)| *entry -= part * own);
            }
        }
    }

    /// Solves for `right`, 0 for pinned points.
    pub(super) fn solve(&self, right: &Points, solution: &mut Points) {
        let mut s = [0.0; N];
        for (s, right) in s.iter_mut().zip(right.components().into_iter().flatten()) {
            *s = *right;
        }
        for k in 0..N {
            for i in k + 1..N {
                s[i] -= self.lower[k][i] * s[k];
            }
        }
        for k in (0..N).rev() {
            s[k] *= self.scale[k];
            for i in k + 1..N {
                s[k] -= self.lower[k][i] * s[i];
            }
        }
        for (solution, s) in solution.components_mut().into_iter().flatten().zip(s) {
            *solution = s;
        }
    }

    /// The columns of the matrix; 0 for pinned points.
    fn columns(&mut self, matrix: &mut Matrix, springs: &Springs, pins: &Pins) -> [[f64; N]; N] {
        let mut columns = [[0.0; N]; N];
        for (k, column) in columns.iter_mut().enumerate().filter(|(k, _)| !pins.pinned[k % POINTS]) {
            self.unit.components_mut()[k / POINTS][k % POINTS] = 1.0;
            matrix.multiply(&self.unit, &mut self.product, springs, pins);
            self.unit.components_mut()[k / POINTS][k % POINTS] = 0.0;
            for (entry, product) in column.iter_mut().zip(self.product.components().into_iter().flatten()) {
                *entry = *product;
            }
        }
        columns
    }
}
