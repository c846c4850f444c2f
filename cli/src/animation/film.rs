//! The shooting of a film: while one picture is drawn, the cloth moves on to the next, and the
//! picture before is encoded. Each of the three works in order, so the bytes do not depend on who
//! is faster.

use std::fs;
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::thread::{self, ScopedJoinHandle};

use crate::animation::sequence::{self, Pattern};
use crate::animation::target::{Marks, Target};
use crate::animation::{Animation, Format};
use crate::args::frames::Moments;
use crate::run::advance::warn_of_unsolved;
use crate::session::Session;
use crate::session::progress::Progress;
use drape::cloth::Points;
use drape::error::{Error, Kind, Result};
use drape::render::{Options, Picture, Renderer};
use drape::simulation::Simulation;

/// How many states and pictures may wait for the next to take them.
const AHEAD: usize = 2;

/// What is shot.
pub(crate) struct Film<'a> {
    pub(crate) target: &'a Target,
    pub(crate) format: Format,
    pub(crate) moments: &'a Moments,
    pub(crate) renderer: &'a Renderer,
    pub(crate) options: Options,
    /// For a sequence of files: their names, and what they say of themselves.
    pub(crate) files: Option<(&'a Pattern, Marks)>,
}

/// What was drawn.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Drawn {
    pub(crate) pictures: u64,
    /// Whether anything but the background is seen in one of them.
    pub(crate) seen: bool,
}

/// Something that belongs to picture number `k`.
type Numbered<T> = (u64, T);

impl Film<'_> {
    /// The last picture that is not there yet.
    pub(crate) fn last_missing(&self, session: &Session) -> Result<Option<u64>> {
        for k in (0..self.moments.count()).rev() {
            session.signals.check()?;
            if !self.is_there(k) {
                return Ok(Some(k));
            }
        }
        Ok(None)
    }

    /// Simulates, draws and encodes the pictures up to number `last` that are not there yet.
    pub(crate) fn shoot(&self, last: u64, simulation: Simulation, session: &Session) -> Result<Drawn> {
        let file = self.target.open(self.format, self.moments.count())?;
        self.make_folder()?;
        thread::scope(|scope| {
            let (states, to_draw) = sync_channel(AHEAD);
            let (pictures, to_write) = sync_channel(AHEAD);
            let simulating = scope.spawn(move || self.simulate(last, simulation, &states, session));
            let writing = scope.spawn(move || self.write(file, &to_write));
            let drawn = self.draw(to_draw, &pictures);
            drop(pictures);
            joined(simulating)?;
            let file = joined(writing)?;
            session.signals.check()?;
            file.map_or(Ok(()), Animation::finish).map(|()| drawn)
        })
    }

    /// Whether picture `k` has been left by an earlier run.
    fn is_there(&self, k: u64) -> bool {
        let mark = |marks: &Marks| marks.mark(self.moments.frame(k));
        self.files.as_ref().is_some_and(|(names, marks)| sequence::is_whole(&names.path(k), &mark(marks)))
    }

    fn make_folder(&self) -> Result<()> {
        let Some(folder) = self.files.as_ref().map(|(names, _)| names.folder()) else { return Ok(()) };
        if folder.as_os_str().is_empty() || folder.is_dir() {
            return Ok(());
        }
        fs::create_dir(folder)
            .map_err(|e| Error::new(Kind::Io, format!("cannot make the folder `{}`: {e}", folder.display())))
    }

    /// Sends on the state of each moment; ends early when nobody takes them any more.
    fn simulate(
        &self,
        last: u64,
        mut simulation: Simulation,
        states: &SyncSender<Numbered<Points>>,
        session: &Session,
    ) -> Result<()> {
        let mut progress = Progress::new(&session.ui, "animating", self.moments.frame(last));
        for k in (0..=last).filter(|&k| !self.is_there(k)) {
            while simulation.frame() < self.moments.frame(k) {
                session.signals.check()?;
                simulation.advance_frame()?;
                progress.set(simulation.frame());
            }
            session.signals.check()?;
            if states.send((k, simulation.positions().clone())).is_err() {
                break;
            }
        }
        warn_of_unsolved(&simulation, session);
        Ok(())
    }

    /// Draws each state and sends on the picture; ends early when nobody takes them any more.
    fn draw(&self, states: Receiver<Numbered<Points>>, pictures: &SyncSender<Numbered<Picture>>) -> Drawn {
        let mut drawn = Drawn::default();
        for (k, points) in states {
            let picture = self.renderer.draw(&points, &self.options);
            drawn.seen |= picture.stats.fragments > 0;
            if pictures.send((k, picture)).is_err() {
                break;
            }
            drawn.pictures += 1;
        }
        drawn
    }

    /// Encodes each picture; the file, if it is one for all.
    fn write(
        &self,
        mut file: Option<Box<dyn Animation>>,
        pictures: &Receiver<Numbered<Picture>>,
    ) -> Result<Option<Box<dyn Animation>>> {
        for (k, picture) in pictures {
            if let Some(file) = &mut file {
                file.add(&picture.rgb)?;
            } else if let Some((names, marks)) = &self.files {
                let mark = marks.mark(self.moments.frame(k));
                sequence::write(&names.path(k), [picture.width, picture.height], &picture.rgb, &mark)?;
            }
        }
        Ok(file)
    }
}

/// The result of a thread; its panic goes on in this one.
fn joined<T>(thread: ScopedJoinHandle<'_, Result<T>>) -> Result<T> {
    thread.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic))
}
