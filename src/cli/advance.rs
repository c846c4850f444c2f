//! The simulation up to a frame, with progress and a way to stop it.

use std::time::{Duration, Instant};

use super::Session;
use super::progress::Progress;
use crate::cloth::stability::Stability;
use crate::error::{Error, Kind, Result};
use crate::scene::Scene;
use crate::simulation::Simulation;

/// The simulation of `scene` at its start. Where steps will follow, a cloth that is certain to
/// blow up is refused, unless that is allowed.
///
/// # Errors
/// [`Kind::Unstable`] for such a cloth; otherwise as [`Simulation::new`].
pub(super) fn start(
    scene: &Scene,
    frames: u64,
    allow_unstable: bool,
    session: &Session,
) -> Result<Simulation> {
    let simulation = Simulation::new(scene)?;
    if let Some(cloth) = scene.cloth.as_ref().filter(|_| frames > 0) {
        let stability = Stability::new(cloth, &scene.sim)?;
        match unstable(&stability, scene.sim.steps_per_frame) {
            Some(error) if allow_unstable => session.ui.note(&format!("warning: {}", error.message)),
            Some(error) => return Err(error),
            None => {}
        }
    }
    Ok(simulation)
}

fn unstable(stability: &Stability, steps: u32) -> Option<Error> {
    let Stability { dt, limit, omega_rest, omega_safe, .. } = *stability;
    let message = format!(
        "unstable before the first step: dt * omega is {:.3} at rest, and only below {limit:.3} is stable",
        dt * omega_rest
    );
    let help = format!(
        "raise sim.steps_per_frame from {steps} to at least {} ({} in every configuration), lower cloth.ks, \
         raise cloth.density, or pass --allow-unstable",
        stability.fewest_steps(omega_rest),
        stability.fewest_steps(omega_safe),
    );
    stability.is_unstable_at_rest().then(|| Error::new(Kind::Unstable, message).with_help(help))
}

/// Moves `simulation` on to frame `frames`; `each` sees the start and every frame. Returns the
/// wall time that took.
///
/// # Errors
/// Those of the simulation and of `each`, and [`crate::error::Kind::Signal`] between two frames.
pub(super) fn advance(
    simulation: &mut Simulation,
    frames: u64,
    session: &Session,
    mut each: impl FnMut(&Simulation) -> Result<()>,
) -> Result<Duration> {
    let started = Instant::now();
    let mut progress = Progress::new(&session.ui, "simulating", frames);
    each(simulation)?;
    while simulation.frame() < frames {
        session.signals.check()?;
        simulation.advance_frame()?;
        progress.set(simulation.frame());
        each(simulation)?;
    }
    drop(progress);
    session.signals.check()?;
    let elapsed = started.elapsed();
    session.ui.remark(&format!("simulated {frames} frames in {:.3} s", elapsed.as_secs_f64()));
    Ok(elapsed)
}
