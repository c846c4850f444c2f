//! Simulating, drawing and encoding side by side: while one picture is drawn, the cloth is simulated on to
//! the next one and the picture before is encoded. Each of the three works in order, so that the bytes do
//! not depend on which is faster.

use std::ops::Range;
use std::sync::atomic::{AtomicU64, Ordering};
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
    /// The pictures of this run: all, or its share of them.
    pub(crate) pictures: Range<u64>,
    pub(crate) renderer: &'a Renderer,
    pub(crate) options: Options,
    /// The numbered pictures, if each has a file.
    pub(crate) sequence: Option<Sequence<'a>>,
}

/// How many pictures were begun, and how many of them are in their files.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pictures {
    pub(crate) begun: u64,
    pub(crate) written: u64,
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

    /// Simulates up to picture number `last`, and draws and encodes the missing pictures; `each` sees the simulation
    /// after every frame. Returns the simulation at the end too.
    pub(crate) fn run(
        &self,
        last: u64,
        simulation: Simulation,
        each: impl FnMut(&Simulation, Pictures) -> Result<()> + Send,
        session: &Session,
    ) -> Result<(Drawn, Simulation)> {
        let file = self.target.open(self.playback, self.schedule.count())?;
        self.target.pattern().map_or(Ok(()), |pattern| outputs::make_folder(pattern.folder()))?;
        let written = &AtomicU64::new(0);
        thread::scope(|scope| {
            let (states, to_draw) = sync_channel(QUEUE);
            let (pictures, to_encode) = sync_channel(QUEUE);
            let simulating = scope.spawn(move || {
                let mut each = each;
                let mut each = |now: &Simulation, begun| {
                    each(now, Pictures { begun, written: written.load(Ordering::Acquire) })
                };
                self.simulate(last, simulation, &states, &mut each, session)
            });
            let encoding = scope.spawn(move || self.encode(file, &to_encode, written));
            let drawn = self.draw(to_draw, &pictures);
            drop(pictures);
            let simulation = joined(simulating)?;
            let file = joined(encoding)?;
            session.signals.check()?;
            file.map_or(Ok(()), Animation::finish).map(|()| (drawn, simulation))
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
        each: &mut dyn FnMut(&Simulation, u64) -> Result<()>,
        session: &Session,
    ) -> Result<Simulation> {
        let frames = self.schedule.frame(last);
        let mut progress = Progress::starting_at(&session.ui, "animating", frames, simulation.frame());
        let mut begun = 0;
        for k in self.pictures.start..=last {
            let missing = !self.has(k);
            // Frames after the last missing picture are simulated for the state at the end.
            while (missing || k == last) && simulation.frame() < self.schedule.frame(k) {
                session.signals.check()?;
                simulation.advance_frame()?;
                progress.set(simulation.frame());
                each(&simulation, begun)?;
            }
            session.signals.check()?;
            if missing && states.send((k, simulation.positions().clone())).is_err() {
                break;
            }
            begun += u64::from(missing);
        }
        warn_of_unsolved(&simulation, session);
        Ok(simulation)
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
        written: &AtomicU64,
    ) -> Result<Option<Box<dyn Animation>>> {
        for (k, picture) in pictures {
            if let Some(file) = &mut file {
                file.add(&picture.rgb)?;
            } else if let Some(sequence) = &self.sequence {
                sequence.write(k, self.schedule.frame(k), &picture)?;
                written.fetch_add(1, Ordering::Release);
            }
        }
        Ok(file)
    }
}

/// The result of a thread; its panic goes on in this one.
fn joined<T>(thread: ScopedJoinHandle<'_, Result<T>>) -> Result<T> {
    thread.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic))
}
