//! Newton's method for the end of an implicit step (Baraff and Witkin 1998 take one iteration):
//! the positions x with `inertia (x - target) = f(x)`, f the weight and the springs at x.
//!
//! There `inertia |x - target|² / 2` and the energies of springs and height together have no slope.
//! Each iteration steps along the Newton direction, and halves the step until the slope upwards at its
//! end is at most half of the slope downwards at its start.

use super::conjugate_gradients::ConjugateGradients;
use super::matrix::Matrix;
use super::preconditioner::Preconditioner;
use super::vectors::{add, dot, length};
use crate::cloth::forces::Forces;
use crate::cloth::springs::Springs;
use crate::cloth::{Counters, Model, Points};
use crate::error::Result;
use crate::math;
use crate::scene::{Cloth, Sim};

/// Most iterations in a step.
const ITERATIONS: usize = 50;

/// Most halvings in an iteration.
const HALVINGS: usize = 20;

/// The part of the residual that the linear solver may leave to the next iteration.
const FORCING: f64 = 0.01;

/// Move of an iteration, as a part of the length of all positions, below which rounding lets no further one help.
const ROUNDING: f64 = 1e-15;

/// The solver, and the two numbers that make an integrator of it.
#[derive(Clone, Debug)]
pub(super) struct Newton {
    /// Where the points would be without forces, in metres.
    pub(super) target: Points,
    /// Its inertia is the force per distance from the target: the mass over the square of a time.
    pub(super) matrix: Matrix,
    tolerance: f64,
    forces: Forces,
    residual: Points,
    linear: ConjugateGradients,
    preconditioner: Preconditioner,
}

impl Newton {
    /// The solver for `cloth` with `springs` that leaves at most the part `sim.tolerance` of the forces unbalanced:
    /// the length of the residual over that of the weights and the springs' forces, over all points.
    ///
    /// # Errors
    /// [`crate::error::Kind::Scene`] when it does not fit in memory.
    pub(super) fn new(cloth: &Cloth, sim: &Sim, springs: &Springs) -> Result<Self> {
        let points = springs.grid.len();
        Ok(Self {
            target: Points::zeros(points)?,
            matrix: Matrix::new(springs)?,
            tolerance: sim.tolerance,
            forces: Forces::new(springs)?,
            residual: Points::zeros(points)?,
            linear: ConjugateGradients::new(points)?,
            preconditioner: Preconditioner::new(cloth, sim, points)?,
        })
    }

    /// Moves the unpinned points from a guess `x` to the solution.
    pub(super) fn solve(&mut self, x: &mut Points, model: Model<'_>, work: &mut Counters) {
        let mut goal = self.compute_residual(x, model, work);
        let (mut iterations, mut moved) = (0, f64::INFINITY);
        while iterations < ITERATIONS && !self.is_solved(goal) && moved > ROUNDING * length(x) {
            iterations += 1;
            self.matrix.stiffness.update(x, model.springs);
            let target = (0.5 * goal).max(FORCING * length(&self.residual));
            let Self { matrix, linear, preconditioner, residual, .. } = self;
            preconditioner.update(x, matrix, model);
            work.springs_evaluated += linear.solve(residual, target, matrix, preconditioner, model);
            (goal, moved) = self.line_search(x, model, work);
        }
        work.unsolved_steps += u64::from(!self.is_solved(goal));
    }

    /// Whether the residual is no longer than `goal`, in N.
    fn is_solved(&self, goal: f64) -> bool {
        length(&self.residual) <= goal
    }

    /// Moves the points along the solution of the linear system; the goal where they end, and by how much
    /// they moved.
    fn line_search(&mut self, x: &mut Points, model: Model<'_>, work: &mut Counters) -> (f64, f64) {
        let slope = dot(&self.residual, &self.linear.solution);
        let mut part = 1.0;
        add(x, part, &self.linear.solution);
        let mut goal = self.compute_residual(x, model, work);
        let mut halvings = 0;
        while halvings < HALVINGS && dot(&self.residual, &self.linear.solution) < -0.5 * slope {
            halvings += 1;
            part *= 0.5;
            add(x, -part, &self.linear.solution);
            goal = self.compute_residual(x, model, work);
        }
        (goal, part * length(&self.linear.solution))
    }

    /// Computes the residual at `x`, in N; how long it may be.
    fn compute_residual(&mut self, x: &Points, model: Model<'_>, work: &mut Counters) -> f64 {
        let Model { springs, pins, params } = model;
        let weight = params.weight;
        self.forces.compute(x, springs, weight.into(), work);
        let (mut squares, forces) = (0.0_f64, self.forces.sum());
        for p in pins.free.iter().cloned().flatten() {
            let force = forces.get(p);
            self.residual.set(p, force - (x.get(p) - self.target.get(p)) * self.matrix.inertia[p]);
            let pulled = force - weight;
            squares += math::dot(pulled, pulled) + math::dot(weight, weight);
        }
        self.tolerance * squares.sqrt()
    }
}
