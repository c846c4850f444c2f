//! The classical Runge-Kutta method (Kutta 1901) on positions and velocities: fourth order, explicit, with four
//! evaluations of the forces in a step.
//!
//! Damping per second at the rate c is the drag `-c m v`, which counts as a force in each evaluation, so the method
//! keeps its order. Damping per step multiplies the velocity by the velocity retention before each step.
//!
//! The method remembers the velocity of each point. A point that collisions, the stretch limit or the user moved
//! after the last step, and every point at the start, takes the velocity `(x - last) / dt` instead, and its
//! memory starts anew with that.
//!
//! # The bound of the step
//! With μ = dt ω the method multiplies a mode `exp(λ t)` by `R(z) = 1 + z + z²/2 + z³/6 + z⁴/24`, `z = dt λ`. Without
//! damping z = ± i μ, and `|R|² = 1 - μ⁶/72 + μ⁸/576` is at most 1 up to μ = 2 √2.
//! - With damping per second z solves `z² + dt c z + μ² = 0`, and both |R(z)| have to be at most 1. Beyond
//!   `dt c` = 2.785 the velocity of the whole cloth grows, so no step is stable.
//! - With damping per step and the velocity retention r, a step multiplies (x, v / ω) by
//!   `[a, b r; -b, a r]`, where a + i b = R(i μ): `a = 1 - μ²/2 + μ⁴/24`, `b = μ - μ³/6`. By Jury's criterion both
//!   eigenvalues are at most 1 iff `r (a² + b²) <= 1` and `|a| (1 + r) <= 1 + r (a² + b²)`.
//!
//! In both cases the bound is the first μ at which that ends. It is the bound in motion, too: the method itself takes
//! energy from fast vibrations. A cloth of 12 × 12 points without damping gained none within 300 s at each of
//! μ = 2.80, 2.69, 2.55, 2.26, 1.98, 1.70 and 1.41 in motion.

use super::{Integrator, Resolution, StepBound};
use crate::cloth::forces::Forces;
use crate::cloth::grid::Pins;
use crate::cloth::springs::Springs;
use crate::cloth::{Counters, Model, Params, Points, damping_rate, filled};
use crate::error::Result;
use crate::scene::{Cloth, Damping, Sim, Vec3};

/// One of the four evaluations.
#[derive(Clone, Copy)]
struct Stage {
    /// What its slopes count in the sums.
    weight: f64,
    /// The part of the step from the start to the next stage, along its slopes.
    to_next: f64,
}

/// The stages of a step.
const STAGES: [Stage; 4] = [
    Stage { weight: 1.0, to_next: 0.5 },
    Stage { weight: 2.0, to_next: 0.5 },
    Stage { weight: 2.0, to_next: 1.0 },
    Stage { weight: 1.0, to_next: 0.0 },
];

/// The integrator and its memory.
#[derive(Clone, Debug)]
pub(super) struct Rk4 {
    /// The rate c of damping per second.
    drag: f64,
    /// The part of the velocity that damping per step leaves.
    velocity_retention: f64,
    forces: Forces,
    /// Velocities, in m/s, and the positions that the last step ended at.
    memory: [Points; 2],
    /// Velocities at the stage.
    velocity: Points,
    /// Weighted sums of the velocities and the accelerations of the stages so far.
    sums: [Points; 2],
    /// What damping changed of each point's displacement in the step, in metres.
    damped: Points,
}

impl Integrator for Rk4 {
    fn new(cloth: &Cloth, sim: &Sim, springs: &Springs) -> Result<Self> {
        let points = springs.grid.len();
        let zeros = || Points::zeros(points);
        let nowhere = Points { x: filled(points, f64::NAN)?, ..zeros()? };
        Ok(Self {
            drag: drag(cloth, sim.damping),
            velocity_retention: velocity_retention(cloth, sim.damping),
            forces: Forces::new(springs)?,
            memory: [zeros()?, nowhere],
            velocity: zeros()?,
            sums: [zeros()?, zeros()?],
            damped: zeros()?,
        })
    }

    fn step_bound(cloth: &Cloth, damping: Damping, dt: f64) -> Option<StepBound> {
        let bound = match damping {
            _ if cloth.damping == 0.0 => 8.0_f64.sqrt(),
            Damping::PerStep => bound_per_step(velocity_retention(cloth, damping)),
            Damping::PerSecond => bound_per_second(dt * drag(cloth, damping)),
        };
        Some(StepBound { at_rest: bound, in_motion: bound })
    }

    fn advance(&mut self, x: &mut Points, last: &mut Points, model: Model<'_>, work: &mut Counters) {
        let Model { springs, pins, params } = model;
        for p in pins.free.iter().cloned().flatten() {
            self.start(p, x.get(p), last.get(p), params.dt);
            last.set(p, x.get(p));
        }
        for stage in STAGES {
            self.forces.compute(x, springs, params.weight.into(), work);
            self.add_stage(x, last, model, stage);
        }
        self.end(x, last, pins, params.dt / 6.0);
        work.points_advanced += pins.free_points();
    }

    fn memory(&self) -> &[Points] {
        &self.memory
    }

    fn memory_mut(&mut self) -> &mut [Points] {
        &mut self.memory
    }

    fn reset_history(&mut self) {
        self.memory[1].x.fill(f64::NAN);
    }

    fn resolution(&self) -> Resolution {
        Resolution { unit: f64::EPSILON, keeps_velocity: true }
    }

    /// What moved the point after the step changed its velocity, too.
    fn displacement(&self, p: usize, x: Vec3, _last: Vec3, dt: f64) -> Vec3 {
        let [v, ended] = &self.memory;
        v.get(p) * dt + (x - ended.get(p))
    }

    fn forget(&mut self, p: usize) {
        self.memory[1].x[p] = f64::NAN;
    }

    fn decompose(&self, p: usize, before: Vec3, moved: Vec3, params: &Params) -> [Vec3; 2] {
        let damped = self.damped.get(p);
        [damped, (moved - before - damped) * (params.mass / (params.dt * params.dt))]
    }
}

impl Rk4 {
    /// Sets up the step of point `p`, which is at `x` and came from `last`.
    fn start(&mut self, p: usize, x: Vec3, last: Vec3, dt: f64) {
        let [v, ended] = &mut self.memory;
        let before = if x == ended.get(p) { v.get(p) } else { (x - last) / dt };
        let retained = before * self.velocity_retention;
        v.set(p, retained);
        self.velocity.set(p, retained);
        self.damped.set(p, (retained - before) * dt);
        self.sums.iter_mut().for_each(|sum| sum.set(p, Vec3::zeros()));
    }

    /// Adds the slopes at a stage with the points at `x` to the sums, and moves on to the next stage.
    fn add_stage(&mut self, x: &mut Points, last: &Points, model: Model<'_>, stage: Stage) {
        let Model { pins, params: Params { mass, dt, .. }, .. } = model;
        let Stage { weight, to_next } = stage;
        let (drag, step) = (self.drag, to_next * dt);
        // The last stage adds to the velocity at the end of the step, and not to the displacement.
        let damped_by = if to_next > 0.0 { -drag * dt * dt / 6.0 } else { 0.0 };
        let [sum_v, sum_a] = self.sums.each_mut().map(Points::components_mut);
        let components = x.components_mut().into_iter().zip(last.components());
        let velocities = self.memory[0].components().into_iter().zip(self.velocity.components_mut());
        let sums = sum_v.into_iter().zip(sum_a);
        let forces = self.forces.sum().components().into_iter().zip(self.damped.components_mut());
        for ((((x, last), (start, v)), (sum_v, sum_a)), (force, damped)) in
            components.zip(velocities).zip(sums).zip(forces)
        {
            for p in pins.free.iter().cloned().flatten() {
                let acceleration = force[p] / mass - v[p] * drag;
                sum_v[p] += v[p] * weight;
                sum_a[p] += acceleration * weight;
                damped[p] += v[p] * damped_by;
                x[p] = last[p] + v[p] * step;
                v[p] = start[p] + acceleration * step;
            }
        }
    }

    /// Ends the step: a sixth of the step times the sums is added to the positions and velocities at its start.
    fn end(&mut self, x: &mut Points, last: &Points, pins: &Pins, sixth: f64) {
        let Self { memory: [v, ended], sums: [sum_v, sum_a], .. } = self;
        for p in pins.free.iter().cloned().flatten() {
            x.set(p, last.get(p) + sum_v.get(p) * sixth);
            v.set(p, v.get(p) + sum_a.get(p) * sixth);
            ended.set(p, x.get(p));
        }
    }
}

/// The rate c of damping per second; 0 with damping per step.
fn drag(cloth: &Cloth, damping: Damping) -> f64 {
    match damping {
        Damping::PerStep => 0.0,
        Damping::PerSecond => damping_rate(cloth.damping),
    }
}

/// The part of the velocity that damping per step leaves; all with damping per second.
fn velocity_retention(cloth: &Cloth, damping: Damping) -> f64 {
    match damping {
        Damping::PerStep => 1.0 - cloth.damping / 100.0,
        Damping::PerSecond => 1.0,
    }
}

/// The bound under the velocity retention `r`.
fn bound_per_step(r: f64) -> f64 {
    first_unstable(|mu| is_stable_per_step(mu, r))
}

/// The bound under `drag` = dt c; 0 where even what does not vibrate is unstable.
fn bound_per_second(drag: f64) -> f64 {
    if growth([-drag, 0.0]) > 1.0 { 0.0 } else { first_unstable(|mu| is_stable_per_second(mu, drag)) }
}

/// The first μ at which `is_stable` is no longer true; it is true near 0, and never at 4.
fn first_unstable(is_stable: impl Fn(f64) -> bool) -> f64 {
    let (mut low, mut high) = (0.0, 4.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        *if is_stable(middle) { &mut low } else { &mut high } = middle;
    }
    low
}

/// Whether no mode of μ grows under the velocity retention `r`.
fn is_stable_per_step(mu: f64, r: f64) -> bool {
    let y = mu * mu;
    // a² + b² - 1
    let growth = y * y * y * (y / 8.0 - 1.0) / 72.0;
    let a = 1.0 - y / 2.0 + y * y / 24.0;
    r * growth <= 1.0 - r && a.abs() * (1.0 + r) <= 1.0 + r + r * growth
}

/// Whether no mode of μ grows under `drag` = dt c.
fn is_stable_per_second(mu: f64, drag: f64) -> bool {
    let (half, square) = (0.5 * drag, 0.25 * drag * drag - mu * mu);
    if square < 0.0 {
        return growth([-half, (-square).sqrt()]) <= 1.0;
    }
    [-half - square.sqrt(), -half + square.sqrt()].iter().all(|&z| growth([z, 0.0]) <= 1.0)
}

/// `|R(z)|²` of z = x + i y.
fn growth([x, y]: [f64; 2]) -> f64 {
    // R(z) = 1 + z (1 + z/2 (1 + z/3 (1 + z/4)))
    let [re, im] = [4.0, 3.0, 2.0, 1.0]
        .iter()
        .fold([1.0, 0.0], |[re, im], n| [1.0 + (x * re - y * im) / n, (x * im + y * re) / n]);
    re * re + im * im
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The largest eigenvalue of a step of `x' = v, v' = -μ² x - drag v`, taken stage by stage, after `v` was
    /// multiplied by `r`.
    fn spectral_radius(mu: f64, drag: f64, r: f64) -> f64 {
        let slope = |[x, v]: [f64; 2]| [v, -mu * mu * x - drag * v];
        let step = |start: [f64; 2]| {
            let (mut at, mut sum) = (start, [0.0; 2]);
            for Stage { weight, to_next } in STAGES {
                let k = slope(at);
                sum = [sum[0] + weight * k[0], sum[1] + weight * k[1]];
                at = [start[0] + to_next * k[0], start[1] + to_next * k[1]];
            }
            [start[0] + sum[0] / 6.0, start[1] + sum[1] / 6.0]
        };
        let ([a, c], [b, d]) = (step([1.0, 0.0]), step([0.0, r]));
        let (half_trace, determinant) = (0.5 * (a + d), a * d - b * c);
        let square = half_trace * half_trace - determinant;
        if square < 0.0 { determinant.sqrt() } else { half_trace.abs() + square.sqrt() }
    }

    /// Every step up to the bound is stable, and a step right after it is not.
    #[test]
    fn the_bound_is_where_the_first_mode_grows() {
        let per_step = [1e-6, 0.002, 0.1, 0.5, 0.9, 0.95, 0.98, 0.999, 1.0].map(|d| (0.0, 1.0 - d));
        let per_second = [1e-6, 0.002, 0.1, 0.5, 1.0, 2.0, 2.7].map(|drag| (drag, 1.0));
        for (drag, r) in per_step.into_iter().chain(per_second) {
            let bound = if drag > 0.0 { bound_per_second(drag) } else { bound_per_step(r) };
            assert!((2.0..3.7).contains(&bound), "drag {drag}, retention {r}: {bound}");
            for part in 1..=1000 {
                let mu = bound * f64::from(part) / 1000.0;
                let radius = spectral_radius(mu, drag, r);
                assert!(radius <= 1.0 + 1e-12, "drag {drag}, retention {r}, {mu}: {radius}");
            }
            assert!(spectral_radius(1.0001 * bound, drag, r) > 1.0, "drag {drag}, retention {r}: {bound}");
        }
        assert!((bound_per_step(1.0) - 8.0_f64.sqrt()).abs() < 1e-12);
        assert_eq!(bound_per_second(2.8), 0.0, "the drag alone is too much");
    }
}
