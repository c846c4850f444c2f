//! Simulating, drawing and encoding side by side: while one picture is drawn, the cloth is simulated on to
//! the next one and the picture before is encoded. Each of the three works in order, so that the bytes do
//! not depend on which is faster.

use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::thread::{self, ScopedJoinHandle};

use super::format::{Animation, Playback};
use super::schedule::FrameSchedule;
use super::sequence::Sequence;
use super::target::Target;
use crate::run::advance::warn_of_unsolved;
use crate::session::Session;
use crate::session::files::outputs;
use crate::session::progress::Progress;
use drape::cloth::Points;
use drape::error::Result;
use drape::render::{Options, Picture, Renderer};
use drape::simulation::Simulation;

/// How many states, and how many pictures, may wait for the next stage.
const QUEUE: usize = 2;

/// The three stages and what they share.
pub(crate) struct Pipeline<'a> {
    pub(crate) target: &'a Target,
    pub(crate) playback: Playback,
    pub(crate) schedule: &'a FrameSchedule,
    pub(crate) renderer: &'a Renderer,
    pub(crate) options: Options,
    /// The numbered pictures, if each has a file.
    pub(crate) sequence: Option<Sequence<'a>>,
}

/// What was drawn.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Drawn {
    pub(crate) pictures: u64,
    /// Whether an object is visible in one of them.
    pub(crate) visible: bool,
}

/// Something that belongs to picture number `k`.
type Numbered<T> = (u64, T);

impl Pipeline<'_> {
    /// The last picture that is not there from an earlier run.
    pub(crate) fn last_missing(&self, session: &Session) -> Result<Option<u64>> {
        for k in (0..self.schedule.count()).rev() {
            session.signals.check()?;
            if !self.has(k) {
                return Ok(Some(k));
            }
        }
        Ok(None)
    }

    /// Simulates, draws and encodes the missing pictures up to number `last`.
    pub(crate) fn run(&self, last: u64, simulation: Simulation, session: &Session) -> Result<Drawn> {
        let file = self.target.open(self.playback, self.schedule.count())?;
        self.target.pattern().map_or(Ok(()), |pattern| outputs::make_folder(pattern.folder()))?;
        thread::scope(|scope| {
            let (states, to_draw) = sync_channel(QUEUE);
            let (pictures, to_encode) = sync_channel(QUEUE);
            let simulating = scope.spawn(move || self.simulate(last, simulation, &states, session));
            let encoding = scope.spawn(move || self.encode(file, &to_encode));
            let drawn = self.draw(to_draw, &pictures);
            drop(pictures);
            joined(simulating)?;
            let file = joined(encoding)?;
            session.signals.check()?;
            file.map_or(Ok(()), Animation::finish).map(|()| drawn)
        })
    }

    /// Whether picture `k` is there from an earlier run.
    fn has(&self, k: u64) -> bool {
        self.sequence.as_ref().is_some_and(|sequence| sequence.has(k, self.schedule.frame(k)))
    }

    /// Sends the state of each missing picture; ends early when the receiver has gone.
    fn simulate(
        &self,
        last: u64,
        mut simulation: Simulation,
        states: &SyncSender<Numbered<Points>>,
        session: &Session,
    ) -> Result<()> {
        let mut progress = Progress::new(&session.ui, "animating", self.schedule.frame(last));
        for k in (0..=last).filter(|&k| !self.has(k)) {
            while simulation.frame() < self.schedule.frame(k) {
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

    /// Draws each state and sends the picture; ends early when the receiver has gone.
    fn draw(&self, states: Receiver<Numbered<Points>>, pictures: &SyncSender<Numbered<Picture>>) -> Drawn {
        let mut drawn = Drawn::default();
        for (k, points) in states {
            let picture = self.renderer.draw(&points, &self.options);
            drawn.visible |= picture.stats.fragments > 0;
            if pictures.send((k, picture)).is_err() {
                break;
            }
            drawn.pictures += 1;
        }
        drawn
    }

    /// Encodes each picture, and returns the file if all share one.
    fn encode(
        &self,
        mut file: Option<Box<dyn Animation>>,
        pictures: &Receiver<Numbered<Picture>>,
    ) -> Result<Option<Box<dyn Animation>>> {
        for (k, picture) in pictures {
            if let Some(file) = &mut file {
                file.add(&picture.rgb)?;
            } else if let Some(sequence) = &self.sequence {
                sequence.write(k, self.schedule.frame(k), &picture)?;
            }
        }
        Ok(file)
    }
}

/// The result of a thread; its panic goes on in this one.
fn joined<T>(thread: ScopedJoinHandle<'_, Result<T>>) -> Result<T> {
    thread.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic))
}
