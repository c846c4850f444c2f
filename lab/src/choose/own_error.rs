//! How wrong the positions of one run are, from one more run with twice the steps.

use serde::Serialize;

use super::level::{Outcome, Runner};
use crate::accuracy::measure::Measure;
use crate::accuracy::source::Source;
use drape::error::{Error, Kind, Result};
use drape::math;
use drape::scene::{Damping, Scene};
use drape::simulation::Simulation;

/// The steps per second at which damping per second takes as much as damping per step does.
const REPORT_RATE: f64 = 2700.0;

/// The estimated error of a run.
///
/// Where the error falls as the step, that of a run is twice its difference from one with half the step, and less where
/// it falls faster: 4/3 of it for a method of second order. Twice is what is told, and without a third run nobody knows
/// whether the error falls at all: beyond the [horizon](crate::horizon) it does not.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct OwnError {
    /// Root of the mean of the squared distances of the points from the limit of ever smaller steps, in metres.
    pub rms: f64,
    /// The largest distance of a point, in metres.
    pub max: f64,
    /// Steps per frame of the other run.
    pub steps_per_frame: u32,
}

impl OwnError {
    /// In words.
    pub fn text(self) -> String {
        let Self { rms, max, steps_per_frame } = self;
        format!(
            "about {rms:.1e} m root mean square, {max:.1e} m of a point: twice the distance from a run of \
             {steps_per_frame} steps a frame"
        )
    }
}

/// Estimates the error of `simulation`, a run of `scene`, read from `source`. `watch` is called after each frame of the
/// other run and can end it with an error.
///
/// The other run is one from the start. So the error of a simulation that went on from a state of the same scene, which
/// has the bits of one that never stopped, is that of the whole way.
///
/// The other run loses the same part of its velocity in a second: damping per step has no limit as the step shrinks,
/// but what the scene takes at its own step has one.
///
/// # Errors
/// Those of the scene and of `watch`; [`Kind::Unstable`] when the cloth blows up at twice the steps.
pub fn own_error(
    source: &Source,
    scene: &Scene,
    simulation: &Simulation,
    watch: &(dyn Fn() -> Result<()> + Sync),
) -> Result<OwnError> {
    let steps_per_frame = scene.sim.steps_per_frame.saturating_mul(2);
    let mut sets = vec![format!("sim.steps_per_frame={steps_per_frame}")];
    sets.extend(same_damping(scene).into_iter().flatten());
    let measure = Measure::Max;
    let runner = Runner::new(source, simulation.frame(), measure, watch);
    let Outcome::Done(finer) = runner.run_with(&sets, steps_per_frame)? else {
        let message =
            format!("the cloth blows up at {steps_per_frame} steps a frame, so its error is not known");
        return Err(Error::new(Kind::Unstable, message).with_help("`drape choose` looks for steps that do"));
    };
    let here = measure.shape(scene, simulation.positions())?;
    let twice = |measure: Measure| 2.0 * measure.distance(&here, &finer.shape);
    Ok(OwnError { rms: twice(Measure::Rms), max: twice(Measure::Max), steps_per_frame })
}

/// The changes that turn the damping per step of `scene` into damping per second that takes as much.
pub(super) fn same_damping(scene: &Scene) -> Option<[String; 2]> {
    let damping = scene.cloth.as_ref()?.damping;
    let per_step = scene.sim.damping == Damping::PerStep && damping > 0.0;
    let kept = math::pow(1.0 - damping / 100.0, rate(scene) / REPORT_RATE);
    per_step
        .then(|| ["sim.damping=per_second".to_owned(), format!("cloth.damping={:?}", 100.0 * (1.0 - kept))])
}

/// Whether damping per step takes what damping per second does with the same number.
pub(super) fn is_at_the_report_s_rate(scene: &Scene) -> bool {
    rate(scene) == REPORT_RATE
}

/// Steps per second.
fn rate(scene: &Scene) -> f64 {
    scene.sim.fps * f64::from(scene.sim.steps_per_frame)
}
