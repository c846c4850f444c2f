//! Implicit Euler (Baraff and Witkin 1998): `v' = v + dt f(x') / m`, `x' = x + dt v'`. First order,
//! stable for every step, and it takes energy out of what moves fast for the step.
//!
//! The velocity before the step is `(x - last) / dt` less what damping takes, as for Verlet's
//! scheme. So it holds what collisions and the stretch limit did to the position.

use super::newton::Newton;
use super::springs::Springs;
use super::{Counters, Model, Points};
use crate::error::Result;

/// The integrator.
#[derive(Clone, Debug)]
pub(crate) struct ImplicitEuler {
    newton: Newton,
}

impl ImplicitEuler {
    /// The integrator of `springs` that solves each step to `tolerance`, as [`Newton::new`].
    ///
    /// # Errors
    /// [`crate::error::Kind::Scene`] when it does not fit in memory.
    pub(crate) fn new(tolerance: f64, springs: &Springs) -> Result<Self> {
        Ok(Self { newton: Newton::new(tolerance, springs)? })
    }

    /// Moves every unpinned point on by one step.
    pub(crate) fn advance(
        &mut self,
        x: &mut Points,
        last: &mut Points,
        model: Model<'_>,
        counters: &mut Counters,
    ) {
        let Model { pins, constants, .. } = model;
        for p in pins.free.iter().cloned().flatten() {
            let (now, moved) = (x.get(p), x.get(p) - last.get(p));
            self.newton.target.set(p, now + moved * constants.keep);
            self.newton.matrix.inertia[p] = 1.0 / constants.a2;
            last.set(p, now);
            // The guess: it goes on as it went.
            x.set(p, now + moved);
        }
        self.newton.solve(x, model, counters);
        counters.points_advanced += pins.free_points();
    }
}
