//! Simulating, drawing and encoding side by side: while one picture is drawn, the cloth is simulated on to
//! the next one and the picture before is encoded. Each of the three works in order, so that the bytes do
//! not depend on which is faster. Where no threads can be started, they follow each other.

use std::ops::Range;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::sync_channel;
use std::sync::{Mutex, PoisonError};
use std::thread::{self, ScopedJoinHandle};

use super::format::{Animation, Playback};
use super::schedule::FrameSchedule;
use super::sequence::Sequence;
use super::target::Target;
use crate::run::advance::warn_of_unsolved;
use crate::session::Session;
use crate::session::files::outputs;
use crate::session::leftovers::locked;
use crate::session::progress::Progress;
use crate::session::{spawn, threads};
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

/// What the stages work on. The simulation and the file have one user each: the locks never wait.
struct Work<E> {
    /// The number of the last picture.
    last: u64,
    simulation: Mutex<Simulation>,
    each: Mutex<E>,
    encoded: Mutex<Encoded>,
    /// How many pictures are in their files.
    written: AtomicU64,
}

/// What was encoded so far.
struct Encoded {
    /// The file, if all pictures share one.
    file: Option<Box<dyn Animation>>,
    /// The hash of the states of all pictures.
    states: StateHash,
}

/// What sees the simulation after every frame.
pub(crate) trait Each: FnMut(&Simulation, Pictures) -> Result<()> + Send {}

impl<T: FnMut(&Simulation, Pictures) -> Result<()> + Send> Each for T {}

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
            self.target.check_stop(&session.stop)?;
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
        each: impl Each,
        session: &Session,
    ) -> Result<(Drawn, Simulation)> {
        let file = self.target.open(self.playback, self.schedule.count(), self.provenance.clone())?;
        self.target.pattern().map_or(Ok(()), |pattern| outputs::make_folder(pattern.folder()))?;
        let encoded = Mutex::new(Encoded { file, states: StateHash::default() });
        let (simulation, each, written) = (Mutex::new(simulation), Mutex::new(each), AtomicU64::new(0));
        let work = Work { last, simulation, each, encoded, written };
        let drawn = match self.side_by_side(&work, session)? {
            Some(drawn) => drawn,
            None => self.one_after_another(&work, session)?,
        };
        self.target.check_stop(&session.stop)?;
        let Encoded { file, states } = unlocked(work.encoded);
        file.map_or(Ok(()), |file| file.finish(states.finish()))?;
        Ok((drawn, unlocked(work.simulation)))
    }

    /// The three stages, the first and the last on threads of their own; nothing if those cannot be started, or if
    /// this thread, which draws, is the only one for the parallel work of all three.
    fn side_by_side<E: Each>(&self, work: &Work<E>, session: &Session) -> Result<Option<Drawn>> {
        if threads::is_the_only_one() {
            return Ok(None);
        }
        thread::scope(|scope| {
            let (states, to_draw) = sync_channel(QUEUE);
            let (pictures, to_encode) = sync_channel(QUEUE);
            let encoding = move || to_encode.into_iter().try_for_each(|picture| self.encode(work, picture));
            let simulating = move || self.simulate(work, session, |state| Ok(states.send(state).is_ok()));
            // The encoder first, which does nothing if the other cannot be started.
            let start = spawn::builder().and_then(|thread| thread.spawn_scoped(scope, encoding));
            let Ok(encoding) = start else { return Ok(None) };
            let start = spawn::builder().and_then(|thread| thread.spawn_scoped(scope, simulating));
            let Ok(simulating) = start else { return Ok(None) };
            let mut drawn = Drawn::default();
            for state in to_draw {
                if pictures.send(self.draw(state, &mut drawn)).is_err() {
                    break;
                }
            }
            drop(pictures);
            joined(simulating)?;
            joined(encoding)?;
            Ok(Some(drawn))
        })
    }

    /// The three stages on this thread.
    fn one_after_another<E: Each>(&self, work: &Work<E>, session: &Session) -> Result<Drawn> {
        let mut drawn = Drawn::default();
        self.simulate(work, session, |state| self.encode(work, self.draw(state, &mut drawn)).map(|()| true))?;
        Ok(drawn)
    }

    /// Whether picture `k` is there from an earlier run.
    fn has(&self, k: u64) -> bool {
        self.sequence.as_ref().is_some_and(|sequence| sequence.has(k, self.schedule.frame(k)))
    }

    /// Sends the state of each missing picture; ends early when the receiver has gone.
    fn simulate<E: Each>(
        &self,
        work: &Work<E>,
        session: &Session,
        mut send: impl FnMut(Numbered<Points>) -> Result<bool>,
    ) -> Result<()> {
        let (simulation, each) = (&mut *locked(&work.simulation), &mut *locked(&work.each));
        let frames = self.schedule.frame(work.last);
        let mut progress = Progress::starting_at(&session.ui, "animating", frames, simulation.frame());
        let mut begun = 0;
        for k in self.pictures.start..=work.last {
            let missing = !self.has(k);
            // Frames after the last missing picture are simulated for the state at the end.
            while (missing || k == work.last) && simulation.frame() < self.schedule.frame(k) {
                self.target.check_stop(&session.stop)?;
                simulation.advance_frame()?;
                progress.set(simulation.frame());
                each(simulation, Pictures { begun, written: work.written.load(Ordering::Acquire) })?;
            }
            self.target.check_stop(&session.stop)?;
            let state =
                || Numbered { k, state: simulation.state_hash(), content: simulation.positions().clone() };
            if missing && !send(state())? {
                break;
            }
            begun += u64::from(missing);
        }
        warn_of_unsolved(simulation, session);
        Ok(())
    }

    /// The picture of a state.
    fn draw(&self, shown: Numbered<Points>, drawn: &mut Drawn) -> Numbered<Picture> {
        let Numbered { k, state, content: points } = shown;
        let content = self.renderer.draw(&points, &self.options);
        drawn.visible |= content.stats.fragments > 0;
        drawn.pictures += 1;
        Numbered { k, state, content }
    }

    /// Adds a picture to the file, or writes its own.
    fn encode<E>(&self, work: &Work<E>, shown: Numbered<Picture>) -> Result<()> {
        let Numbered { k, state, content: picture } = shown;
        let mut encoded = locked(&work.encoded);
        encoded.states.write(&state.to_le_bytes());
        if let Some(file) = &mut encoded.file {
            file.add(&picture.rgb)?;
        } else if let Some(sequence) = &self.sequence {
            sequence.write(k, self.schedule.frame(k), state, &picture)?;
            work.written.fetch_add(1, Ordering::Release);
        }
        Ok(())
    }
}

/// The content of a lock that is needed no more.
fn unlocked<T>(lock: Mutex<T>) -> T {
    lock.into_inner().unwrap_or_else(PoisonError::into_inner)
}

/// The result of a thread; its panic goes on in this one.
fn joined<T>(thread: ScopedJoinHandle<'_, Result<T>>) -> Result<T> {
    thread.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic))
}
