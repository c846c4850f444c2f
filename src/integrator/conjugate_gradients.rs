//! Preconditioned conjugate gradients (Hestenes and Stiefel 1952; Saad 2003, *Iterative Methods for Sparse
//! Linear Systems*, algorithm 9.1) for `(inertia + stiffness) s = r`. Every sum has a fixed order, so the bits are
//! the same wherever it runs.

use super::matrix::Matrix;
use super::preconditioner::Preconditioner;
use super::vectors::{add, dot, length, scale_and_add};
use crate::cloth::{Model, Points};
use crate::error::Result;

/// The vectors of the method.
#[derive(Clone, Debug)]
pub(super) struct ConjugateGradients {
    /// The solution s, in metres; 0 for pinned points.
    pub(super) solution: Points,
    residual: Points,
    direction: Points,
    product: Points,
    /// The preconditioner's inverse times the residual, in metres.
    preconditioned: Points,
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
            preconditioned: zeros()?,
        })
    }

    /// Solves for `right`, in N and 0 for pinned points, until the residual has at most the length
    /// `target`, in N; or as many iterations as there are unknowns. Returns how many springs it visited.
    pub(super) fn solve(
        &mut self,
        right: &Points,
        target: f64,
        matrix: &mut Matrix,
        preconditioner: &mut Preconditioner,
        model: Model<'_>,
    ) -> u64 {
        self.solution.components_mut().into_iter().for_each(|solution| solution.fill(0.0));
        self.residual.copy_from(right);
        let (mut iterations, mut visited, mut descent) = (0, 0, 0.0);
        // A residual that is no number ends it too.
        while iterations < 3 * right.len() && length(&self.residual) > target {
            visited += preconditioner.apply(&self.residual, &mut self.preconditioned, matrix, model);
            let next = dot(&self.residual, &self.preconditioned);
            let part = if iterations == 0 { 0.0 } else { next / descent };
            scale_and_add(&mut self.direction, part, &self.preconditioned);
            descent = next;
            matrix.multiply(&self.direction, &mut self.product, model.springs, model.pins);
            visited += model.springs.len() as u64;
            let step = descent / dot(&self.direction, &self.product);
            add(&mut self.solution, step, &self.direction);
            add(&mut self.residual, -step, &self.product);
            iterations += 1;
        }
        visited
    }
}
