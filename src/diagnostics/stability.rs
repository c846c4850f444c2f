//! Whether the step is short enough for the springs, known before the first one.
//!
//! An explicit integrator is stable while dt ω stays below its bound ([`crate::integrator`] derives each),
//! ω the angular frequency of the fastest vibration. ω² is an eigenvalue of the stiffness matrix over the
//! mass, so the largest eigenvalue decides.
//!
//! A spring of stiffness k, length l and rest length l0 in direction n has the stiffness matrix
//! `k (n nᵀ + (1 - l0 / l)(I - n nᵀ))`.
//! - *At rest* it is `k n nᵀ`. On an endless square lattice with every kind of spring the largest
//!   eigenvalue is 8 ks, at the wave in which neighbouring columns move against each other, and no
//!   part of it has more. For a given cloth it is found by power iteration with its pins held, so
//!   from below, on the whole grid or on a part of it: a part vibrates no faster than the whole.
//!   With a side beyond `PART` points the part is `PART` points long and free of pins, and its
//!   eigenvalue less than 0.5 % below that of the endless lattice (0.1 % with every kind of
//!   spring). Where the pins leave no such part it is the whole grid, with as many iterations as
//!   `WORK` allows.
//! - *At worst*, in any shape, it is at most `k I`, so the scalar lattice bounds it: with
//!   P = sin²(p/2) and Q = sin²(q/2) of the wave numbers p and q, the structural springs give
//!   4 ks (P + Q), the shearing springs 8 ks (P + Q - 2 P Q) and the bending springs
//!   3.2 ks (P (1 - P) + Q (1 - Q)). The largest sum is 12 ks with structural and shearing
//!   springs, at P = 1, Q = 0, where bending adds nothing.

use crate::cloth::grid::{Grid, Pins, start_of};
use crate::cloth::springs::Springs;
use crate::cloth::{Params, Points, filled};
use crate::error::Result;
use crate::integrator::{StepBound, step_bound, verlet_step_bound};
use crate::math::dot;
use crate::math::splitmix64;
use crate::scene::{Cloth, Sim, Vec3};

/// Points along each side of the part of a large cloth whose vibrations are computed.
const PART: usize = 64;

/// Most iterations of the power method.
const ITERATIONS: usize = 200;

/// Points times iterations of the power method on the whole of a large cloth: about a second.
const WORK: usize = 10_000_000;

/// The fastest vibrations of a cloth against its step. For an integrator that is stable at every step, the bounds are
/// those of Verlet's scheme, for comparison.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Stability {
    /// Mass of a point, in kg.
    pub mass: f64,
    /// Step, in seconds.
    pub dt: f64,
    /// Largest `dt ω` that is stable for small vibrations about a shape at rest.
    pub limit: f64,
    /// Largest `dt ω` that is stable for a cloth in motion.
    pub limit_worst: f64,
    /// Angular frequency of the fastest vibration of the cloth at rest, in rad/s; never too large.
    pub omega_rest: f64,
    /// Angular frequency that no shape of the cloth exceeds, in rad/s.
    pub omega_safe: f64,
    /// Frames per second.
    pub fps: f64,
    /// The fewest steps per frame at rest and in motion.
    #[serde(skip)]
    fewest: [f64; 2],
}

impl Stability {
    /// The stability of `cloth` moved as `sim` says.
    ///
    /// # Errors
    /// [`crate::error::Kind::Scene`] for a cloth that no simulation accepts.
    pub fn new(cloth: &Cloth, sim: &Sim) -> Result<Self> {
        let Params { mass, dt, .. } = Params::new(cloth, sim);
        let StepBound { at_rest, in_motion } = bound(cloth, sim, dt);
        let omega_rest = (rest_eigenvalue(cloth)? / mass).sqrt();
        let omega_safe = safe_omega(cloth, mass);
        let fewest = [
            fewest_steps(cloth, sim, omega_rest, |bound| bound.at_rest),
            fewest_steps(cloth, sim, omega_safe, |bound| bound.in_motion),
        ];
        let (limit, limit_worst, fps) = (at_rest, in_motion, sim.fps);
        Ok(Self { mass, dt, limit, limit_worst, omega_rest, omega_safe, fps, fewest })
    }

    /// The same, if the integrator of `sim` has a bound; `None` if it is stable at every step.
    ///
    /// # Errors
    /// As [`Stability::new`].
    pub fn of_bounded(cloth: &Cloth, sim: &Sim) -> Result<Option<Self>> {
        has_step_bound(cloth, sim).then(|| Self::new(cloth, sim)).transpose()
    }

    /// Whether the cloth is unstable even at rest: any disturbance grows until it blows up.
    pub fn is_unstable_at_rest(&self) -> bool {
        self.dt * self.omega_rest >= self.limit
    }

    /// Whether the step is below the bound for a cloth in motion, in any shape.
    pub fn is_always_stable(&self) -> bool {
        self.dt * self.omega_safe < self.limit_worst
    }

    /// The fewest steps per frame at which the cloth is not unstable at rest.
    pub fn fewest_steps_rest(&self) -> f64 {
        self.fewest[0]
    }

    /// The fewest steps per frame at which it is [`Stability::is_always_stable`].
    pub fn fewest_steps_worst(&self) -> f64 {
        self.fewest[1]
    }
}

/// Whether the integrator of `sim` has a longest stable step.
pub fn has_step_bound(cloth: &Cloth, sim: &Sim) -> bool {
    step_bound(cloth, sim, Params::new(cloth, sim).dt).is_some()
}

/// As [`Stability::is_always_stable`], without the work that the cloth at rest takes.
pub fn is_always_stable(cloth: &Cloth, sim: &Sim) -> bool {
    let Params { mass, dt, .. } = Params::new(cloth, sim);
    dt * safe_omega(cloth, mass) < bound(cloth, sim, dt).in_motion
}

/// Whether the integrator of `sim` has a longest stable step, and the step is shorter in any shape of the
/// cloth.
pub(super) fn is_bounded_and_always_stable(cloth: &Cloth, sim: &Sim) -> bool {
    has_step_bound(cloth, sim) && is_always_stable(cloth, sim)
}

/// The bound of the integrator of `sim`, or that of Verlet's scheme.
fn bound(cloth: &Cloth, sim: &Sim, dt: f64) -> StepBound {
    step_bound(cloth, sim, dt).unwrap_or_else(|| verlet_step_bound(cloth, sim.damping))
}

/// The fewest steps per frame at which `dt omega` is below the bound that `pick` picks.
fn fewest_steps(cloth: &Cloth, sim: &Sim, omega: f64, pick: fn(StepBound) -> f64) -> f64 {
    let dt = |steps: f64| 1.0 / sim.fps / steps;
    let limit = |steps: f64| pick(bound(cloth, sim, dt(steps)));
    let now = limit(f64::from(sim.steps_per_frame));
    let steps = (omega / (sim.fps * now)).floor() + 1.0;
    if now > 0.0 && limit(steps) == now {
        return steps;
    }
    // The bound depends on the step: between a number of steps that is too few and one that is not.
    let (mut few, mut enough) = (0.0, 1.0);
    while dt(enough) * omega >= limit(enough) && enough < f64::MAX / 2.0 {
        (few, enough) = (enough, 2.0 * enough);
    }
    loop {
        let middle = (0.5 * (few + enough)).floor();
        if middle <= few {
            return enough;
        }
        *if dt(middle) * omega < limit(middle) { &mut enough } else { &mut few } = middle;
    }
}

/// The largest eigenvalue of the stiffness of `cloth` at rest, pinned points held, in N/m: never
/// too large.
fn rest_eigenvalue(cloth: &Cloth) -> Result<f64> {
    let grid = Grid::new(cloth)?;
    let pins = Pins::new(cloth, grid)?;
    let part = Grid { width: grid.width.min(PART), height: grid.height.min(PART) };
    match free_part(grid, part, &pins)? {
        Some(corner) if part != grid => {
            let free = Pins { pinned: filled(part.len(), false)?, ..Pins::default() };
            fastest(cloth, part, &start_of_part(cloth, grid, corner, part)?, &free, ITERATIONS)
        }
        _ => {
            let iterations = (WORK / grid.len()).clamp(4, ITERATIONS);
            fastest(cloth, grid, &start_of_part(cloth, grid, 0, grid)?, &pins, iterations)
        }
    }
}

/// The first point of the first part of `grid`, of the size of `part`, in which no point is pinned.
fn free_part(grid: Grid, part: Grid, pins: &Pins) -> Result<Option<usize>> {
    // How many points are free without a gap: up each column from this row, and then how many
    // columns in which that is enough stand side by side.
    let mut free_rows = filled(grid.width, 0_usize)?;
    for j in 0..grid.height {
        let mut wide = 0;
        for (i, rows) in free_rows.iter_mut().enumerate() {
            let p = j * grid.width + i;
            *rows = if pins.pinned[p] { 0 } else { *rows + 1 };
            wide = if *rows >= part.height { wide + 1 } else { 0 };
            if wide == part.width {
                return Ok(Some(p - (part.height - 1) * grid.width - (part.width - 1)));
            }
        }
    }
    Ok(None)
}

/// Where the points of the part of `grid` start whose first point is `corner`.
fn start_of_part(cloth: &Cloth, grid: Grid, corner: usize, part: Grid) -> Result<Points> {
    let mut points = Points::zeros(part.len())?;
    for p in 0..part.len() {
        let (i, j) = part.column_row(p);
        points.set(p, start_of(cloth, grid, corner + j * grid.width + i));
    }
    Ok(points)
}

/// The largest eigenvalue of the stiffness of points at `x` that are joined as those of `cloth`, in
/// N/m: found by so many `iterations` of the power method, so from below.
fn fastest(cloth: &Cloth, grid: Grid, x: &Points, pins: &Pins, iterations: usize) -> Result<f64> {
    let springs = Springs::new(cloth, grid, x)?;
    let mut moves = first_guess(cloth, grid)?;
    let mut pull = Points::zeros(grid.len())?;
    let mut eigenvalue = 0.0;
    for _ in 0..iterations {
        normalise(&mut moves, pins);
        apply_stiffness(&springs, x, &moves, &mut pull);
        eigenvalue = inner(&moves, &pull);
        std::mem::swap(&mut moves, &mut pull);
    }
    Ok(eigenvalue)
}

/// Displacements close to the fastest vibration: neighbouring columns against each other along x,
/// neighbouring rows along y and z, and a little noise in case these are not it. Bending springs
/// alone join every other point, so with them alone it is every other column or row.
fn first_guess(cloth: &Cloth, grid: Grid) -> Result<Points> {
    let apart = if cloth.enable_structural || cloth.enable_shearing { 1 } else { 2 };
    let side = |index: usize| if (index / apart).is_multiple_of(2) { 1.0 } else { -1.0 };
    let mut moves = Points::zeros(grid.len())?;
    for p in 0..grid.len() {
        let (i, j) = grid.column_row(p);
        let noise = (splitmix64(p as u64) >> 11) as f64 / (1_u64 << 53) as f64;
        moves.x[p] = side(i) + 0.1 * noise;
        moves.y[p] = side(j) + 0.1 * noise;
        moves.z[p] = moves.y[p];
    }
    Ok(moves)
}

/// Holds the pinned points and scales `moves` to length 1; zeros stay.
fn normalise(moves: &mut Points, pins: &Pins) {
    for p in (0..moves.len()).filter(|&p| pins.pinned[p]) {
        moves.set(p, Vec3::zeros());
    }
    let length = inner(moves, moves).sqrt();
    if length > 0.0 {
        for p in 0..moves.len() {
            moves.set(p, moves.get(p) / length);
        }
    }
}

/// `pull` = stiffness at rest times `moves`: each spring resists what its ends move along it.
fn apply_stiffness(springs: &Springs, x: &Points, moves: &Points, pull: &mut Points) {
    (0..pull.len()).for_each(|p| pull.set(p, Vec3::zeros()));
    for family in &springs.families {
        for a in family.points(springs.grid).filter(|&a| family.rest[a] > 0.0) {
            let b = a - family.offset;
            let n = (x.get(b) - x.get(a)) / family.rest[a];
            let force = n * (family.stiffness * dot(moves.get(a) - moves.get(b), n));
            pull.set(a, pull.get(a) + force);
            pull.set(b, pull.get(b) - force);
        }
    }
}

/// Sum over the points of `a · b`.
fn inner(a: &Points, b: &Points) -> f64 {
    (0..a.len()).map(|p| dot(a.get(p), b.get(p))).sum()
}

/// The angular frequency that no shape of `cloth` exceeds, in rad/s, for points of `mass`.
fn safe_omega(cloth: &Cloth, mass: f64) -> f64 {
    (safe_eigenvalue(cloth) / mass).sqrt()
}

/// A bound of the eigenvalues of the stiffness of `cloth` in any shape, in N/m.
fn safe_eigenvalue(cloth: &Cloth) -> f64 {
    let factor = match (cloth.enable_structural, cloth.enable_shearing, cloth.enable_bending) {
        (true, true, _) => 12.0,
        (true, false, _) | (false, true, _) => 8.0,
        (false, false, true) => 1.6,
        (false, false, false) => 0.0,
    };
    factor * cloth.ks
}
