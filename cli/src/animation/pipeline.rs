//! Simulating, drawing and encoding side by side: while one picture is drawn, the cloth is simulated on to
//! the next one and the picture before is encoded. Each of the three works in order, so that the bytes do
//! not depend on which is faster.

use std::ops::Range;
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
use drape::math::StateHash;
use drape::output::provenance::Provenance;
use drape::render::{Options, Picture, Renderer};
use drape::simulation::Simulation;

/// How many states, and how many pictures, may wait for the next stage.
const QUEUE: usize = 2;

/// The three stages and what they share.
pub(crate) struct Pipeline<'a> {
    pub(crate) target: &'a Target,
    pub(crate) playback: Playback,
    pub(crate) schedule: &'a FrameSchedule,
    /// The pictures of this run: all, or its share of them.
    pub(crate) pictures: Range<u64>,
    pub(crate) renderer: &'a Renderer,
    pub(crate) options: Options,
    /// The numbered pictures, if each has a file.
    pub(crate) sequence: Option<Sequence<'a>>,
    /// What the file says of itself.
    pub(crate) provenance: Provenance,
}

/// Where a simulation is when it is seen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Stage {
    /// After a frame.
    Frame,
    /// At its end.
    End,
}

/// What was drawn.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Drawn {
    pub(crate) pictures: u64,
    /// Whether an object is visible in one of them.
    pub(crate) visible: bool,
}

/// Something that belongs to one picture.
struct Numbered<T> {
    /// The number of the picture.
    k: u64,
    /// The hash of the state that it shows.
    state: u64,
    content: T,
}

impl Pipeline<'_> {
    /// The first and the last picture that are not there from an earlier run.
    pub(crate) fn missing(&self, session: &Session) -> Result<Option<[u64; 2]>> {
        let first = self.first_missing(self.pictures.clone(), session)?;
        let last = self.first_missing(self.pictures.clone().rev(), session)?;
        Ok(first.zip(last).map(|(first, last)| [first, last]))
    }

    fn first_missing(&self, pictures: impl Iterator<Item = u64>, session: &Session) -> Result<Option<u64>> {
        for k in pictures {
            session.signals.check()?;
            if !self.has(k) {
                return Ok(Some(k));
            }
        }
        Ok(None)
    }

    /// Simulates, draws and encodes the missing pictures up to number `last`; `each` sees the simulation after
    /// every frame, and once more at the end.
    pub(crate) fn run(
        &self,
        last: u64,
        simulation: Simulation,
        each: impl FnMut(&Simulation, Stage) -> Result<()> + Send,
        session: &Session,
    ) -> Result<Drawn> {
        let file = self.target.open(self.playback, self.schedule.count(), self.provenance.clone())?;
        self.target.pattern().map_or(Ok(()), |pattern| outputs::make_folder(pattern.folder()))?;
        thread::scope(|scope| {
            let (states, to_draw) = sync_channel(QUEUE);
            let (pictures, to_encode) = sync_channel(QUEUE);
            let simulating = scope.spawn(move || self.simulate(last, simulation, &states, each, session));
            let encoding = scope.spawn(move || self.encode(file, &to_encode));
            let drawn = self.draw(to_draw, &pictures);
            drop(pictures);
            joined(simulating)?;
            let (file, state) = joined(encoding)?;
            session.signals.check()?;
            file.map_or(Ok(()), |file| file.finish(state)).map(|()| drawn)
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
        mut each: impl FnMut(&Simulation, Stage) -> Result<()>,
        session: &Session,
    ) -> Result<()> {
        let frames = self.schedule.frame(last);
        let mut progress = Progress::starting_at(&session.ui, "animating", frames, simulation.frame());
        for k in (self.pictures.start..=last).filter(|&k| !self.has(k)) {
            while simulation.frame() < self.schedule.frame(k) {
                session.signals.check()?;
                simulation.advance_frame()?;
                progress.set(simulation.frame());
                each(&simulation, Stage::Frame)?;
            }
            session.signals.check()?;
            let (state, content) = (simulation.state_hash(), simulation.positions().clone());
            if states.send(Numbered { k, state, content }).is_err() {
                break;
            }
        }
        warn_of_unsolved(&simulation, session);
        each(&simulation, Stage::End)
    }

    /// Draws each state and sends the picture; ends early when the receiver has gone.
    fn draw(&self, states: Receiver<Numbered<Points>>, pictures: &SyncSender<Numbered<Picture>>) -> Drawn {
        let mut drawn = Drawn::default();
        for Numbered { k, state, content: points } in states {
            let content = self.renderer.draw(&points, &self.options);
            drawn.visible |= content.stats.fragments > 0;
            if pictures.send(Numbered { k, state, content }).is_err() {
                break;
            }
            drawn.pictures += 1;
        }
        drawn
    }

    /// Encodes each picture, and returns the file if all share one, with the hash of their states.
    fn encode(
        &self,
        mut file: Option<Box<dyn Animation>>,
        pictures: &Receiver<Numbered<Picture>>,
    ) -> Result<(Option<Box<dyn Animation>>, u64)> {
        let mut states = StateHash::default();
        for Numbered { k, state, content: picture } in pictures {
            states.write(&state.to_le_bytes());
            if let Some(file) = &mut file {
                file.add(&picture.rgb)?;
            } else if let Some(sequence) = &self.sequence {
                sequence.write(k, self.schedule.frame(k), state, &picture)?;
            }
        }
        Ok((file, states.finish()))
    }
}

/// The result of a thread; its panic goes on in this one.
fn joined<T>(thread: ScopedJoinHandle<'_, Result<T>>) -> Result<T> {
    thread.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic))
}
