//! How the cloth is moved.

use super::json::choice::{choice, choices};
use super::json::keys::keys;
use super::json::list::{OrNull, Vector};
use super::json::object::defaults;
use super::json::range::{ANY, NOT_NEGATIVE, from_to};
use super::json::scalar::Count;
use crate::math::Vec3;

keys! {
    /// How the cloth is moved.
    pub struct Sim {
        /// Frames per second of simulated time; results are taken once a frame.
        fps: f64 => [90.0] from_to(1e-6, 1e9).unit("frames/s");
        /// Steps of the simulation in each frame: a step lasts 1 / (fps · steps_per_frame) seconds.
        ///
        /// `T` of the method.
        steps_per_frame: u32 => [30] Count(1, 1_000_000_000);
        /// The acceleration of every point, `[x, y, z]`.
        gravity: Vec3 => [Vec3::new(0.0, -9.8, 0.0)] Vector(ANY.unit("m/s²"));
        /// The scheme that moves the points. No implicit method was as accurate as `verlet` for the same
        /// work at any stiffness that was tried, and fewer implicit steps can cost more (`docs/findings.md`).
        integrator: Integrator => [Integrator::Verlet] choice::<Integrator>();
        /// Passes over the springs in a step of `xpbd`; no other integrator reads it.
        ///
        /// More steps help more than more passes do.
        iterations: u32 => [1] Count(1, 1_000_000);
        /// Share of the forces that `implicit_euler` and `bdf2` may leave unbalanced at the end of a step; no
        /// other integrator reads it.
        ///
        /// On the stock cloth the default is within 1 % of the error of an exact solution at 600 and 2700 steps a
        /// second.
        tolerance: f64 => [1e-4] from_to(1e-15, 1.0);
        /// The arithmetic of the positions.
        precision: Precision => [Precision::F64] choice::<Precision>();
        /// How `verlet` starts from rest; no other integrator reads it.
        start: Start => [Start::Report] choice::<Start>();
        /// What `cloth.damping` is a share of.
        damping: Damping => [Damping::PerStep] choice::<Damping>();
        /// The strain at which the stretch limit shortens a spring again: 0.1 is 10 %. `null` turns it off.
        stretch_limit: Option<f64> => [Some(0.1)] OrNull(NOT_NEGATIVE);
        /// Passes of the stretch limit in each step. One leaves some springs longer than the limit.
        stretch_passes: u32 => [1] Count(1, 1_000_000);
        /// Which pairs of points are kept apart.
        self_collision: SelfCollision => [SelfCollision::SameBox] choice::<SelfCollision>();
        /// What is guaranteed for points that touch an object.
        contact: Contact => [Contact::Report] choice::<Contact>();
    }
}

choices! {
    /// The scheme that advances the positions (`sim.integrator`).
    ///
    /// docs/integrators.md has the error of each on the stock pinned2 cloth, docs/findings.md on stiffer ones. For the same work no
    /// implicit method was as accurate as Verlet's scheme at any stiffness that was tried, and fewer implicit steps
    /// can cost more, because each takes more iterations.
    pub enum Integrator {
        /// Position Verlet, the scheme of the course. It is explicit: stable for short steps only, which is checked
        /// before the first step.
        Verlet = "verlet",
        /// The classical Runge-Kutta method, fourth order, four evaluations of the forces in a step. It is explicit:
        /// stable for short steps only, which is checked before the first step.
        ///
        /// `src/integrator/rk4.rs`.
        Rk4 = "rk4",
        /// Extended position-based dynamics, first order. It is never refused, but is wrong and gains energy where its
        /// `sim.iterations` are too few; then the run is stopped.
        ///
        /// `src/integrator/xpbd.rs`.
        Xpbd = "xpbd",
        /// Implicit Euler, first order, solved to `sim.tolerance`. It is stable for every step and loses energy.
        ///
        /// `src/integrator/implicit_euler.rs`.
        ImplicitEuler = "implicit_euler",
        /// The second backward differentiation formula, second order, solved to `sim.tolerance`. It is stable for every
        /// step.
        ///
        /// `src/integrator/bdf2.rs`.
        Bdf2 = "bdf2",
    }
}

choices! {
    /// The arithmetic of the positions (`sim.precision`).
    pub enum Precision {
        /// binary64, as in the course.
        F64 = "f64",
        /// binary32, for `verlet` only: for comparison, not for speed.
        ///
        /// It is used for positions, displacements and forces of [`Integrator::Verlet`], in displacement
        /// form: `src/integrator/verlet_f32.rs`. Measured on the stock pinned2 cloth without limit and
        /// self-collision, at 0.5 s, against binary64: at most 2.5e-6 m apart at 30 steps a frame, 7.4e-6 m
        /// at 120 and 3.4e-5 m at 480. It saves about a twentieth of the time.
        F32 = "f32",
    }
}

choices! {
    /// How the first step knows the velocity (`sim.start`), of [`Integrator::Verlet`] only: the others have
    /// it at the start, where it is 0.
    pub enum Start {
        /// As in the course, with an error in proportion to the step.
        ///
        /// `last = x`: first order.
        Report = "report",
        /// Second order, at no cost.
        ///
        /// `last = x - v dt + f dt² / (2 m)` at speed v = 0. Free fall then falls by
        /// `g t² / 2` exactly without damping, where the report's start is off by `g dt t / 2`. Measured on an undamped
        /// hanging cloth of 8 x 8 points at 0.2 s and 30 steps a frame: 2.1e-7 m off instead of 3.7e-4 m.
        HalfStep = "half_step",
    }
}

choices! {
    /// What the damping percentage refers to (`sim.damping`).
    pub enum Damping {
        /// Of the motion in a step, as in the course: twice the steps damp twice as much.
        ///
        /// The share of a displacement, or of a velocity, that each step takes.
        PerStep = "per_step",
        /// A rate per second, which does not depend on the steps, and equals `per_step` at 2700 steps a second.
        ///
        /// The rate is `c = -2700 ln(1 - damping / 100)` per second; as a force `-c m v` at the middle of the step,
        /// second order, and at the end of the step for integrators other than Verlet's scheme.
        /// Free fall ends at `g / c` for every number of steps. Measured on a hanging cloth of 8 x 8
        /// points at 0.2 s, with the half-step start: 2.4e-7 m off at 30 steps a frame; with damping
        /// per step it is another cloth, 35 mm off at 10 and 71 mm at 120 steps a frame.
        PerSecond = "per_second",
    }
}

choices! {
    /// How pairs of points that are too close are found (`sim.self_collision`).
    pub enum SelfCollision {
        /// Those within one cell of a coarse grid, as in the course, which misses some.
        SameBox = "same_box",
        /// All that are too close, as comparing each point with every other would find.
        ///
        /// `src/collision/neighbors.rs`.
        Neighbors = "neighbors",
        /// None.
        Off = "off",
    }
}

choices! {
    /// What is guaranteed for points that touch an object (`sim.contact`).
    pub enum Contact {
        /// Nothing, as in the course: friction and the stretch limit leave some points a little inside.
        Report = "report",
        /// No point is inside an object after a step; where objects overlap, a point may be inside all but the last.
        ///
        /// After every step no free point is inside a sphere, or on the other side of a plane than it
        /// started, except by rounding: `src/collision/contact.rs`.
        Outside = "outside",
        /// Inelastic contact with Coulomb friction: contact takes energy and never adds any, slides and holds alike
        /// for every number of steps, and nothing passes through an object, however fast (`docs/contact.md`).
        ///
        /// The points' way in a step is swept against the objects; at a hit the normal part of the velocity ends, and
        /// the tangential part is reduced by at most μ times the normal impulse. Self-collision likewise:
        /// pushing apart gives no speed, and approach ends. `src/collision/coulomb.rs`, `src/collision/pairs.rs`.
        Coulomb = "coulomb",
    }
}

impl Default for Sim {
    /// The simulation of a scene file that says nothing about it.
    fn default() -> Self {
        defaults(Self::read)
    }
}
