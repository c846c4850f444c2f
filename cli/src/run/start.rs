//! The start of a simulation. A step that is certain to fail is an error before the first step.

use super::stability::{unstable_at_rest, warn_of_deformation};
use crate::session::Session;
use drape::cloth::Points;
use drape::diagnostics::geometry::{Concern, STARTS_INSIDE, concerns};
use drape::diagnostics::stability::Stability;
use drape::error::{Error, Kind, Result};
use drape::scene::{Contact, Scene};
use drape::simulation::{Simulation, Unresolved};

/// The simulation of `scene` at its start, which will be advanced by `frames` frames.
///
/// A cloth that may blow up while the stretch limit hides it gets a ledger, which detects that.
///
/// # Errors
/// [`Kind::Unstable`] when the cloth is certain to blow up or not to move at all, unless `allow_unstable`;
/// otherwise as [`Simulation::new`].
pub(crate) fn start(
    scene: &Scene,
    frames: u64,
    allow_unstable: bool,
    session: &Session,
) -> Result<Simulation> {
    start_from(scene, frames, None, allow_unstable, session)
}

/// As [`start`], with the points at `x` if it is given.
///
/// # Errors
/// As [`start`] and [`Simulation::starting_at`].
pub(crate) fn start_from(
    scene: &Scene,
    frames: u64,
    x: Option<&Points>,
    allow_unstable: bool,
    session: &Session,
) -> Result<Simulation> {
    let mut simulation = Simulation::starting_at(scene, x)?;
    if allow_unstable {
        simulation.allow_unstable();
    }
    warn_of_start(scene, session)?;
    if let Some(cloth) = scene.cloth.as_ref().filter(|_| frames > 0) {
        if let Some(error) = stuck(&simulation, frames as f64 / scene.sim.fps).filter(|_| !allow_unstable) {
            return Err(error);
        }
        let Some(stability) = Stability::of_bounded(cloth, &scene.sim)? else { return Ok(simulation) };
        if stability.is_unstable_at_rest() {
            let error = unstable_at_rest(&stability, cloth.ks, scene.sim.steps_per_frame);
            if !allow_unstable {
                return Err(error);
            }
            session.ui.caution(&error.message, &error.help);
        } else if !stability.is_always_stable() {
            warn_of_deformation(&stability, scene.sim.steps_per_frame, &session.ui);
            if !allow_unstable && scene.sim.stretch_limit.is_some() {
                simulation.record_ledger()?;
            }
        }
    }
    Ok(simulation)
}

/// Warns of points that start inside an object, which `coulomb` puts on its surface.
fn warn_of_start(scene: &Scene, session: &Session) -> Result<()> {
    if scene.sim.contact == Contact::Coulomb {
        let inside = concerns(scene)?.into_iter().filter(|concern| concern.code == STARTS_INSIDE);
        inside.for_each(|Concern { message, help, .. }| session.ui.caution(&message, &help));
    }
    Ok(())
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
