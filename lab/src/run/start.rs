//! The start of a simulation. A step that is certain to fail is an error before the first step.

use super::stability::may_deform;
use super::warning::Warning;
use drape::cloth::Points;
use drape::diagnostics::advice::unstable_at_rest;
use drape::diagnostics::stability::Stability;
use drape::error::{Error, Kind, Result};
use drape::scene::Scene;
use drape::simulation::{Simulation, Unresolved};

/// The simulation of `scene` at its start, or with its points at `x` if that is given, which will be advanced by
/// `frames` frames; and what is doubtful about it.
///
/// A cloth that may blow up while the stretch limit hides it gets a ledger, which detects that.
///
/// # Errors
/// [`Kind::Unstable`] when the cloth is certain to blow up or not to move at all, unless `allow_unstable`;
/// otherwise as [`Simulation::starting_at`].
pub fn start(
    scene: &Scene,
    frames: u64,
    x: Option<&Points>,
    allow_unstable: bool,
) -> Result<(Simulation, Option<Warning>)> {
    let mut simulation = Simulation::starting_at(scene, x)?;
    if allow_unstable {
        simulation.allow_unstable();
    }
    let Some(cloth) = scene.cloth.as_ref().filter(|_| frames > 0) else { return Ok((simulation, None)) };
    if let Some(error) = stuck(&simulation, frames as f64 / scene.sim.fps).filter(|_| !allow_unstable) {
        return Err(error);
    }
    let Some(stability) = Stability::of_bounded(cloth, &scene.sim)? else { return Ok((simulation, None)) };
    let steps = scene.sim.steps_per_frame;
    if stability.is_unstable_at_rest() {
        let error = unstable_at_rest(&stability, cloth.ks, steps);
        if !allow_unstable {
            return Err(error);
        }
        return Ok((simulation, Some(Warning { message: error.message, help: error.help })));
    }
    if stability.is_always_stable() {
        return Ok((simulation, None));
    }
    if !allow_unstable && scene.sim.stretch_limit.is_some() {
        simulation.record_ledger()?;
    }
    Ok((simulation, Some(may_deform(&stability, steps))))
}

/// The error of a step so short that it is lost in the rounding of the positions.
fn stuck(simulation: &Simulation, time: f64) -> Option<Error> {
    let Unresolved { point: (i, j), axis, fall, rounding } = simulation.unresolved(time)?;
    let axis = ["x", "y", "z"][axis];
    let message = format!(
        "stuck before the first step: gravity moves point ({i}, {j}) by {fall:.3e} m along {axis} in a step, \
         and its position is rounded to {rounding:.3e} m"
    );
    let help = "lower steps_per_frame or fps, or move the cloth nearer to the origin\nor simulate all the same with --allow-unstable";
    Some(Error::new(Kind::Unstable, message).with_help(help))
}
