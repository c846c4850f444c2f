//! How large a step the springs stand, known before the first one.
//!
//! A vibration of angular frequency ω under Verlet's scheme with the part `d` of the displacement
//! lost per step obeys `z² - (2 - d - (dt ω)²) z + (1 - d) = 0`; both roots stay inside the unit
//! circle iff `(dt ω)² < 4 - 2 d` (Jury's criterion). ω² is an eigenvalue of the stiffness matrix
//! over the mass, so the largest eigenvalue decides. With damping per second at the rate c it is
//! `(1 + h) z² - (2 - (dt ω)²) z + (1 - h) = 0` with h = c dt / 2, and the bound 4 for every c.
//!
//! A spring of stiffness k, length l and rest length l0 in direction n has the stiffness matrix
//! `k (n nᵀ + (1 - l0 / l)(I - n nᵀ))`.
//! - *At rest* it is `k n nᵀ`. On an endless square lattice with every kind of spring the largest
//!   eigenvalue is 8 ks, at the wave in which neighbouring columns move against each other. For a
//!   given cloth it is found by power iteration.
//! - *In any configuration* it is at most `k I`, so the scalar lattice bounds it: with
//!   P = sin²(p/2) and Q = sin²(q/2) of the wave numbers p and q, the structural springs give
//!   4 ks (P + Q), the shearing springs 8 ks (P + Q - 2 P Q) and the bending springs
//!   3.2 ks (P (1 - P) + Q (1 - Q)). The largest sum is 12 ks with structural and shearing
//!   springs, at P = 1, Q = 0, where bending adds nothing.

use super::grid::{Grid, Pins, start};
use super::springs::Springs;
use super::{Constants, Points, dot};
use crate::error::Result;
use crate::math::splitmix64;
use crate::scene::{Cloth, Damping, Sim, Vec3};

/// Points along each side of the part of a cloth whose vibrations are computed. A part vibrates
/// no faster than the whole, and at this size less than 0.1 % slower.
const PART: usize = 64;

/// Rounds of the power iteration.
const ROUNDS: usize = 200;

/// The fastest vibrations of a cloth against its step.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Stability {
    /// Mass of a point, in kg.
    pub mass: f64,
    /// Step, in seconds.
    pub dt: f64,
    /// Largest `dt ω` that is still stable: `sqrt(4 - 2 d)`, or 2 with damping per second.
    pub limit: f64,
    /// Angular frequency of the fastest vibration of the cloth at rest, in rad/s; never too large.
    pub omega_rest: f64,
    /// Angular frequency that no configuration of the cloth exceeds, in rad/s.
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
            limit: match sim.damping {
                Damping::PerStep => (4.0 - 2.0 * cloth.damping / 100.0).sqrt(),
                Damping::PerSecond => 2.0,
            },
            omega_rest: (rest_eigenvalue(&part(cloth))? / mass).sqrt(),
            omega_safe: (safe_eigenvalue(cloth) / mass).sqrt(),
            fps: sim.fps,
        })
    }

    /// Whether the cloth is unstable even at rest, so that it is certain to blow up.
    pub fn is_unstable_at_rest(&self) -> bool {
        self.dt * self.omega_rest >= self.limit
    }

    /// Whether the springs are stable in every configuration.
    pub fn is_always_stable(&self) -> bool {
        self.dt * self.omega_safe < self.limit
    }

    /// The fewest steps per frame at which a vibration of `omega` rad/s is stable.
    pub fn fewest_steps(&self, omega: f64) -> f64 {
        (omega / (self.fps * self.limit)).floor() + 1.0
    }
}

/// The corner of `cloth` with at most [`PART`] points along each side, spaced as in the whole.
fn part(cloth: &Cloth) -> Cloth {
    let mut part = cloth.clone();
    if cloth.num_width_points > PART {
        part.num_width_points = PART;
        part.width = cloth.width * (PART - 1) as f64 / (cloth.num_width_points - 1) as f64;
    }
    if cloth.num_height_points > PART {
        part.num_height_points = PART;
        part.height = cloth.height * (PART - 1) as f64 / (cloth.num_height_points - 1) as f64;
    }
    part.pinned.retain(|&[i, j]| i < part.num_width_points && j < part.num_height_points);
    part
}

/// The largest eigenvalue of the stiffness of `cloth` at rest, pinned points held, in N/m: found
/// by power iteration, so from below.
fn rest_eigenvalue(cloth: &Cloth) -> Result<f64> {
    let grid = Grid::new(cloth)?;
    let x = start(cloth, grid)?;
    let (springs, pins) = (Springs::new(cloth, grid, &x)?, Pins::new(cloth, grid)?);
    let mut moves = first_guess(grid)?;
    let mut pull = Points::zeros(grid.len())?;
    let mut eigenvalue = 0.0;
    for _ in 0..ROUNDS {
        normalise(&mut moves, &pins);
        apply_stiffness(&springs, &x, &moves, &mut pull);
        eigenvalue = inner(&moves, &pull);
        std::mem::swap(&mut moves, &mut pull);
    }
    Ok(eigenvalue)
}

/// Displacements close to the fastest vibration: neighbouring columns against each other along x,
/// neighbouring rows along y and z, and a little noise in case these are not it.
fn first_guess(grid: Grid) -> Result<Points> {
    let mut moves = Points::zeros(grid.len())?;
    for p in 0..grid.len() {
        let (i, j) = grid.column_row(p);
        let noise = (splitmix64(p as u64) >> 11) as f64 / (1_u64 << 53) as f64;
        moves.x[p] = if i % 2 == 0 { 1.0 } else { -1.0 } + 0.1 * noise;
        moves.y[p] = if j % 2 == 0 { 1.0 } else { -1.0 } + 0.1 * noise;
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

/// A bound of the eigenvalues of the stiffness of `cloth` in any configuration, in N/m.
fn safe_eigenvalue(cloth: &Cloth) -> f64 {
    let factor = match (cloth.enable_structural, cloth.enable_shearing, cloth.enable_bending) {
        (true, true, _) => 12.0,
        (true, false, _) | (false, true, _) => 8.0,
        (false, false, true) => 1.6,
        (false, false, false) => 0.0,
    };
    factor * cloth.ks
}
