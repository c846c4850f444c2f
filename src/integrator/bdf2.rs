//! The second backward differentiation formula (Curtiss and Hirschfelder 1952; for cloth Choi and
//! Ko 2002): `x' = (4 x - last) / 3 + β v'`, `v' = (4 v - v_last) / 3 + β f(x') / m`, `β = 2 dt / 3`. Second
//! order, stable for every step, and far less dissipative than implicit Euler.
//!
//! Damping per second is the drag `-c m v'` at the end of the step. Damping per step multiplies
//! velocities by the velocity retention r in each step: v by r, v_last, which is a step older, by r².
//!
//! The two-step formula needs two steps that it made itself. So a point that collisions, the stretch
//! limit or the user moved, and every point at the start, takes its next step by implicit Euler with the
//! velocity `(x - last) / dt`, and its history starts anew with that step. Where one point takes
//! such a step and its neighbour does not, their momentum is not conserved.

use super::damped_step::DampedStep;
use super::newton::Newton;
use super::{Integrator, StepBound};
use crate::cloth::springs::Springs;
use crate::cloth::{Counters, Model, Params, Points, damping_rate, filled};
use crate::error::Result;
use crate::scene::{Cloth, Damping, Sim, Vec3};

/// The integrator and its memory.
#[derive(Clone, Debug)]
pub(super) struct Bdf2 {
    newton: Newton,
    /// The step of implicit Euler.
    euler: DampedStep,
    /// β, in seconds.
    beta: f64,
    /// `1 + β c`, c the rate of damping per second.
    drag: f64,
    /// Part of the velocity that damping per step leaves.
    velocity_retention: f64,
    /// Velocities, those of the step before, in m/s, and the positions that the last step ended at.
    memory: [Points; 3],
    /// Whether the point has a history and the formula moves it, rather than implicit Euler.
    remembers: Vec<bool>,
    /// Where the points would be without velocity.
    start: Points,
    /// What damping changed of each point's displacement in the last step, in metres.
    damped: Points,
}

impl Integrator for Bdf2 {
    fn new(cloth: &Cloth, sim: &Sim, springs: &Springs) -> Result<Self> {
        let points = springs.grid.len();
        let zeros = || Points::zeros(points);
        let nowhere = Points { x: filled(points, f64::NAN)?, ..zeros()? };
        let beta = 2.0 / 3.0 * Params::new(cloth, sim).dt;
        let (drag, velocity_retention) = match sim.damping {
            Damping::PerStep => (1.0, 1.0 - cloth.damping / 100.0),
            Damping::PerSecond => (1.0 + beta * damping_rate(cloth.damping), 1.0),
        };
        Ok(Self {
            newton: Newton::new(cloth, sim, springs)?,
            euler: DampedStep::backward(cloth, sim),
            beta,
            drag,
            velocity_retention,
            memory: [zeros()?, zeros()?, nowhere],
            remembers: filled(points, false)?,
            start: zeros()?,
            damped: zeros()?,
        })
    }

    fn step_bound(_cloth: &Cloth, _damping: Damping, _dt: f64) -> Option<StepBound> {
        None
    }

    fn advance(&mut self, x: &mut Points, last: &mut Points, model: Model<'_>, work: &mut Counters) {
        let Model { pins, params, .. } = model;
        for p in pins.free.iter().cloned().flatten() {
            let (now, moved) = (x.get(p), x.get(p) - last.get(p));
            self.remembers[p] = now == self.memory[2].get(p);
            if self.remembers[p] {
                self.predict(p, now, last.get(p), params);
            } else {
                self.predict_anew(p, now, moved, params);
            }
            last.set(p, now);
            x.set(p, now + moved);
        }
        self.newton.solve(x, model, work);
        work.points_advanced += pins.free_points();
        for p in pins.free.iter().cloned().flatten() {
            self.remember(p, x.get(p), params);
        }
    }

    fn memory(&self) -> &[Points] {
        &self.memory
    }

    fn memory_mut(&mut self) -> &mut [Points] {
        &mut self.memory
    }

    fn reset_history(&mut self) {
        self.memory[2].x.fill(f64::NAN);
    }

    /// What moved the point after the step changed its velocity, too.
    fn displacement(&self, p: usize, x: Vec3, _last: Vec3, dt: f64) -> Vec3 {
        let [v, _, ended] = &self.memory;
        v.get(p) * dt + (x - ended.get(p))
    }

    fn forget(&mut self, p: usize) {
        self.memory[2].x[p] = f64::NAN;
    }

    fn decompose(&self, p: usize, before: Vec3, moved: Vec3, params: &Params) -> [Vec3; 2] {
        let undamped = params.dt * params.dt / params.mass;
        let damped = self.damped.get(p);
        [damped, (moved - before - damped) / undamped]
    }
}

impl Bdf2 {
    /// Sets up the two-step formula for point `p`.
    fn predict(&mut self, p: usize, x: Vec3, last: Vec3, params: &Params) {
        let Self { newton, beta, drag, velocity_retention, memory: [v, v_last, _], .. } = self;
        let start = (x * 4.0 - last) / 3.0;
        let free = (v.get(p) * 4.0 - v_last.get(p)) / 3.0;
        let r = *velocity_retention;
        let retained = (v.get(p) * (4.0 * r) - v_last.get(p) * (r * r)) / 3.0 / *drag;
        newton.target.set(p, start + retained * *beta);
        newton.matrix.inertia[p] = params.mass * *drag / (*beta * *beta);
        self.damped.set(p, (retained - free) * *beta);
        self.start.set(p, start);
    }

    /// Sets up implicit Euler for point `p`.
    fn predict_anew(&mut self, p: usize, x: Vec3, moved: Vec3, params: &Params) {
        self.newton.target.set(p, x + moved * self.euler.velocity_retention);
        self.newton.matrix.inertia[p] = 1.0 / self.euler.dt2_over_m;
        self.damped.set(p, moved * (self.euler.velocity_retention - 1.0));
        self.start.set(p, x);
        self.memory[0].set(p, moved / params.dt);
    }

    /// Records that the step of point `p` ended at `x`.
    fn remember(&mut self, p: usize, x: Vec3, params: &Params) {
        let (time, inertia) = if self.remembers[p] {
            (self.beta, params.mass / (self.beta * self.beta))
        } else {
            (params.dt, params.mass / (params.dt * params.dt))
        };
        // Without damping the same force would have moved the point by more.
        let by_force = x - self.newton.target.get(p);
        let damped = self.damped.get(p) + by_force * (1.0 - self.newton.matrix.inertia[p] / inertia);
        self.damped.set(p, damped);
        let [v, v_last, ended] = &mut self.memory;
        v_last.set(p, v.get(p));
        v.set(p, (x - self.start.get(p)) / time);
        ended.set(p, x);
    }
}
