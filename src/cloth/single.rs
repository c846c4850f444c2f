//! Verlet's scheme in binary32 (`sim.precision` = `f32`), in displacement form: `d = x - last` is a
//! number of its own, `d = keep d + f dt² / m`, `x = x + d`.
//!
//! What a step adds to d is far smaller than a position's last digit, and with `x` and `last` in
//! binary32 it would be lost: gravity adds 1.3e-6 m to d at 2700 steps a second, and numbers near
//! 1 m are 6e-8 to 1.2e-7 m apart. d itself has digits for it, and what the sum x + d rounds away
//! never comes back into d. Collisions and the stretch limit work in binary64; what they do to the
//! position is added to d too.
//!
//! The state of a cloth stays two arrays of binary64: every x is a binary32 number after a step, and
//! `last` is not where the point was but `x - d`, which has digits enough to tell d.

use super::forces::Forces;
use super::grid::Pins;
use super::real::Real;
use super::springs::Springs;
use super::{Constants, Counters, Points};
use crate::error::Result;

/// The integrator.
#[derive(Clone, Debug)]
pub(crate) struct Single {
    x: Points<f32>,
    forces: Forces<f32>,
}

impl Single {
    /// The integrator of `springs`.
    ///
    /// # Errors
    /// [`crate::error::Kind::Scene`] when it does not fit in memory.
    pub(crate) fn new(springs: &Springs) -> Result<Self> {
        Ok(Self { x: Points::filled(springs.grid.len())?, forces: Forces::new(springs)? })
    }

    /// Computes the forces on points at `x`.
    pub(crate) fn compute(
        &mut self,
        x: &Points,
        springs: &Springs,
        constants: &Constants,
        counters: &mut Counters,
    ) {
        for (single, x) in self.x.components_mut().into_iter().zip(x.components()) {
            single.iter_mut().zip(x).for_each(|(single, &x)| *single = f32::nearest(x));
        }
        let weight: [f64; 3] = constants.weight.into();
        self.forces.compute(&self.x, springs, weight.map(Real::nearest), counters);
    }

    /// Moves every unpinned point on by one step.
    pub(crate) fn advance(
        &self,
        x: &mut Points,
        last: &mut Points,
        pins: &Pins,
        constants: &Constants,
        counters: &mut Counters,
    ) {
        // The part that is lost has more digits than the part that is kept.
        let (loss, a2): (f32, f32) = (Real::nearest(1.0 - constants.keep), Real::nearest(constants.a2));
        let state = x.components_mut().into_iter().zip(last.components_mut());
        let single = self.x.components().into_iter().zip(self.forces.sum().components());
        for ((x, last), (single, force)) in state.zip(single) {
            for run in &pins.free {
                for p in run.clone() {
                    let before: f32 = Real::nearest(x[p] - last[p]);
                    let moved = before - before * loss + force[p] * a2;
                    x[p] = f64::from(single[p] + moved);
                    last[p] = x[p] - f64::from(moved);
                }
            }
        }
        counters.points_advanced += pins.free_points();
    }
}
