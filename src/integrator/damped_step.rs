//! What damping does to a step of the form `x' = x + velocity_retention (x - last) + dt2_over_m f`.

use crate::cloth::{Params, damping_rate};
use crate::scene::{Cloth, Damping, Sim, Vec3};

/// The two factors of such a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct DampedStep {
    /// The part of its last displacement that a point repeats: `1 - damping / 100` with damping per step.
    pub(super) velocity_retention: f64,
    /// Displacement by a force, in m/N: `dt² / m` with damping per step.
    pub(super) dt2_over_m: f64,
}

impl DampedStep {
    /// Damping per second at the rate c is a drag in the middle of the step, as the velocity of Verlet's scheme
    /// is: `(1 - c dt / 2) / (1 + c dt / 2)` and `dt² / m / (1 + c dt / 2)`.
    pub(super) fn midpoint(cloth: &Cloth, sim: &Sim) -> Self {
        Self::new(cloth, sim, |c_dt| (1.0 - 0.5 * c_dt, 1.0 + 0.5 * c_dt))
    }

    /// Damping per second is a drag at the end of the step, as all forces of an implicit integrator are:
    /// `1 / (1 + c dt)` and `dt² / m / (1 + c dt)`.
    pub(super) fn backward(cloth: &Cloth, sim: &Sim) -> Self {
        Self::new(cloth, sim, |c_dt| (1.0, 1.0 + c_dt))
    }

    /// The factors where, with damping per second, `parts` gives of c dt the parts of a displacement before
    /// and after the step.
    fn new(cloth: &Cloth, sim: &Sim, parts: fn(f64) -> (f64, f64)) -> Self {
        let Params { mass, dt, .. } = Params::new(cloth, sim);
        let undamped = dt * dt / mass;
        match sim.damping {
            Damping::PerStep => {
                Self { velocity_retention: 1.0 - cloth.damping / 100.0, dt2_over_m: undamped }
            }
            Damping::PerSecond => {
                let (before, after) = parts(dt * damping_rate(cloth.damping));
                Self { velocity_retention: before / after, dt2_over_m: undamped / after }
            }
        }
    }

    /// [`super::Integrator::decompose`] for such a step.
    pub(super) fn decompose(&self, before: Vec3, moved: Vec3, params: &Params) -> [Vec3; 2] {
        let force = (moved - before * self.velocity_retention) / self.dt2_over_m;
        [self.drag(before, force, params), force]
    }

    /// What damping changed of the displacement of a point under `force` that moved by `before` in the step
    /// before, in metres.
    pub(super) fn drag(&self, before: Vec3, force: Vec3, params: &Params) -> Vec3 {
        let undamped = params.dt * params.dt / params.mass;
        before * (self.velocity_retention - 1.0) + force * (self.dt2_over_m - undamped)
    }
}
