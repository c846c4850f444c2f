//! Phases 1 and 2 of a step: the integrator that the scene asks for.

use super::state::State;
use super::stopwatch::Stopwatch;
use crate::cloth::bdf2::Bdf2;
use crate::cloth::forces::Forces;
use crate::cloth::implicit_euler::ImplicitEuler;
use crate::cloth::single::Single;
use crate::cloth::springs::Springs;
use crate::cloth::xpbd::Xpbd;
use crate::cloth::{Constants, Counters, Model, Points, verlet};
use crate::error::Result;
use crate::scene::{Cloth, Integrator, Precision, Sim, Vec3};

/// An integrator and what it works with.
#[derive(Clone, Debug)]
pub(super) enum Scheme {
    Verlet(Box<Forces>),
    Single(Box<Single>),
    Xpbd(Xpbd),
    ImplicitEuler(Box<ImplicitEuler>),
    Bdf2(Box<Bdf2>),
}

impl Scheme {
    /// The integrator that `sim` asks for.
    pub(super) fn new(cloth: &Cloth, sim: &Sim, springs: &Springs) -> Result<Self> {
        Ok(match sim.integrator {
            Integrator::Verlet if sim.precision == Precision::F32 => {
                Self::Single(Box::new(Single::new(springs)?))
            }
            Integrator::Verlet => Self::Verlet(Box::new(Forces::new(springs)?)),
            Integrator::Xpbd => Self::Xpbd(Xpbd::new(sim.iterations, springs)?),
            Integrator::ImplicitEuler => {
                Self::ImplicitEuler(Box::new(ImplicitEuler::new(sim.tolerance, springs)?))
            }
            Integrator::Bdf2 => Self::Bdf2(Box::new(Bdf2::new(cloth, sim, springs)?)),
        })
    }

    /// Whether it is Verlet's scheme, in whatever arithmetic.
    pub(super) fn is_verlet(&self) -> bool {
        matches!(self, Self::Verlet(_) | Self::Single(_))
    }

    /// What it remembers from step to step besides positions and last positions.
    pub(super) fn memory(&self) -> &[Points] {
        match self {
            Self::Bdf2(bdf2) => &bdf2.memory,
            _ => &[],
        }
    }

    /// The same, to be put back.
    pub(super) fn memory_mut(&mut self) -> &mut [Points] {
        match self {
            Self::Bdf2(bdf2) => &mut bdf2.memory,
            _ => &mut [],
        }
    }

    /// Forgets what it remembers, because the points were put elsewhere or stopped.
    pub(super) fn forget(&mut self) {
        if let Self::Bdf2(bdf2) = self {
            bdf2.forget();
        }
    }

    /// What damping changed of the displacement of point `p`, which moved by `before` and then by
    /// `moved`, and the force on it that explains the rest, in N.
    pub(super) fn split(&self, p: usize, before: Vec3, moved: Vec3, constants: &Constants) -> [Vec3; 2] {
        let Constants { mass, dt, a2, keep, .. } = *constants;
        let undamped = dt * dt / mass;
        let force = match self {
            Self::Verlet(forces) => forces.sum().get(p),
            Self::Single(_) | Self::Xpbd(_) | Self::ImplicitEuler(_) => (moved - before * keep) / a2,
            Self::Bdf2(bdf2) => return [bdf2.damped(p), (moved - before - bdf2.damped(p)) / undamped],
        };
        [before * (keep - 1.0) + force * (a2 - undamped), force]
    }
}

impl State {
    /// Moves every free point on by one step of the integrator.
    pub(super) fn advance(&mut self, counters: &mut Counters, stopwatch: &mut Stopwatch) {
        let Self { constants, pins, springs, x, last, scheme, .. } = self;
        let model = Model { springs, pins, constants };
        match scheme {
            Scheme::Verlet(forces) => {
                forces.compute(x, springs, constants.weight.into(), counters);
                stopwatch.lap(|timings| &mut timings.forces);
                verlet::advance(x, last, forces.sum(), pins, constants, counters);
                stopwatch.lap(|timings| &mut timings.verlet);
            }
            Scheme::Single(single) => {
                single.compute(x, springs, constants, counters);
                stopwatch.lap(|timings| &mut timings.forces);
                single.advance(x, last, pins, constants, counters);
                stopwatch.lap(|timings| &mut timings.verlet);
            }
            Scheme::Xpbd(xpbd) => {
                xpbd.advance(x, last, model, counters);
                stopwatch.lap(|timings| &mut timings.solver);
            }
            Scheme::ImplicitEuler(euler) => {
                euler.advance(x, last, model, counters);
                stopwatch.lap(|timings| &mut timings.solver);
            }
            Scheme::Bdf2(bdf2) => {
                bdf2.advance(x, last, model, counters);
                stopwatch.lap(|timings| &mut timings.solver);
            }
        }
    }
}
