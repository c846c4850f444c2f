//! Conjugate gradients with Jacobi's preconditioner (Hestenes and Stiefel 1952; Shewchuk 1994, B3)
//! for `(inertia + stiffness) s = r`. Every sum has a fixed order, so the bits are the same
//! wherever it runs.

use super::stiffness::Stiffness;
use crate::cloth::{Model, Points};
use crate::error::Result;

/// Partial sums of a dot product.
const LANES: usize = 8;

/// The matrix of the system.
#[derive(Clone, Debug)]
pub(super) struct Matrix {
    /// Above 0, in N/m, one a point.
    pub(super) inertia: Vec<f64>,
    /// That of the springs.
    pub(super) stiffness: Stiffness,
}

/// The vectors of the method.
#[derive(Clone, Debug)]
pub(super) struct ConjugateGradients {
    /// The solution s, in metres; 0 for pinned points.
    pub(super) solution: Points,
    residual: Points,
    direction: Points,
    product: Points,
    /// The inverse of the matrix' diagonal.
    jacobi: Points,
}

impl ConjugateGradients {
    /// Room for systems of so many points.
    ///
    /// # Errors
    /// [`crate::error::Kind::Scene`] when it does not fit in memory.
    pub(super) fn new(points: usize) -> Result<Self> {
        let zeros = || Points::zeros(points);
        Ok(Self {
            solution: zeros()?,
            residual: zeros()?,
            direction: zeros()?,
            product: zeros()?,
            jacobi: zeros()?,
        })
    }

    /// Solves for `right`, in N and 0 for pinned points, until the residual has at most the length
    /// `target`, in N; or as many iterations as there are unknowns. Returns how many iterations it took.
    pub(super) fn solve(
        &mut self,
        right: &Points,
        target: f64,
        matrix: &mut Matrix,
        model: Model<'_>,
    ) -> usize {
        self.start(right, matrix);
        let mut descent = self.residual_times_jacobi();
        let mut iterations = 0;
        // A residual that is no number ends it too.
        while iterations < 3 * right.len() && length(&self.residual) > target {
            iterations += 1;
            self.multiply(matrix, model);
            let step = descent / dot(&self.direction, &self.product);
            add(&mut self.solution, step, &self.direction);
            add(&mut self.residual, -step, &self.product);
            let next = self.residual_times_jacobi();
            self.update_direction(next / descent);
            descent = next;
        }
        iterations
    }

    /// The solution 0, and the first direction.
    fn start(&mut self, right: &Points, Matrix { inertia, stiffness }: &Matrix) {
        self.residual.copy_from(right);
        let jacobi = self.jacobi.components_mut().into_iter().zip(stiffness.diagonal().components());
        for (jacobi, diagonal) in jacobi {
            for ((jacobi, diagonal), inertia) in jacobi.iter_mut().zip(diagonal).zip(inertia.iter()) {
                *jacobi = 1.0 / (inertia + diagonal);
            }
        }
        self.solution.components_mut().into_iter().for_each(|solution| solution.fill(0.0));
        self.direction.components_mut().into_iter().for_each(|direction| direction.fill(0.0));
        self.update_direction(0.0);
    }

    /// The matrix times the direction; 0 for pinned points.
    fn multiply(&mut self, matrix: &mut Matrix, model: Model<'_>) {
        let Matrix { inertia, stiffness } = matrix;
        let resisted = stiffness.resist(&self.direction, model.springs).components();
        let product = self.product.components_mut().into_iter();
        for ((product, direction), resisted) in product.zip(self.direction.components()).zip(resisted) {
            for run in model.pins.free.iter().cloned() {
                for p in run {
                    product[p] = inertia[p] * direction[p] - resisted[p];
                }
            }
        }
    }

    /// The next direction: the preconditioned residual and `part` of the last one.
    fn update_direction(&mut self, part: f64) {
        let direction = self.direction.components_mut().into_iter();
        let residual = self.residual.components().into_iter().zip(self.jacobi.components());
        for (direction, (residual, jacobi)) in direction.zip(residual) {
            for ((d, r), j) in direction.iter_mut().zip(residual).zip(jacobi) {
                *d = r * j + part * *d;
            }
        }
    }

    /// `r · M⁻¹ r`
    fn residual_times_jacobi(&self) -> f64 {
        let residual = self.residual.components().into_iter();
        residual.zip(self.jacobi.components()).map(|(r, j)| sum(r, |p| r[p] * r[p] * j[p])).sum()
    }
}

/// `a · b` over all points.
pub(super) fn dot(a: &Points, b: &Points) -> f64 {
    a.components().into_iter().zip(b.components()).map(|(a, b)| sum(a, |p| a[p] * b[p])).sum()
}

/// The length of `a`, all points together.
pub(super) fn length(a: &Points) -> f64 {
    dot(a, a).sqrt()
}

/// `a += factor b`
pub(super) fn add(a: &mut Points, factor: f64, b: &Points) {
    for (a, b) in a.components_mut().into_iter().zip(b.components()) {
        a.iter_mut().zip(b).for_each(|(a, b)| *a += factor * b);
    }
}

/// The sum of `term` over the points: entry p goes to partial sum p mod [`LANES`], and these are
/// added up in order.
fn sum(values: &[f64], term: impl Fn(usize) -> f64) -> f64 {
    let mut partial = [0.0; LANES];
    let whole = values.len() - values.len() % LANES;
    for start in (0..whole).step_by(LANES) {
        for (lane, partial) in partial.iter_mut().enumerate() {
            *partial += term(start + lane);
        }
    }
    for p in whole..values.len() {
        partial[p - whole] += term(p);
    }
    partial.iter().sum()
}
