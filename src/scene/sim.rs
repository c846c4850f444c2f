//! How a cloth is moved: the keys of `sim`.

use super::Vec3;

/// How the cloth is moved.
#[derive(Clone, Debug, PartialEq)]
pub struct Sim {
    /// Frames per second of simulated time (1e-6..=1e9).
    pub fps: f64,
    /// Steps per frame (1..=1e9): `T` of the method.
    pub steps_per_frame: u32,
    /// Acceleration, in m/s².
    pub gravity: Vec3,
    /// The scheme that advances the positions.
    pub integrator: Integrator,
    /// Passes over the springs in a step of [`Integrator::Xpbd`] (1..=1e6); others do not read it.
    /// More steps help more than more passes do.
    pub iterations: u32,
    /// Part of the forces that [`Integrator::ImplicitEuler`] and [`Integrator::Bdf2`] may leave
    /// unbalanced at the end of a step (1e-15..=1); others do not read it. On the stock cloth the
    /// default is within 1 % of the error of an exact solution at 600 and 2700 steps a second.
    pub tolerance: f64,
    /// The arithmetic of the positions.
    pub precision: Precision,
    /// How the first step knows the velocity.
    pub start: Start,
    /// What the damping percentage refers to.
    pub damping: Damping,
    /// Largest strain left by the stretch limit (>= 0; 0.1 = 10 %), or none.
    pub stretch_limit: Option<f64>,
    /// Passes of the stretch limit per step (1..=1e6).
    pub stretch_passes: u32,
    /// How close pairs of points of the cloth are found.
    pub self_collision: SelfCollision,
    /// What is promised of points that touched an object.
    pub contact: Contact,
}

/// The scheme that advances the positions (`sim.integrator`).
///
/// docs/integrators.md has the error of each on the stock pinned2 cloth, docs/findings.md on stiffer ones. For the same work no
/// implicit method was as accurate as Verlet's scheme at any stiffness that was tried, and fewer implicit steps
/// can cost more, because each takes more iterations.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Integrator {
    /// Position Verlet, the report's. Explicit: stable for small steps only, which are checked
    /// before the first.
    Verlet,
    /// The classical Runge-Kutta method, fourth order, four evaluations of the forces in a step:
    /// `src/integrator/rk4.rs`. Explicit: stable for small steps only, which are checked before the first.
    Rk4,
    /// Extended position-based dynamics, first order, with `sim.iterations`: `src/integrator/xpbd.rs`. Never
    /// refused, but wrong and gaining energy where its passes are too few; then the run is stopped.
    Xpbd,
    /// Implicit Euler, first order, solved to `sim.tolerance`: `src/integrator/implicit_euler.rs`. Stable for
    /// every step; takes energy.
    ImplicitEuler,
    /// The second backward differentiation formula, solved to `sim.tolerance`: `src/integrator/bdf2.rs`.
    /// Second order and stable for every step.
    Bdf2,
}

/// The arithmetic of the positions (`sim.precision`).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Precision {
    /// binary64, the report's.
    F64,
    /// binary32 for positions, displacements and forces of [`Integrator::Verlet`], in displacement
    /// form: `src/integrator/verlet_f32.rs`. Measured on the stock pinned2 cloth without limit and
    /// self-collision, at 0.5 s, against binary64: at most 2.5e-6 m apart at 30 steps a frame, 7.4e-6 m
    /// at 120 and 3.4e-5 m at 480. It saves about a twentieth of the time: for comparison, not speed.
    F32,
}

/// How the first step knows the velocity (`sim.start`), of [`Integrator::Verlet`] only: the others have
/// it at the start, where it is 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Start {
    /// `last = x`: the report's, first order.
    Report,
    /// `last = x - v dt + f dt² / (2 m)` at speed v = 0: second order. Free fall then falls by
    /// `g t² / 2` exactly without damping, where the report's start is off by `g dt t / 2`. Measured on an undamped
    /// hanging cloth of 8 x 8 points at 0.2 s and 30 steps a frame: 2.1e-7 m off instead of 3.7e-4 m.
    HalfStep,
}

/// What the damping percentage refers to (`sim.damping`).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Damping {
    /// Per step, the report's: the part of a displacement, or of a velocity, that each step takes.
    PerStep,
    /// Per second, at the rate `c = -2700 ln(1 - damping / 100)` per second, which is the report's at
    /// its 2700 steps a second; as a force `-c m v` at the middle of the step, second order, and at
    /// the end of the step for integrators other than Verlet's scheme.
    /// Free fall ends at `g / c` for every number of steps. Measured on a hanging cloth of 8 x 8
    /// points at 0.2 s, with the half-step start: 2.4e-7 m off at 30 steps a frame; with damping
    /// per step it is another cloth, 35 mm off at 10 and 71 mm at 120 steps a frame.
    PerSecond,
}

/// How close pairs of points are found (`sim.self_collision`).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SelfCollision {
    /// Only within a point's own box, the report's.
    SameBox,
    /// All, as comparing each point with every other would: `src/collision/neighbors.rs`.
    Neighbors,
    /// Not at all.
    Off,
}

/// What is promised of points that touched an object (`sim.contact`).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Contact {
    /// Nothing, the report's: friction and the stretch limit leave points inside.
    Report,
    /// After every step no free point is inside a sphere, or beyond a plane from where it
    /// started, except by rounding; where objects overlap, inside the last one: `src/collision/contact.rs`.
    Outside,
}
