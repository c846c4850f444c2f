//! Integrators: how the points of a cloth move on by one step under the forces on them.
//!
//! An integrator is a type with the trait `Integrator` in a file of its own, and a row of
//! the table below.

mod bdf2;
mod block_jacobi;
mod blocks;
mod conjugate_gradients;
mod damped_step;
mod dense;
mod implicit_euler;
mod matrix;
mod multigrid;
mod newton;
mod preconditioner;
mod rk4;
mod stiffness;
mod transfer;
mod vectors;
mod verlet;
mod verlet_f32;
mod wave;
mod window;
mod xpbd;

use std::fmt::Debug;

use crate::cloth::springs::Springs;
use crate::cloth::{Counters, Model, Params, Points};
use crate::error::Result;
use crate::scene::{Cloth, Damping, Integrator as Choice, Precision, Sim, Vec3};

/// The row of the integrator that `sim` asks for.
fn row(sim: &Sim) -> Row {
    match (sim.integrator, sim.precision) {
        (Choice::Verlet, Precision::F64) => Row::of::<verlet::Verlet>(),
        (Choice::Verlet, Precision::F32) => Row::of::<verlet_f32::VerletF32>(),
        (Choice::Rk4, _) => Row::of::<rk4::Rk4>(),
        (Choice::Xpbd, _) => Row::of::<xpbd::Xpbd>(),
        (Choice::ImplicitEuler, _) => Row::of::<implicit_euler::ImplicitEuler>(),
        (Choice::Bdf2, _) => Row::of::<bdf2::Bdf2>(),
    }
}

/// What moves the points of a cloth.
pub(crate) trait Integrator: BoxedClone + Debug + Send + Sync {
    /// The integrator of `cloth`, which has `springs`, moved as `sim` says.
    ///
    /// # Errors
    /// [`crate::error::Kind::Scene`] when it does not fit in memory.
    fn new(cloth: &Cloth, sim: &Sim, springs: &Springs) -> Result<Self>
    where
        Self: Sized;

    /// The bound of a step of `dt` seconds, or `None` for an integrator that is stable at every step. There
    /// is no default: the stability check relies on the answer.
    fn step_bound(cloth: &Cloth, damping: Damping, dt: f64) -> Option<StepBound>
    where
        Self: Sized;

    /// Whether it computes forces in a phase of their own, before it advances; others do so while they advance.
    fn has_force_phase(&self) -> bool {
        false
    }

    /// Phase 1: computes the forces on points at `x`, if it is a phase of its own.
    fn compute_forces(&mut self, _x: &Points, _model: Model<'_>, _work: &mut Counters) {}

    /// Phase 2: moves every unpinned point on by one step, and makes `last` the positions before it.
    fn advance(&mut self, x: &mut Points, last: &mut Points, model: Model<'_>, work: &mut Counters);

    /// Phases 1 and 2, where nothing looks at the cloth between them.
    fn step(&mut self, x: &mut Points, last: &mut Points, model: Model<'_>, work: &mut Counters) {
        self.compute_forces(x, model, work);
        self.advance(x, last, model, work);
    }

    /// What it remembers from step to step besides positions and last positions.
    fn memory(&self) -> &[Points] {
        &[]
    }

    /// The same, to be restored.
    fn memory_mut(&mut self) -> &mut [Points] {
        &mut []
    }

    /// Discards what it remembers: the next step starts from the positions and last positions alone.
    fn reset_history(&mut self) {}

    /// Splits the displacement of point `p` in the last step, `moved` after `before` in the step before that,
    /// into what damping changed of it, in metres, and the force that explains the rest, in N.
    fn decompose(&self, p: usize, before: Vec3, moved: Vec3, params: &Params) -> [Vec3; 2];

    /// How far point `p`, which is at `x` and came from `last`, would go in a step of `dt` seconds at the velocity that
    /// it has now, at the end of the step.
    fn displacement(&self, _p: usize, x: Vec3, last: Vec3, _dt: f64) -> Vec3 {
        x - last
    }

    /// Discards what it remembers of point `p`, which goes on with the velocity `(x - last) / dt`.
    fn forget(&mut self, _p: usize) {}

    /// How the motion of points is rounded.
    fn resolution(&self) -> Resolution {
        Resolution { unit: f64::EPSILON, keeps_velocity: false }
    }

    /// Whether the energy of the springs counts against the energy bound.
    fn bounds_spring_energy(&self) -> bool {
        true
    }
}

/// How the motion of points is rounded.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Resolution {
    /// Distance of a position to the next number, as a part of it.
    pub(crate) unit: f64,
    /// Whether velocities are kept apart from positions, and not rounded as their differences are.
    pub(crate) keeps_velocity: bool,
}

/// The longest stable step, as the product of the step and the angular frequency of a vibration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StepBound {
    /// For small vibrations about a shape at rest.
    pub at_rest: f64,
    /// For a cloth in motion, whose vibrations can feed each other.
    pub in_motion: f64,
}

/// A row of the table of integrators.
struct Row {
    new: fn(&Cloth, &Sim, &Springs) -> Result<Box<dyn Integrator>>,
    step_bound: fn(&Cloth, Damping, f64) -> Option<StepBound>,
}

impl Row {
    fn of<I: Integrator + 'static>() -> Self {
        Self {
            new: |cloth, sim, springs| Ok(Box::new(I::new(cloth, sim, springs)?)),
            step_bound: I::step_bound,
        }
    }
}

/// The integrator that `sim` asks for.
///
/// # Errors
/// As [`Integrator::new`].
pub(crate) fn create(cloth: &Cloth, sim: &Sim, springs: &Springs) -> Result<Box<dyn Integrator>> {
    (row(sim).new)(cloth, sim, springs)
}

/// The bound of a step of `dt` seconds under the integrator that `sim` asks for; `None` if every step is
/// stable.
pub fn step_bound(cloth: &Cloth, sim: &Sim, dt: f64) -> Option<StepBound> {
    (row(sim).step_bound)(cloth, sim.damping, dt)
}

/// The bound under Verlet's scheme, which the other integrators are compared with.
pub(crate) fn verlet_step_bound(cloth: &Cloth, damping: Damping) -> StepBound {
    verlet::step_bound(cloth, damping)
}

/// Copies an integrator behind a pointer.
pub(crate) trait BoxedClone {
    /// A copy.
    fn boxed_clone(&self) -> Box<dyn Integrator>;
}

impl<I: Integrator + Clone + 'static> BoxedClone for I {
    fn boxed_clone(&self) -> Box<dyn Integrator> {
        Box::new(self.clone())
    }
}

impl Clone for Box<dyn Integrator> {
    fn clone(&self) -> Self {
        (**self).boxed_clone()
    }
}
