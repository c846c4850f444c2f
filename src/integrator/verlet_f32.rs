//! Verlet's scheme in binary32 (`sim.precision` = `f32`), in displacement form: `d = x - last` is a
//! number of its own, `d = velocity_retention d + f dt² / m`, `x = x + d`.
//!
//! What a step adds to d is far smaller than a position's last digit, and with `x` and `last` in
//! binary32 it would be lost: gravity adds 1.3e-6 m to d at 2700 steps a second, and numbers near
//! 1 m are 6e-8 to 1.2e-7 m apart. d itself has digits for it, and what the sum x + d rounds away
//! never comes back into d. Collisions and the stretch limit work in binary64; what they do to the
//! position is added to d too.
//!
//! The state of a cloth stays two arrays of binary64: every x is a binary32 number after a step, and
//! `last` is not where the point was but `x - d`, which has digits enough to tell d.

use super::damped_step::DampedStep;
use super::{Integrator, Resolution, StepBound, verlet};
use crate::cloth::forces::Forces;
use crate::cloth::real::Real;
use crate::cloth::springs::Springs;
use crate::cloth::{Counters, Model, Params, Points};
use crate::error::Result;
use crate::scene::{Cloth, Damping, Sim, Vec3};

/// The integrator.
#[derive(Clone, Debug)]
pub(super) struct VerletF32 {
    step: DampedStep,
    x: Points<f32>,
    forces: Forces<f32>,
}

impl Integrator for VerletF32 {
    fn new(cloth: &Cloth, sim: &Sim, springs: &Springs) -> Result<Self> {
        let x = Points::filled(springs.grid.len())?;
        Ok(Self { step: DampedStep::midpoint(cloth, sim), x, forces: Forces::new(springs)? })
    }

    fn step_bound(cloth: &Cloth, damping: Damping, _dt: f64) -> Option<StepBound> {
        Some(verlet::step_bound(cloth, damping))
    }

    fn has_force_phase(&self) -> bool {
        true
    }

    fn compute_forces(&mut self, x: &Points, model: Model<'_>, work: &mut Counters) {
        for (single, x) in self.x.components_mut().into_iter().zip(x.components()) {
            single.iter_mut().zip(x).for_each(|(single, &x)| *single = Real::nearest(x));
        }
        let weight: [f64; 3] = model.params.weight.into();
        self.forces.compute(&self.x, model.springs, weight.map(Real::nearest), work);
    }

    fn advance(&mut self, x: &mut Points, last: &mut Points, model: Model<'_>, work: &mut Counters) {
        // The part that is lost has more digits than the part that is retained.
        let loss: f32 = Real::nearest(1.0 - self.step.velocity_retention);
        let dt2_over_m: f32 = Real::nearest(self.step.dt2_over_m);
        let state = x.components_mut().into_iter().zip(last.components_mut());
        let single = self.x.components().into_iter().zip(self.forces.sum().components());
        for ((x, last), (single, force)) in state.zip(single) {
            for run in &model.pins.free {
                for p in run.clone() {
                    let before: f32 = Real::nearest(x[p] - last[p]);
                    let moved = before - before * loss + force[p] * dt2_over_m;
                    x[p] = f64::from(single[p] + moved);
                    last[p] = x[p] - f64::from(moved);
                }
            }
        }
        work.points_advanced += model.pins.free_points();
    }

    fn decompose(&self, _p: usize, before: Vec3, moved: Vec3, params: &Params) -> [Vec3; 2] {
        self.step.decompose(before, moved, params)
    }

    fn resolution(&self) -> Resolution {
        Resolution { unit: f64::from(f32::EPSILON), keeps_velocity: true }
    }

    fn bounds_spring_energy(&self) -> bool {
        false
    }
}
