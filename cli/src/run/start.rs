//! The start of a simulation, with its warnings.

use crate::session::Session;
use drape::cloth::Points;
use drape::diagnostics::geometry::{Concern, STARTS_INSIDE, concerns};
use drape::diagnostics::memory::Memory;
use drape::error::Result;
use drape::render::Renderer;
use drape::scene::{Contact, Scene};
use drape::simulation::Simulation;
use drape::texture_source::TextureSource;
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
    session.stop.check_memory(Memory::of(scene).cloth, "the cloth")?;
    let (simulation, warning) = start::start(scene, frames, x, allow_unstable)?;
    if x.is_none() {
        warn_of_start(scene, session)?;
    }
    if let Some(Warning { message, help }) = warning {
        session.ui.caution(&message, &help);
    }
    Ok(simulation)
}

/// The renderer of `scene`, with its textures.
///
/// # Errors
/// As [`Renderer::new`]; [`Kind::Limit`](drape::error::Kind::Limit).
pub(crate) fn renderer(scene: &Scene, textures: &TextureSource, session: &Session) -> Result<Renderer> {
    session.stop.check_memory(Memory::of(scene).picture, "the picture")?;
    Renderer::new(scene, textures)
}

/// Warns of points that start inside an object, which `coulomb` puts on its surface.
fn warn_of_start(scene: &Scene, session: &Session) -> Result<()> {
    if scene.sim.contact == Contact::Coulomb {
        let inside = concerns(scene)?.into_iter().filter(|concern| concern.code == STARTS_INSIDE);
        inside.for_each(|Concern { message, help, .. }| session.ui.caution(&message, &help));
    }
    Ok(())
}
