//! The arguments for states: where a run goes on from, and where it is saved.

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use super::flag::seconds;
use crate::args::output::output;
use crate::session::files::atomic;
use crate::session::files::target::Content;
use drape::bounded;
use drape::error::{Error, Kind, Result};
use drape::scene::Scene;
use drape::simulation::Simulation;
use drape::simulation::snapshot::{Seen, Snapshot};

/// Where a run goes on from, and where it is saved.
#[derive(clap::Args)]
pub(crate) struct StateArgs {
    /// Go on from the state in this file, which --save-state wrote for the same scene. The results have the same bits
    /// as those of a run from the start
    #[arg(long, value_name = "FILE")]
    from_state: Option<PathBuf>,
    /// Write the whole state at the end to this file
    #[arg(long, value_name = "FILE", value_parser = output())]
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

    /// Takes `simulation` of `scene` to the saved state, if there is one, and returns what was seen of it before. The first frame that is asked for is `first`.
    ///
    /// # Errors
    /// As [`StateArgs::read`] and [`Simulation::restore`]; [`Kind::Usage`] when the state is of a later frame.
    pub(crate) fn restore(&self, simulation: &mut Simulation, scene: &Scene, first: u64) -> Result<Seen> {
        let Some(snapshot) = self.read()? else { return Ok(Seen::default()) };
        let frame = snapshot.frame();
        if frame > first {
            let message = format!("the state is at frame {frame}, after frame {first}, which is asked for");
            return Err(Error::new(Kind::Usage, message)
                .with_help("raise --time, --frame or --frames, or leave out --from-state"));
        }
        simulation.restore(scene, &snapshot)?;
        Ok(snapshot.seen)
    }

    /// Whether the state at the end is asked for.
    pub(crate) fn saves(&self) -> bool {
        self.save_state.is_some()
    }

    /// What saves a run of `scene`.
    pub(crate) fn saving<'a>(&'a self, scene: &'a Scene) -> Saving<'a> {
        let every = self.checkpoint.map(Duration::from_secs_f64);
        Saving { scene, path: self.save_state.as_deref(), every, taken: Instant::now(), waiting: None }
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
    /// When the last state was taken.
    taken: Instant,
    /// A state that is not saved yet, and the number of pictures that must be written first.
    waiting: Option<(Snapshot, u64)>,
}

impl Saving<'_> {
    /// Saves the state after a frame if it is time.
    ///
    /// # Errors
    /// As [`atomic::write`].
    pub(crate) fn after_frame(&mut self, simulation: &Simulation, seen: Seen) -> Result<()> {
        if self.is_time() {
            self.finish(simulation, seen)?;
        }
        Ok(())
    }

    /// Takes the state after a frame if it is time, when `begun` pictures were begun, and saves it once as many of them
    /// are `written`: a run that goes on from a state does not draw what was before it.
    ///
    /// # Errors
    /// As [`atomic::write`].
    pub(crate) fn after_pictures(&mut self, simulation: &Simulation, begun: u64, written: u64) -> Result<()> {
        if self.waiting.is_none() && self.is_time() {
            self.waiting = Some((simulation.snapshot(self.scene), begun));
        }
        let ready = self.waiting.take_if(|(_, begun)| *begun <= written);
        ready.map_or(Ok(()), |(state, _)| self.write(&state))
    }

    /// Whether a state is to be taken now.
    fn is_time(&mut self) -> bool {
        let is_time = self.every.is_some_and(|every| self.taken.elapsed() >= every);
        if is_time {
            self.taken = Instant::now();
        }
        is_time
    }

    /// Saves the state, if it is asked for.
    ///
    /// # Errors
    /// As [`atomic::write`].
    pub(crate) fn finish(&self, simulation: &Simulation, seen: Seen) -> Result<()> {
        let mut state = simulation.snapshot(self.scene);
        state.seen = seen;
        self.write(&state)
    }

    fn write(&self, state: &Snapshot) -> Result<()> {
        self.path.map_or(Ok(()), |path| atomic::write(path, &state.encode()))
    }
}
