//! The energy bound: the most energy that a cloth can have if only its forces move it.
//!
//! Springs, gravity and damping never add energy, and the energy of springs is never negative. So
//! `kinetic + gravitational <= total at the start`, up to the allowances below, and a run that exceeds this was not
//! moved by forces. The check takes a pass over the points once a frame. Integrators other than Verlet's scheme
//! may gain energy and keep it in the springs, so for them the energy of the springs counts too: with
//! one pass a step xpbd gave 2.5e5 J to the springs of a cloth that fell. The stretch limit hides a
//! blow-up from every other check: it keeps strains at 10 % and all numbers finite.
//!
//! The allowances, with M the mass of the cloth and g the size of gravity:
//! - the error of the finite step: once more the energy of motion and of the springs at the
//!   start, `M g L / 2` for a cloth with sides of at most L, and `M (g dt)²`;
//! - self-collision pushes points at the distance l apart by `(2 thickness - l) / T` in a step. One
//!   push gives at most the speed `2 thickness fps`: `M (2 thickness fps)² / 2`, and the energy of the springs that
//!   it stretches to `2 thickness`. Pushes add up while l grows, and then give back what brought the
//!   points together; but where neighbours start too close, nothing did: for each such point
//!   `m (2 thickness - l)² / (2 T dt²)`;
//! - rounding. It moves each end of a spring by up to 2⁻⁵³ of its place, in binary32 2⁻²⁴; and each point once a step,
//!   by a speed of that over dt, which in a million steps that do not depend on each other adds up to a thousand times
//!   as much. In binary32 positions do not round velocities, but the stretch limit moves what is rounded beyond it.
//!   Only a cloth that nothing else moves can have so little energy. Of a cloth that is so far away that rounding moves
//!   a point by more than a thousandth of L nothing is left, and no more is allowed for.
//!
//! Objects have none: contact only takes energy. So a run in which the speed that `report` and `outside` give to a point
//! when they put it on a surface adds up to more than the rest of the bound ends in an error, too. Under `coulomb`
//! pushes give no speed, and points that start too close are not pushed.
//!
//! A blow-up that the stretch limit holds below this bound is visible only in the energy ledger: in every
//! step the springs put in what the limit takes out. So where a ledger is recorded, what springs and
//! gravity have put in must not exceed the same allowance either. With fewer steps than are stable at rest
//! they put in more than that within a second. Without a ledger such a blow-up is missed; the
//! command line records one whenever the cloth may become unstable behind a stretch limit.
//!
//! Where the step is below the integrator's bound in motion ([`crate::diagnostics::stability`]), the ledger is not
//! checked: no blow-up was found there, but what the springs put in has no bound. Each correction of the
//! stretch limit is a kick that they answer by up to `1 / (1 - (dt ω / 2)²)` times its energy, and a cloth that is
//! so heavy that the limit bears it is corrected in every step for as long as it hangs
//! (`docs/stability.md` has the runs).

use super::energy::Energy;
use super::ledger::Ledger;
use super::stability::is_bounded_and_always_stable;
use crate::cloth::grid::Grid;
use crate::cloth::springs::Springs;
use crate::cloth::{Params, Points};
use crate::math::length;
use crate::scene::{Cloth, Contact, Precision, Scene, SelfCollision};

/// Largest coordinate, in metres: as large as any number that a scene may hold.
pub(crate) const RANGE: f64 = 1e15;

/// The part of the largest energy that rounding may add.
const ROUNDING: f64 = 1e-9;

/// The part of the cloth's longer side by which rounding may move a point.
const RESOLVED: f64 = 1e-3;

/// How many steps of rounding are allowed for.
const MOST_STEPS: f64 = 1e6;

/// The part of the bound that a scene gives, whatever the start.
#[derive(Clone, Debug)]
pub(crate) struct Allowance {
    /// For the finite step and self-collision, in J.
    fixed: f64,
    grid: Grid,
    /// Distance that self-collision keeps, in metres; 0 without it.
    distance: f64,
    /// Whether what springs and gravity put in is bounded, too.
    bounds_exchange: bool,
    /// Whether contact is `coulomb`.
    coulomb: bool,
    /// Energy of a point and its springs for the square of what rounding moves it by, in N/m.
    rounding: f64,
    /// What rounding moves a point by, as a part of its place.
    unit: f64,
    /// The most that it may move a point by, in metres.
    most_rounded: f64,
}

impl Allowance {
    /// The allowance of the cloth of `scene`, which has `springs`.
    pub(crate) fn new(scene: &Scene, cloth: &Cloth, springs: &Springs, params: &Params) -> Self {
        let Params { mass, dt, .. } = *params;
        let (all, g) = (mass * springs.grid.len() as f64, length(scene.sim.gravity));
        let coulomb = scene.sim.contact == Contact::Coulomb;
        let distance = match scene.sim.self_collision {
            SelfCollision::Off => 0.0,
            _ if coulomb => 0.0,
            _ => 2.0 * cloth.thickness,
        };
        let side = cloth.width.max(cloth.height);
        let mut fixed = all * g * (0.5 * side + g * dt * dt);
        fixed += motion(all, distance / params.steps_per_frame / dt) + stretched_to(distance, springs);
        let bounds_exchange = !is_bounded_and_always_stable(cloth, &scene.sim);
        // A point owns six springs, and each may be longer by 2 √3 times the rounding of a coordinate.
        let rounding = 36.0 * cloth.ks + MOST_STEPS * motion(mass, 1.0 / dt);
        let most_rounded = RESOLVED * side;
        let unit = match scene.sim.precision {
            Precision::F64 => 0.5 * f64::EPSILON,
            Precision::F32 => 0.5 * f64::from(f32::EPSILON),
        };
        Self { fixed, grid: springs.grid, distance, bounds_exchange, coulomb, rounding, unit, most_rounded }
    }

    /// The bound of a cloth that starts at `x` with `energy`.
    pub(crate) fn energy_bound(&self, x: &Points, energy: Energy, params: &Params) -> EnergyBound {
        let mut allowance = self.fixed + energy.kinetic + energy.spring;
        let Params { dt, steps_per_frame, .. } = *params;
        for p in 0..x.len() {
            let depth = (self.distance - nearest_neighbor(self.grid, x, p)).max(0.0);
            allowance += motion(params.mass, depth / (dt * steps_per_frame.sqrt()));
            let rounded = (self.unit * x.get(p).amax()).min(self.most_rounded);
            allowance += self.rounding * rounded * rounded;
        }
        let Self { bounds_exchange, coulomb, .. } = *self;
        EnergyBound { start: energy.total(), allowance, bounds_exchange, coulomb }
    }
}

/// Distance of point `p` from the nearest of those beside it in its row and column, in metres.
fn nearest_neighbor(grid: Grid, x: &Points, p: usize) -> f64 {
    let (i, j) = grid.column_row(p);
    let left = (i > 0).then(|| p - 1);
    let right = (i + 1 < grid.width).then_some(p + 1);
    let above = (j > 0).then(|| p - grid.width);
    let below = (j + 1 < grid.height).then_some(p + grid.width);
    let beside = [left, right, above, below].into_iter().flatten();
    beside.map(|q| length(x.get(p) - x.get(q))).fold(f64::INFINITY, f64::min)
}

/// The kinetic energy of `mass` at `speed`, in J.
fn motion(mass: f64, speed: f64) -> f64 {
    0.5 * mass * speed * speed
}

/// The most energy that a cloth can have.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct EnergyBound {
    /// Total energy at the start, in J.
    start: f64,
    /// What may come on top, in J.
    allowance: f64,
    /// Whether it bounds what springs and gravity put in, too.
    bounds_exchange: bool,
    coulomb: bool,
}

impl EnergyBound {
    /// The most that points may have in motion and height together, in J, where the energies are
    /// of the sizes in `energy`.
    pub(crate) fn limit(&self, energy: Energy) -> f64 {
        let size = energy.kinetic + energy.spring + energy.gravitational.abs() + self.start.abs();
        self.start + self.allowance + ROUNDING * size
    }

    /// The most that springs and gravity may have put in together, in J, where the energies are of
    /// the sizes in `energy`.
    pub(crate) fn exchange_limit(&self, energy: Energy) -> f64 {
        self.limit(energy) - self.start
    }

    /// What springs and gravity put in together, in J. Under `coulomb` less what contact took: of a point at rest it
    /// takes in every step what gravity gave it.
    pub(crate) fn put_in(&self, ledger: Ledger) -> f64 {
        let colliders: f64 = ledger.colliders.entries().map(|(_, energy)| energy).sum();
        let taken = if self.coulomb { ledger.self_collision + colliders } else { 0.0 };
        ledger.gravity + ledger.springs + taken
    }

    /// Whether springs and gravity put in more than they can.
    pub(crate) fn is_exceeded_by_exchange(&self, ledger: Ledger, energy: Energy) -> bool {
        self.bounds_exchange && self.put_in(ledger) > self.exchange_limit(energy)
    }

    /// Whether `energy`, with or without the springs', is more than there can be.
    pub(crate) fn is_exceeded(&self, energy: Energy) -> bool {
        energy.total() > self.limit(energy)
    }
}

/// The energy of all springs that are shorter than `length` at rest, stretched to it, in J.
fn stretched_to(length: f64, springs: &Springs) -> f64 {
    let mut energy = 0.0;
    for family in &springs.families {
        for a in family.points(springs.grid) {
            let strain = (length - family.rest[a]).max(0.0);
            energy += 0.5 * family.stiffness * strain * strain;
        }
    }
    energy
}

/// The first point with a coordinate that is no number or beyond [`RANGE`].
pub(crate) fn first_lost(x: &Points) -> Option<usize> {
    // A comparison with no number is false.
    let is_there = |p: usize| x.get(p).iter().all(|component| component.abs() <= RANGE);
    (0..x.len()).find(|&p| !is_there(p))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn components_that_are_infinite_undefined_or_too_far_are_found() {
        for bad in [f64::INFINITY, f64::NEG_INFINITY, f64::NAN, 1.001e15, -1e300] {
            let mut points = Points::zeros(5).unwrap();
            points.y[2] = RANGE;
            assert_eq!(first_lost(&points), None, "all are in range");
            points.z[3] = bad;
            points.x[4] = bad;
            assert_eq!(first_lost(&points), Some(3), "{bad}");
        }
    }
}
