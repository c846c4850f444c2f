//! The arguments for states: where a run goes on from, and where it is saved.

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use super::flag::seconds;
use crate::session::files::atomic;
use crate::session::files::target::Content;
use drape::bounded;
use drape::error::{Error, Kind, Result};
use drape::scene::Scene;
use drape::simulation::Simulation;
use drape::simulation::snapshot::Snapshot;

/// Where a run goes on from, and where it is saved.
#[derive(clap::Args)]
pub(crate) struct StateArgs {
    /// Go on from the state in this file, which --save-state wrote for the same scene. The results have the same bits
    /// as those of a run from the start
    #[arg(long, value_name = "FILE")]
    from_state: Option<PathBuf>,
    /// Write the whole state at the end to this file
    #[arg(long, value_name = "FILE")]
    save_state: Option<PathBuf>,
    /// Write --save-state's file about every so many seconds of running time too, so that a run that is killed can go
    /// on from there
    #[arg(long, value_name = "SECONDS", value_parser = seconds, requires = "save_state")]
    checkpoint: Option<f64>,
}

impl StateArgs {
    /// The file that is read.
    pub(crate) fn inputs(&self) -> impl Iterator<Item = PathBuf> {
        // A run may go on from the file that it saves to, which is not an input then.
        self.from_state.iter().filter(|from| Some(*from) != self.save_state.as_ref()).cloned()
    }

    /// The file that is written.
    pub(crate) fn outputs(&self) -> impl Iterator<Item = (&Path, Content)> {
        self.save_state.iter().map(|path| (path.as_path(), Content::Binary))
    }

    /// Reads the state to go on from, if there is one.
    ///
    /// # Errors
    /// [`Kind::Io`] when the file cannot be read or is no state.
    pub(crate) fn read(&self) -> Result<Option<Snapshot>> {
        self.from_state.as_deref().map(read).transpose()
    }

    /// Takes `simulation` of `scene` to the saved state, if there is one; it will be advanced to frame `last`.
    ///
    /// # Errors
    /// As [`StateArgs::read`] and [`Simulation::restore`]; [`Kind::Usage`] when the state is of a later frame.
    pub(crate) fn restore(&self, simulation: &mut Simulation, scene: &Scene, last: u64) -> Result<()> {
        let Some(snapshot) = self.read()? else { return Ok(()) };
        let frame = snapshot.frame();
        if frame > last {
            let message = format!("the state is at frame {frame}, after the last frame {last}");
            return Err(Error::new(Kind::Usage, message).with_help("raise --time, --frame or --frames"));
        }
        simulation.restore(scene, &snapshot)
    }

    /// What saves a run of `scene`.
    pub(crate) fn saving<'a>(&'a self, scene: &'a Scene) -> Saving<'a> {
        let every = self.checkpoint.map(Duration::from_secs_f64);
        Saving { scene, path: self.save_state.as_deref(), every, saved: Instant::now() }
    }
}

/// The state in a file.
///
/// # Errors
/// [`Kind::Io`] when it cannot be read or is no state.
pub(crate) fn read(path: &Path) -> Result<Snapshot> {
    let named = |e: Error| Error { message: format!("{}: {}", path.display(), e.message), ..e };
    let bytes = bounded::read(path, bounded::MOST)
        .map_err(|e| Error::new(Kind::Io, format!("cannot read {}: {e}", path.display())))?;
    Snapshot::decode(&bytes).map_err(named)
}

/// Saves a run at its end, and now and then before.
pub(crate) struct Saving<'a> {
    scene: &'a Scene,
    path: Option<&'a Path>,
    every: Option<Duration>,
    saved: Instant,
}

impl Saving<'_> {
    /// Saves the state after a frame if it is time.
    ///
    /// # Errors
    /// As [`atomic::write`].
    pub(crate) fn after_frame(&mut self, simulation: &Simulation) -> Result<()> {
        match self.every {
            Some(every) if self.saved.elapsed() >= every => {
                self.finish(simulation)?;
                self.saved = Instant::now();
                Ok(())
            }
            _ => Ok(()),
        }
    }

    /// Saves the state, if it is asked for.
    ///
    /// # Errors
    /// As [`atomic::write`].
    pub(crate) fn finish(&self, simulation: &Simulation) -> Result<()> {
        let bytes = || simulation.snapshot(self.scene).encode();
        self.path.map_or(Ok(()), |path| atomic::write(path, &bytes()))
    }
}
