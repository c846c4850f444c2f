//! The second backward differentiation formula (Curtiss and Hirschfelder 1952; for cloth Choi and
//! Ko 2002): `x' = (4 x - last) / 3 + β v'`, `v' = (4 v - v_last) / 3 + β f(x') / m`, `β = 2 dt / 3`. Second
//! order, stable for every step, and far less dissipative than implicit Euler.
//!
//! Damping per second is the drag `-c m v'` at the end of the step. Damping per step multiplies
//! velocities by `keep` each step: v by keep, v_last, which is a step older, by keep².
//!
//! The two-step formula cannot take in a corrected position. So a point that
//! collisions, the stretch limit or the user moved, and every point at the start, takes its next
//! step by implicit Euler with the velocity `(x - last) / dt`, and starts a new memory with it.
//! Beside a point that remembers, that step does not conserve their momentum.

use super::newton::Newton;
use super::springs::Springs;
use super::{Constants, Counters, Model, Points, damping_rate, filled};
use crate::error::Result;
use crate::scene::{Cloth, Damping, Sim, Vec3};

/// The integrator and its memory.
#[derive(Clone, Debug)]
pub(crate) struct Bdf2 {
    newton: Newton,
    /// β, in seconds.
    beta: f64,
    /// `1 + β c`, c the rate of damping per second.
    drag: f64,
    /// Part of the velocity that damping per step keeps.
    keep: f64,
    /// Velocities, those of the step before, in m/s, and the positions that the last step ended at.
    pub(crate) memory: [Points; 3],
    /// Whether the point has a memory and the formula moves it, rather than implicit Euler.
    remembers: Vec<bool>,
    /// Where the points would be without velocity.
    start: Points,
    /// What damping changed of each point's displacement in the last step, in metres.
    damped: Points,
}

impl Bdf2 {
    /// The integrator of `cloth`, which has `springs`, moved as `sim` says.
    ///
    /// # Errors
    /// [`crate::error::Kind::Scene`] when it does not fit in memory.
    pub(crate) fn new(cloth: &Cloth, sim: &Sim, springs: &Springs) -> Result<Self> {
        let points = springs.grid.len();
        let zeros = || Points::zeros(points);
        let nowhere = Points { x: filled(points, f64::NAN)?, ..zeros()? };
        let beta = 2.0 / 3.0 * Constants::new(cloth, sim).dt;
        let (drag, keep) = match sim.damping {
            Damping::PerStep => (1.0, 1.0 - cloth.damping / 100.0),
            Damping::PerSecond => (1.0 + beta * damping_rate(cloth.damping), 1.0),
        };
        Ok(Self {
            newton: Newton::new(sim.tolerance, springs)?,
            beta,
            drag,
            keep,
            memory: [zeros()?, zeros()?, nowhere],
            remembers: filled(points, false)?,
            start: zeros()?,
            damped: zeros()?,
        })
    }

    /// Lets every point begin anew.
    pub(crate) fn forget(&mut self) {
        self.memory[2].x.fill(f64::NAN);
    }

    /// Moves every unpinned point on by one step.
    pub(crate) fn advance(
        &mut self,
        x: &mut Points,
        last: &mut Points,
        model: Model<'_>,
        counters: &mut Counters,
    ) {
        let Model { pins, constants, .. } = model;
        for p in pins.free.iter().cloned().flatten() {
            let (now, moved) = (x.get(p), x.get(p) - last.get(p));
            self.remembers[p] = now == self.memory[2].get(p);
            if self.remembers[p] {
                self.aim(p, now, last.get(p), constants);
            } else {
                self.aim_anew(p, now, moved, constants);
            }
            last.set(p, now);
            x.set(p, now + moved);
        }
        self.newton.solve(x, model, counters);
        counters.points_advanced += pins.free_points();
        for p in pins.free.iter().cloned().flatten() {
            self.remember(p, x.get(p), constants);
        }
    }

    /// Sets up the formula for point `p`.
    fn aim(&mut self, p: usize, x: Vec3, last: Vec3, constants: &Constants) {
        let Self { newton, beta, drag, keep, memory: [v, v_last, _], .. } = self;
        let start = (x * 4.0 - last) / 3.0;
        let free = (v.get(p) * 4.0 - v_last.get(p)) / 3.0;
        let kept = (v.get(p) * (4.0 * *keep) - v_last.get(p) * (*keep * *keep)) / 3.0 / *drag;
        newton.target.set(p, start + kept * *beta);
        newton.matrix.inertia[p] = constants.mass * *drag / (*beta * *beta);
        self.damped.set(p, (kept - free) * *beta);
        self.start.set(p, start);
    }

    /// Sets up implicit Euler for point `p`.
    fn aim_anew(&mut self, p: usize, x: Vec3, moved: Vec3, constants: &Constants) {
        self.newton.target.set(p, x + moved * constants.keep);
        self.newton.matrix.inertia[p] = 1.0 / constants.a2;
        self.damped.set(p, moved * (constants.keep - 1.0));
        self.start.set(p, x);
        self.memory[0].set(p, moved / constants.dt);
    }

    /// Takes in that the step of point `p` ended at `x`.
    fn remember(&mut self, p: usize, x: Vec3, constants: &Constants) {
        let (time, inertia) = if self.remembers[p] {
            (self.beta, constants.mass / (self.beta * self.beta))
        } else {
            (constants.dt, constants.mass / (constants.dt * constants.dt))
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

    /// What damping changed of the displacement of point `p` in the last step, in metres.
    pub(crate) fn damped(&self, p: usize) -> Vec3 {
        self.damped.get(p)
    }
}
