//! The cloth: a grid of point masses joined by springs, and the phases of one step.
//!
//! The model is that of Provot, "Deformation constraints in a mass-spring model to describe rigid
//! cloth behavior" (1995), stepped by Verlet's scheme. Every phase keeps the order of operations
//! of the published method, so two programs that follow it agree in every bit. All numbers are
//! binary64; nothing here uses more than + - × ÷ and the square root.
//!
//! Other integrators ([`crate::integrator`]) take the place of Verlet's scheme, on the same springs
//! and before the same other phases. Between two steps the velocity of a point is `(x - last) / dt`:
//! `x` after the phases of this step, `last` after those of the step before, so that collisions and
//! the stretch limit change velocities as they do under Verlet's scheme.
//!
//! Point (i, j) of a grid of `W` × `H` points has index `j * W + i`. Positions are in metres.
//!
//! # What this method does not promise
//! Its phases move points without the integrator knowing. So these do **not** hold, and no test
//! asks for them:
//! - momentum, once two points collide (the correction is one-sided and divided by the steps);
//! - angular momentum, once the stretch limit acts (it moves the point at which a velocity acts);
//! - energy that only falls, once objects or self-collision act;
//! - strain of at most 10 % after the stretch limit (one pass leaves 13 % on the stock scenes);
//! - a distance of 2 · thickness between points (pairs across a box border are never seen);
//! - no point inside a sphere or below a plane (friction moves along a chord, and the stretch
//!   limit comes after the objects);
//! - contact that adds no energy (what a point is put back by becomes a velocity: the finer the step the worse);
//! - a slide along a plane that does not depend on the step (the way past the crossing point is lost);
//! - mirror symmetry and independence of the springs' order, once the stretch limit acts;
//! - time reversal with damping, contact or the stretch limit;
//! - the same cloth at another number of steps per frame (damping is per step).
//!
//! Some have a cure that a scene can ask for: `sim.damping` for the number of steps,
//! `sim.self_collision` for distances, `sim.contact` for points inside objects (`outside`) and for contact that
//! keeps the laws of inelastic contact with friction (`coulomb`, `docs/contact.md`), more
//! `sim.stretch_passes` for strain. `sim.start` makes the first step second order. The defaults are
//! the published method's.
//!
//! # Why the sign of a zero never shows
//! `x` and `last` are never -0.0: no scene starts a point there, and every update is `x + something` or
//! `x - something`, which is -0.0 only if `x` was. So a force of +0.0 instead
//! of -0.0 leaves the same positions, and a spring that is absent may be added as a zero.

pub(crate) mod accumulate;
pub(crate) mod chunks;
mod counters;
pub(crate) mod forces;
pub mod grid;
mod params;
mod points;
pub(crate) mod real;
pub mod springs;
mod stencil;
pub(crate) mod stretch_limit;
pub(crate) mod sweep;

pub use counters::Counters;
pub use params::{Params, damping_rate};
pub use points::Points;

pub(crate) use params::Model;
pub(crate) use points::{filled, too_large};
