//! Verlet's scheme (Verlet 1967), the published method's: the next position from the last two.
//!
//! A vibration of angular frequency ω, with the part `d` of the displacement lost in each step, obeys
//! `z² - (2 - d - (dt ω)²) z + (1 - d) = 0`. Both roots lie inside the unit circle, or on it
//! without damping, iff `(dt ω)² < 4 - 2 d` (Jury's criterion). With damping per second at the rate c it is
//! `(1 + h) z² - (2 - (dt ω)²) z + (1 - h) = 0` with h = c dt / 2, and the bound is 4 for every c.
//!
//! That is for small vibrations about a shape that stands still. A cloth in motion changes its shape
//! as it vibrates, and that can feed a vibration below the bound: the scheme has resonances of third
//! and fourth order at `dt ω` = √3 and √2 (Skeel, Zhang and Schlick 1997). A cloth of 12 × 12 points
//! without damping gained energy within 300 s at each of 1.98, 1.85, 1.78 and 1.71 in motion, and
//! at none of 1.60, 1.50 and 1.41. So without damping the bound in motion is √2. With damping, even
//! of 0.05 %, no cloth was found that gains energy below its bound in motion.

use std::f64::consts::SQRT_2;
use std::mem;

use rayon::prelude::*;

use super::damped_step::DampedStep;
use super::{Integrator, StepBound};
use crate::cloth::springs::Springs;
use crate::cloth::sweep::Sweep;
use crate::cloth::{Counters, Model, Params, Points, chunks};
use crate::error::Result;
use crate::scene::{Cloth, Damping, Sim, Vec3};

/// The integrator.
#[derive(Clone, Debug)]
pub(super) struct Verlet {
    step: DampedStep,
    sweep: Sweep,
    /// The forces, in N, where they are a phase of their own; else room for the next positions.
    spare: Points,
}

impl Integrator for Verlet {
    fn new(cloth: &Cloth, sim: &Sim, springs: &Springs) -> Result<Self> {
        let (sweep, spare) = (Sweep::new(springs)?, Points::zeros(springs.grid.len())?);
        Ok(Self { step: DampedStep::midpoint(cloth, sim), sweep, spare })
    }

    fn step_bound(cloth: &Cloth, damping: Damping, _dt: f64) -> Option<StepBound> {
        Some(step_bound(cloth, damping))
    }

    fn has_force_phase(&self) -> bool {
        true
    }

    fn compute_forces(&mut self, x: &Points, model: Model<'_>, work: &mut Counters) {
        self.sweep.run(
            x,
            model,
            &mut self.spare,
            #[inline(always)]
            |_, force, out| out.into_iter().zip(force).for_each(|(out, force)| out.copy_from_slice(force)),
        );
        work.springs_evaluated += model.springs.len() as u64;
    }

    /// Both phases in one sweep: what [`Verlet::compute_forces`] and [`Verlet::advance`] do, with the forces of a band of rows used as
    /// soon as they are complete. New positions go to a third buffer, because bands of rows still read the old ones of their
    /// neighbours; then the three change places.
    fn step(&mut self, x: &mut Points, last: &mut Points, model: Model<'_>, work: &mut Counters) {
        let Self { step, sweep, spare } = self;
        let (now, before) = (x.components(), last.components());
        sweep.run(
            x,
            model,
            spare,
            #[inline(always)]
            |first, force, new| {
                for (c, new) in new.into_iter().enumerate() {
                    let band = first..first + new.len();
                    advance_band(&now[c][band.clone()], &before[c][band], force[c], new, *step);
                }
            },
        );
        mem::swap(x, last);
        mem::swap(x, spare);
        // `last` has the positions before the step, and `spare` the last ones. Pinned points keep both.
        for p in model.pins.held() {
            x.set(p, last.get(p));
            last.set(p, spare.get(p));
        }
        work.springs_evaluated += model.springs.len() as u64;
        work.points_advanced += model.pins.free_points();
    }

    /// `new = x + (x - last) · velocity_retention + f · dt2_over_m`, `last = x`, `x = new`.
    fn advance(&mut self, x: &mut Points, last: &mut Points, model: Model<'_>, work: &mut Counters) {
        let Self { step, spare: forces, .. } = self;
        let free = &model.pins.free;
        let state = x.cut_mut().zip(last.cut_mut()).zip(forces.cut()).enumerate();
        state.for_each(|(chunk, ((x, last), force))| {
            let components = x.into_iter().zip(last).zip(force);
            components.for_each(|((x, last), force)| {
                for run in chunks::within(free, chunk) {
                    advance_run(&mut x[run.clone()], &mut last[run.clone()], &force[run], *step);
                }
            });
        });
        work.points_advanced += model.pins.free_points();
    }

    fn decompose(&self, p: usize, before: Vec3, _moved: Vec3, params: &Params) -> [Vec3; 2] {
        let force = self.spare.get(p);
        [self.step.drag(before, force, params), force]
    }

    /// Near the bound the energy of the springs, taken at the ends of steps, swings by far more than there is.
    fn bounds_spring_energy(&self) -> bool {
        false
    }
}

/// The largest stable `dt ω`: `sqrt(4 - 2 d)`, or 2 with damping per second.
pub(super) fn step_bound(cloth: &Cloth, damping: Damping) -> StepBound {
    let at_rest = match damping {
        Damping::PerStep => (4.0 - 2.0 * cloth.damping / 100.0).sqrt(),
        Damping::PerSecond => 2.0,
    };
    StepBound { at_rest, in_motion: if cloth.damping > 0.0 { at_rest } else { SQRT_2 } }
}

/// One component of a band: `new = x + (x - last) · velocity_retention + f · dt2_over_m`.
#[inline(always)]
fn advance_band(x: &[f64], last: &[f64], force: &[f64], new: &mut [f64], step: DampedStep) {
    let DampedStep { velocity_retention, dt2_over_m } = step;
    let n = new.len();
    let (x, last, force) = (&x[..n], &last[..n], &force[..n]);
    for i in 0..n {
        new[i] = x[i] + (x[i] - last[i]) * velocity_retention + force[i] * dt2_over_m;
    }
}

/// One component of consecutive points.
fn advance_run(x: &mut [f64], last: &mut [f64], force: &[f64], step: DampedStep) {
    let DampedStep { velocity_retention, dt2_over_m } = step;
    for ((x, last), f) in x.iter_mut().zip(last).zip(force) {
        let new = *x + (*x - *last) * velocity_retention + f * dt2_over_m;
        *last = *x;
        *x = new;
    }
}
