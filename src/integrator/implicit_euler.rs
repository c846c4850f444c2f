//! Implicit Euler (Baraff and Witkin 1998): `v' = v + dt f(x') / m`, `x' = x + dt v'`. First order,
//! stable for every step, and it takes energy out of what moves fast for the step.
//!
//! The velocity before the step is `(x - last) / dt` less what damping takes, as for Verlet's
//! scheme. So it holds what collisions and the stretch limit did to the position.

use super::damped_step::DampedStep;
use super::newton::Newton;
use super::{Integrator, StepBound};
use crate::cloth::springs::Springs;
use crate::cloth::{Counters, Model, Params, Points};
use crate::error::Result;
use crate::scene::{Cloth, Damping, Sim, Vec3};

/// The integrator.
#[derive(Clone, Debug)]
pub(super) struct ImplicitEuler {
    step: DampedStep,
    newton: Newton,
}

impl Integrator for ImplicitEuler {
    fn new(cloth: &Cloth, sim: &Sim, springs: &Springs) -> Result<Self> {
        Ok(Self { step: DampedStep::backward(cloth, sim), newton: Newton::new(cloth, sim, springs)? })
    }

    fn step_bound(_cloth: &Cloth, _damping: Damping, _dt: f64) -> Option<StepBound> {
        None
    }

    fn advance(&mut self, x: &mut Points, last: &mut Points, model: Model<'_>, work: &mut Counters) {
        let DampedStep { velocity_retention, dt2_over_m } = self.step;
        for p in model.pins.free.iter().cloned().flatten() {
            let (now, moved) = (x.get(p), x.get(p) - last.get(p));
            self.newton.target.set(p, now + moved * velocity_retention);
            self.newton.matrix.inertia[p] = 1.0 / dt2_over_m;
            last.set(p, now);
            // Newton's method starts where the point would be if it kept its velocity.
            x.set(p, now + moved);
        }
        self.newton.solve(x, model, work);
        work.points_advanced += model.pins.free_points();
    }

    fn decompose(&self, _p: usize, before: Vec3, moved: Vec3, params: &Params) -> [Vec3; 2] {
        self.step.decompose(before, moved, params)
    }
}
