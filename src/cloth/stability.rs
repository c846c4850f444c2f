//! The largest step at which the springs are stable, known before the first one.
//!
//! A vibration of angular frequency ω under Verlet's scheme with the part `d` of the displacement
//! lost per step obeys `z² - (2 - d - (dt ω)²) z + (1 - d) = 0`; both roots lie inside the unit
//! circle, or on it without damping, iff `(dt ω)² < 4 - 2 d` (Jury's criterion). ω² is an eigenvalue of the stiffness matrix
//! over the mass, so the largest eigenvalue decides. With damping per second at the rate c it is
//! `(1 + h) z² - (2 - (dt ω)²) z + (1 - h) = 0` with h = c dt / 2, and the bound 4 for every c.
//!
//! A spring of stiffness k, length l and rest length l0 in direction n has the stiffness matrix
//! `k (n nᵀ + (1 - l0 / l)(I - n nᵀ))`.
//! - *At rest* it is `k n nᵀ`. On an endless square lattice with every kind of spring the largest
//!   eigenvalue is 8 ks, at the wave in which neighbouring columns move against each other, and no
//!   part of it has more. For a given cloth it is found by power iteration with its pins held, so
//!   from below, on the whole grid or on a part of it: a part vibrates no faster than the whole.
//!   With a side beyond `PART` points the part is `PART` points long and free of pins, and its
//!   eigenvalue less than 0.5 % below that of the endless lattice (0.1 % with every kind of
//!   spring). Where the pins leave no such part it is the whole grid, with as many rounds as
//!   `WORK` allows.
//! - *At worst*, in any shape, it is at most `k I`, so the scalar lattice bounds it: with
//!   P = sin²(p/2) and Q = sin²(q/2) of the wave numbers p and q, the structural springs give
//!   4 ks (P + Q), the shearing springs 8 ks (P + Q - 2 P Q) and the bending springs
//!   3.2 ks (P (1 - P) + Q (1 - Q)). The largest sum is 12 ks with structural and shearing
//!   springs, at P = 1, Q = 0, where bending adds nothing.
//!
//! Both bounds are for small vibrations about a shape that stands still. A cloth in motion changes
//! its shape as it vibrates, and that can feed a vibration below the bound: Verlet's scheme has
//! resonances of third and fourth order at `dt ω` = √3 and √2 (Skeel, Zhang and Schlick 1997). A cloth
//! of 12 × 12 points without damping gained energy within 300 s at each of 1.98, 1.85, 1.78 and 1.71
//! at worst, and at none of 1.60, 1.50 and 1.41. So without damping the bound at worst is √2. With
//! damping, even of 0.05 %, no cloth was found that gains energy below its bound at worst.

use std::f64::consts::SQRT_2;

use super::grid::{Grid, Pins, start};
use super::springs::Springs;
use super::{Constants, Points, dot, filled};
use crate::error::Result;
use crate::math::splitmix64;
use crate::scene::{Cloth, Damping, Sim, Vec3};

/// Points along each side of the part of a large cloth whose vibrations are computed.
const PART: usize = 64;

/// Most rounds of the power iteration.
const ROUNDS: usize = 200;

/// Points times rounds of the power iteration on the whole of a large cloth: about a second.
const WORK: usize = 10_000_000;

/// The fastest vibrations of a cloth against its step.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Stability {
    /// Mass of a point, in kg.
    pub mass: f64,
    /// Step, in seconds.
    pub dt: f64,
    /// Largest `dt ω` that is still stable: `sqrt(4 - 2 d)`, or 2 with damping per second.
    pub limit: f64,
    /// The same for a cloth in motion: `limit`, or √2 without damping.
    pub limit_worst: f64,
    /// Angular frequency of the fastest vibration of the cloth at rest, in rad/s; never too large.
    pub omega_rest: f64,
    /// Angular frequency that no shape of the cloth exceeds, in rad/s.
    pub omega_safe: f64,
    /// Frames per second.
    fps: f64,
}

impl Stability {
    /// The stability of `cloth` moved as `sim` says.
    ///
    /// # Errors
    /// [`crate::error::Kind::Scene`] for a cloth that no simulation accepts.
    pub fn new(cloth: &Cloth, sim: &Sim) -> Result<Self> {
        let Constants { mass, dt, .. } = Constants::new(cloth, sim);
        Ok(Self {
            mass,
            dt,
            limit: limit(cloth, sim),
            limit_worst: limit_worst(cloth, sim),
            omega_rest: (rest_eigenvalue(cloth)? / mass).sqrt(),
            omega_safe: (safe_eigenvalue(cloth) / mass).sqrt(),
            fps: sim.fps,
        })
    }

    /// Whether the cloth is unstable even at rest: any disturbance grows until it blows up.
    pub fn is_unstable_at_rest(&self) -> bool {
        self.dt * self.omega_rest >= self.limit
    }

    /// Whether small vibrations about any shape are stable, and without damping free of the resonances of
    /// low order that the module describes.
    pub fn is_always_stable(&self) -> bool {
        self.dt * self.omega_safe < self.limit_worst
    }

    /// The fewest steps per frame at which the cloth is not unstable at rest.
    pub fn fewest_steps_rest(&self) -> f64 {
        (self.omega_rest / (self.fps * self.limit)).floor() + 1.0
    }

    /// The fewest steps per frame at which it is [`Stability::is_always_stable`].
    pub fn fewest_steps_worst(&self) -> f64 {
        (self.omega_safe / (self.fps * self.limit_worst)).floor() + 1.0
    }
}

/// As [`Stability::is_always_stable`], without the work that the cloth at rest takes.
pub fn is_always_stable(cloth: &Cloth, sim: &Sim) -> bool {
    let Constants { mass, dt, .. } = Constants::new(cloth, sim);
    dt * (safe_eigenvalue(cloth) / mass).sqrt() < limit_worst(cloth, sim)
}

/// The largest `dt ω` that is still stable.
fn limit(cloth: &Cloth, sim: &Sim) -> f64 {
    match sim.damping {
        Damping::PerStep => (4.0 - 2.0 * cloth.damping / 100.0).sqrt(),
        Damping::PerSecond => 2.0,
    }
}

/// The largest `dt ω` that is stable for a cloth in motion.
fn limit_worst(cloth: &Cloth, sim: &Sim) -> f64 {
    if cloth.damping > 0.0 { limit(cloth, sim) } else { SQRT_2 }
}

/// The largest eigenvalue of the stiffness of `cloth` at rest, pinned points held, in N/m: never
/// too large.
fn rest_eigenvalue(cloth: &Cloth) -> Result<f64> {
    let grid = Grid::new(cloth)?;
    let (x, pins) = (start(cloth, grid)?, Pins::new(cloth, grid)?);
    let part = Grid { width: grid.width.min(PART), height: grid.height.min(PART) };
    match free_part(grid, part, &pins)? {
        Some(corner) if part != grid => {
            let free = Pins { pinned: filled(part.len(), false)?, ..Pins::default() };
            fastest(cloth, part, &copied(&x, grid, corner, part)?, &free, ROUNDS)
        }
        _ => fastest(cloth, grid, &x, &pins, (WORK / grid.len()).clamp(4, ROUNDS)),
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

/// The points of the part of `grid` whose first point is `corner`.
fn copied(x: &Points, grid: Grid, corner: usize, part: Grid) -> Result<Points> {
    let mut points = Points::zeros(part.len())?;
    for p in 0..part.len() {
        let (i, j) = part.column_row(p);
        points.set(p, x.get(corner + j * grid.width + i));
    }
    Ok(points)
}

/// The largest eigenvalue of the stiffness of points at `x` that are joined as those of `cloth`, in
/// N/m: found by `rounds` rounds of power iteration, so from below.
fn fastest(cloth: &Cloth, grid: Grid, x: &Points, pins: &Pins, rounds: usize) -> Result<f64> {
    let springs = Springs::new(cloth, grid, x)?;
    let mut moves = first_guess(cloth, grid)?;
    let mut pull = Points::zeros(grid.len())?;
    let mut eigenvalue = 0.0;
    for _ in 0..rounds {
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
