//! The cloth: a grid of point masses joined by springs, and the phases of one step.
//!
//! The model is that of Provot, "Deformation constraints in a mass-spring model to describe rigid
//! cloth behavior" (1995), stepped by Verlet's scheme. Every phase keeps the order of operations
//! of the published method, so two programs that follow it agree in every bit. All numbers are
//! binary64; nothing here uses more than + - × ÷ and the square root.
//!
//! Other integrators ([`crate::scene::Integrator`]) take the place of Verlet's scheme, on the same
//! springs and before the same other phases. For each of them the velocity of a point between two
//! steps is `(x - last) / dt`: `x` after the phases of this step, `last` after those of the step
//! before, so that collisions and the stretch limit change velocities as under Verlet's scheme.
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
//! - a distance of 2 · thickness between points (pairs across a cell border are never seen);
//! - no point inside a sphere or below a plane (friction moves along a chord, and the stretch
//!   limit comes after the objects);
//! - mirror symmetry and independence of the springs' order, once the stretch limit acts;
//! - time reversal with damping, contact or the stretch limit;
//! - the same cloth at another number of steps per frame (damping is per step).
//!
//! Some have a cure that a scene can ask for: `sim.damping` for the number of steps,
//! `sim.self_collision` for distances, `sim.contact` for points inside objects, more
//! `sim.stretch_passes` for strain. `sim.start` makes the first step second order. The defaults are
//! the published method's.
//!
//! # Why the sign of a zero never shows
//! `x` and `last` are never -0.0: no scene starts a point there, and every update is `x + something` or
//! `x - something`, which is -0.0 only if `x` was. So a force of +0.0 instead
//! of -0.0 leaves the same positions, and a spring that is absent may be added as a zero.

use crate::error::{Error, Kind, Result};
use crate::math::ln;
use crate::scene::{Cloth, Damping, Integrator, Sim, Vec3};
use grid::Pins;
use springs::Springs;

pub(crate) mod bdf2;
mod conjugate_gradients;
pub mod energy;
pub(crate) mod forces;
mod gather;
pub mod grid;
pub(crate) mod guard;
pub(crate) mod implicit_euler;
pub mod ledger;
pub mod measure;
mod newton;
pub(crate) mod pieces;
mod real;
pub mod rest;
pub(crate) mod single;
pub mod springs;
pub mod stability;
mod stiffness;
pub(crate) mod stretch_limit;
pub(crate) mod verlet;
pub(crate) mod xpbd;

/// One vector per point of the cloth, as a structure of arrays of equal length.
/// Point (i, j) is entry `j * W + i` of each array.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Points<T = f64> {
    /// First components.
    pub x: Vec<T>,
    /// Second components.
    pub y: Vec<T>,
    /// Third components.
    pub z: Vec<T>,
}

impl<T: Clone + Default> Points<T> {
    /// `len` zero vectors of numbers of any type.
    ///
    /// # Errors
    /// [`Kind::Scene`] when they do not fit in memory.
    pub(crate) fn filled(len: usize) -> Result<Self> {
        let [x, y, z] = [(); 3].map(|()| filled(len, T::default()));
        Ok(Self { x: x?, y: y?, z: z? })
    }

    /// The three components.
    pub(crate) fn components(&self) -> [&[T]; 3] {
        [&self.x, &self.y, &self.z]
    }

    /// The three components, to be changed.
    pub(crate) fn components_mut(&mut self) -> [&mut [T]; 3] {
        [&mut self.x, &mut self.y, &mut self.z]
    }
}

impl Points {
    /// `len` zero vectors.
    ///
    /// # Errors
    /// [`Kind::Scene`] when they do not fit in memory.
    pub fn zeros(len: usize) -> Result<Self> {
        Self::filled(len)
    }

    /// Takes the vectors of `other`, which has as many, without new memory.
    pub(crate) fn copy_from(&mut self, other: &Self) {
        self.x.copy_from_slice(&other.x);
        self.y.copy_from_slice(&other.y);
        self.z.copy_from_slice(&other.z);
    }

    /// How many points there are.
    pub fn len(&self) -> usize {
        self.x.len()
    }

    /// Whether there is no point.
    pub fn is_empty(&self) -> bool {
        self.x.is_empty()
    }

    /// The vector of point `index` (below [`Points::len`]).
    pub fn get(&self, index: usize) -> Vec3 {
        Vec3::new(self.x[index], self.y[index], self.z[index])
    }

    /// Gives point `index` (below [`Points::len`]) another vector.
    pub fn set(&mut self, index: usize, value: Vec3) {
        self.x[index] = value.x;
        self.y[index] = value.y;
        self.z[index] = value.z;
    }
}

/// The numbers of the method that stay the same from step to step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Constants {
    /// Mass of a point, in kg: `width * height * density / W / H`.
    pub mass: f64,
    /// Step, in seconds: `1 / fps / T`.
    pub dt: f64,
    /// Displacement by a force in one step, in m/N: `dt² / mass`, and with damping
    /// per second at the rate c that over `1 + c dt / 2` for Verlet, over `1 + c dt` for others.
    pub a2: f64,
    /// What a step multiplies a point's displacement by: `1 - damping / 100`, and with damping per
    /// second `(1 - c dt / 2) / (1 + c dt / 2)` for Verlet, `1 / (1 + c dt)` for others.
    pub keep: f64,
    /// Weight of a point, in N.
    pub weight: Vec3,
    /// Steps per frame as a number: `T`.
    pub steps_per_frame: f64,
}

impl Constants {
    /// The constants of `cloth` moved as `sim` says.
    pub fn new(cloth: &Cloth, sim: &Sim) -> Self {
        let [w, h] = [cloth.num_width_points as f64, cloth.num_height_points as f64];
        let steps_per_frame = f64::from(sim.steps_per_frame);
        let mass = cloth.width * cloth.height * cloth.density / w / h;
        let dt = 1.0 / sim.fps / steps_per_frame;
        let weight = sim.gravity * mass;
        let report =
            Self { mass, dt, a2: dt * dt / mass, keep: 1.0 - cloth.damping / 100.0, weight, steps_per_frame };
        match (sim.damping, sim.integrator) {
            (Damping::PerStep, _) => report,
            // The drag is taken at the middle of the step, as the velocity of Verlet's scheme is.
            (Damping::PerSecond, Integrator::Verlet) => {
                let half = 0.5 * dt * damping_rate(cloth.damping);
                Self { a2: report.a2 / (1.0 + half), keep: (1.0 - half) / (1.0 + half), ..report }
            }
            // The drag is taken at the end of the step, as all forces of these are.
            (Damping::PerSecond, _) => {
                let whole = dt * damping_rate(cloth.damping);
                Self { a2: report.a2 / (1.0 + whole), keep: 1.0 / (1.0 + whole), ..report }
            }
        }
    }
}

/// The parts of a cloth that stay the same over a run.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Model<'a> {
    pub(crate) springs: &'a Springs,
    pub(crate) pins: &'a Pins,
    pub(crate) constants: &'a Constants,
}

/// The steps a second at which a damping per second means what the report's means.
const REPORT_STEPS: f64 = 2700.0;

/// The rate c per second at which a damping of `percent` (below 100) slows points down: `v' = -c v`.
pub fn damping_rate(percent: f64) -> f64 {
    -ln(1.0 - percent / 100.0) * REPORT_STEPS
}

/// What was done since the start, counted. The counts depend on the scene alone, not on the
/// machine or the number of threads.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize)]
pub struct Counters {
    /// Steps made.
    pub steps: u64,
    /// Springs whose force, or whose part of a product with the stiffness matrix, was computed. What
    /// makes the matrix, once for some tens of products, is not counted.
    pub springs_evaluated: u64,
    /// Steps of an implicit integrator that left more than `sim.tolerance` of the forces unbalanced.
    pub unsolved_steps: u64,
    /// Points that the integrator moved on.
    pub points_advanced: u64,
    /// Cells of two or more points that self-collision searched.
    pub boxes_searched: u64,
    /// Pairs of points that shared a cell, or lay in neighbouring ones, once a step.
    pub pairs_tested: u64,
    /// Points that self-collision moved.
    pub self_collision_moves: u64,
    /// Points tested against an object, once for each object.
    pub object_tests: u64,
    /// Times that an object moved a point.
    pub object_moves: u64,
    /// Springs that the stretch limit looked at, once a pass.
    pub springs_checked: u64,
    /// Springs that the stretch limit shortened.
    pub springs_limited: u64,
}

/// `a · b`, summed from left to right.
pub(crate) fn dot(a: Vec3, b: Vec3) -> f64 {
    a.x * b.x + a.y * b.y + a.z * b.z
}

/// Length of `a`.
pub(crate) fn len(a: Vec3) -> f64 {
    dot(a, a).sqrt()
}

/// `len` copies of `value`, or an error where memory does not suffice.
pub(crate) fn filled<T: Clone>(len: usize, value: T) -> Result<Vec<T>> {
    let mut values = Vec::new();
    values.try_reserve_exact(len).map_err(|_| too_large())?;
    values.resize(len, value);
    Ok(values)
}

/// The error of a cloth with more points than memory holds.
pub(crate) fn too_large() -> Error {
    Error::new(Kind::Scene, "the cloth has more points than fit in memory")
        .with_help("lower cloth.num_width_points or cloth.num_height_points")
}
