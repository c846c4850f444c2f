//! The start of a simulation, with its warnings.

use crate::session::Session;
use drape::cloth::Points;
use drape::error::Result;
use drape::scene::Scene;
use drape::simulation::Simulation;
use drape_lab::run::start;
use drape_lab::run::warning::Warning;

/// The simulation of `scene` at its start, which will be advanced by `frames` frames. Prints what is doubtful.
///
/// # Errors
/// As [`start::start`].
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
/// As [`start::start`].
pub(crate) fn start_from(
    scene: &Scene,
    frames: u64,
    x: Option<&Points>,
    allow_unstable: bool,
    session: &Session,
) -> Result<Simulation> {
    let (simulation, warning) = start::start(scene, frames, x, allow_unstable)?;
    if let Some(Warning { message, help }) = warning {
        session.ui.caution(&message, &help);
    }
    Ok(simulation)
}
