//! The numbers of the method that stay the same from step to step.

use super::grid::Pins;
use super::springs::Springs;
use crate::math::ln;
use crate::scene::{Cloth, Sim, Vec3};

/// Mass, weight and step of a cloth's points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Params {
    /// Mass of a point, in kg: `width * height * density / W / H`.
    pub mass: f64,
    /// Step, in seconds: `1 / fps / T`.
    pub dt: f64,
    /// Weight of a point, in N.
    pub weight: Vec3,
    /// Steps per frame as a number: `T`.
    pub steps_per_frame: f64,
}

impl Params {
    /// The parameters of `cloth` moved as `sim` says.
    pub fn new(cloth: &Cloth, sim: &Sim) -> Self {
        let [w, h] = [cloth.num_width_points as f64, cloth.num_height_points as f64];
        let steps_per_frame = f64::from(sim.steps_per_frame);
        let mass = cloth.width * cloth.height * cloth.density / w / h;
        Self { mass, dt: 1.0 / sim.fps / steps_per_frame, weight: sim.gravity * mass, steps_per_frame }
    }
}

/// The parts of a cloth that stay the same over a run.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Model<'a> {
    pub(crate) springs: &'a Springs,
    pub(crate) pins: &'a Pins,
    pub(crate) params: &'a Params,
}

/// The steps a second at which a damping per second means what the report's means.
const REPORT_STEPS: f64 = 2700.0;

/// The rate c per second at which a damping of `percent` (below 100) slows points down: `v' = -c v`.
pub fn damping_rate(percent: f64) -> f64 {
    -ln(1.0 - percent / 100.0) * REPORT_STEPS
}
