//! Phases 1 and 2 of a step: the integrator that the scene asks for.

use super::state::State;
use super::stopwatch::Stopwatch;
use crate::cloth::forces::Forces;
use crate::cloth::springs::Springs;
use crate::cloth::xpbd::Xpbd;
use crate::cloth::{Constants, Counters, Points, verlet};
use crate::error::Result;
use crate::scene::{Integrator, Sim, Vec3};

/// An integrator and what it works with.
#[derive(Clone, Debug)]
pub(super) enum Scheme {
    Verlet(Forces),
    Xpbd(Xpbd),
}

impl Scheme {
    /// The integrator that `sim` asks for.
    pub(super) fn new(sim: &Sim, springs: &Springs) -> Result<Self> {
        Ok(match sim.integrator {
            Integrator::Verlet => Self::Verlet(Forces::new(springs)?),
            Integrator::Xpbd => Self::Xpbd(Xpbd::new(sim.iterations, springs)?),
        })
    }

    /// What it remembers from step to step besides positions and last positions.
    pub(super) fn memory(&self) -> &[Points] {
        &[]
    }

    /// The same, to be put back.
    pub(super) fn memory_mut(&mut self) -> &mut [Points] {
        &mut []
    }

    /// What damping changed of the displacement of point `p`, which moved by `before` and then by
    /// `moved`, and the force on it that explains the rest, in N.
    pub(super) fn split(&self, p: usize, before: Vec3, moved: Vec3, constants: &Constants) -> [Vec3; 2] {
        let Constants { mass, dt, a2, keep, .. } = *constants;
        let force = match self {
            Self::Verlet(forces) => forces.sum().get(p),
            Self::Xpbd(_) => (moved - before * keep) / a2,
        };
        [before * (keep - 1.0) + force * (a2 - dt * dt / mass), force]
    }
}

impl State {
    /// Moves every free point on by one step of the integrator.
    pub(super) fn advance(&mut self, counters: &mut Counters, stopwatch: &mut Stopwatch) {
        let Self { constants, pins, springs, x, last, scheme, .. } = self;
        match scheme {
            Scheme::Verlet(forces) => {
                forces.compute(x, springs, constants.weight.into(), counters);
                stopwatch.lap(|timings| &mut timings.forces);
                verlet::advance(x, last, forces.sum(), pins, constants, counters);
                stopwatch.lap(|timings| &mut timings.verlet);
            }
            Scheme::Xpbd(xpbd) => {
                xpbd.advance(x, last, springs, pins, constants, counters);
                stopwatch.lap(|timings| &mut timings.solver);
            }
        }
    }
}
