//! Making a file again, and comparing picture by picture.

use crate::animation::gif::{delay, milliseconds};
use crate::animation::reduced::Reduced;
use crate::animation::schedule::FrameSchedule;
use crate::animation::seen::Seen;
use crate::session::Session;
use crate::session::progress::Progress;

use super::file::{File, colors};
use drape::error::{Error, Kind, Result};
use drape::math::StateHash;
use drape::output::provenance::{Arguments, hex};
use drape::render::{Options, Renderer};
use drape::scene::Scene;
use drape::simulation::Simulation;

/// The moments that a file shows.
pub(super) enum Moments {
    One(u64),
    Many(FrameSchedule, u16),
}

impl Moments {
    /// Those that `arguments` name.
    ///
    /// # Errors
    /// [`Kind::Io`] when they name none.
    pub(super) fn of(arguments: &Arguments, scene: &Scene) -> Result<Self> {
        match *arguments {
            Arguments { frame: Some(frame), .. } => Ok(Self::One(frame)),
            Arguments { frames: Some([first, end]), fps: Some(fps), .. } if first < end && fps > 0 => {
                Ok(Self::Many(FrameSchedule::new(first..end, scene.sim.fps, fps), fps))
            }
            _ => Err(Error::new(Kind::Io, "the file does not say which moment it shows: it is damaged")),
        }
    }

    /// How many there are.
    pub(super) fn count(&self) -> u64 {
        match self {
            Self::One(_) => 1,
            Self::Many(schedule, _) => schedule.count(),
        }
    }

    /// The frame of picture `k`.
    pub(super) fn frame(&self, k: u64) -> u64 {
        match self {
            Self::One(frame) => *frame,
            Self::Many(schedule, _) => schedule.frame(k),
        }
    }

    /// The last frame.
    pub(super) fn last(&self) -> u64 {
        self.frame(self.count().saturating_sub(1))
    }

    /// For how long picture `k` is shown, as a fraction of milliseconds; nothing for a single picture.
    fn time(&self, k: u64, is_gif: bool) -> Option<[u32; 2]> {
        match self {
            Self::One(_) => None,
            Self::Many(_, fps) if is_gif => Some(milliseconds(delay(k, *fps))),
            Self::Many(_, fps) => Some([1000, u32::from(*fps)]),
        }
    }
}

/// A file that is made again.
pub(super) struct Again<'a> {
    pub(super) file: &'a File,
    pub(super) moments: &'a Moments,
    pub(super) renderer: &'a Renderer,
    pub(super) options: Options,
    /// Width and height in pixels.
    pub(super) size: [u32; 2],
}

impl Again<'_> {
    /// Makes all pictures, from `simulation` on, and compares them with those of the file, which are as many and as
    /// large.
    ///
    /// # Errors
    /// Those of the simulation and of reading the file; [`Kind::Signal`] between two frames.
    pub(super) fn make(&self, mut simulation: Simulation, session: &Session) -> Result<Made> {
        let Self { file, moments, size: [width, _], .. } = self;
        let mut progress =
            Progress::starting_at(&session.ui, "verifying", moments.last(), simulation.frame());
        let mut pictures = file.pictures()?;
        let mut reduced = file.is_gif.then(|| Reduced::new(*width));
        let mut made = Made::default();
        for k in 0..moments.count() {
            while simulation.frame() < moments.frame(k) {
                session.stop.check()?;
                simulation.advance_frame()?;
                progress.set(simulation.frame());
            }
            session.stop.check()?;
            let rgb = self.draw(&simulation, reduced.as_mut());
            made.take(simulation.state_hash(), &rgb, moments.time(k, file.is_gif));
            if let Some(shown) = pictures.next()? {
                made.compare(k, *width, &rgb, &colors(&shown.pixels));
            }
        }
        Ok(made)
    }

    /// The picture of the present moment as a reader of the file sees it.
    fn draw(&self, simulation: &Simulation, reduced: Option<&mut Reduced>) -> Vec<u8> {
        let rgb = self.renderer.draw(simulation.positions(), &self.options).rgb;
        let Some(reduced) = reduced else { return rgb };
        reduced.next(&rgb);
        reduced.seen().to_vec()
    }
}

/// What was made.
#[derive(Default)]
pub(super) struct Made {
    /// The hash of the state, of an animation of all states.
    pub(super) state: String,
    /// The hash of the picture, of an animation of all pictures.
    pub(super) picture: String,
    states: StateHash,
    seen: Seen,
    /// Pixels that differ from those of the file.
    pub(super) differing: u64,
    /// The first of them: the number of the picture, the column and the row, from 0.
    pub(super) first: Option<[u64; 3]>,
}

impl Made {
    /// Takes in a picture of a state, shown for a time if it is one of many.
    fn take(&mut self, state: u64, rgb: &[u8], time: Option<[u32; 2]>) {
        let Some(time) = time else {
            let mut picture = StateHash::default();
            picture.write(rgb);
            (self.state, self.picture) = (hex(state), hex(picture.finish()));
            return;
        };
        self.states.write(&state.to_le_bytes());
        self.seen.add(rgb, time);
        (self.state, self.picture) = (hex(self.states.finish()), hex(self.seen.hash()));
    }

    /// Compares picture `k`, `width` pixels wide, with that of the file.
    fn compare(&mut self, k: u64, width: u32, made: &[u8], there: &[u8]) {
        let pairs = made.as_chunks::<3>().0.iter().zip(there.as_chunks::<3>().0);
        let width = u64::from(width.max(1));
        for (place, _) in (0_u64..).zip(pairs).filter(|(_, (a, b))| a != b) {
            self.first.get_or_insert([k, place % width, place / width]);
            self.differing += 1;
        }
    }

    /// How the pictures differ, in words.
    pub(super) fn difference(&self, moments: &Moments, size: [u32; 2]) -> String {
        let Some([k, x, y]) = self.first else {
            return "pictures are shown for another time".to_owned();
        };
        let [width, height] = size.map(u64::from);
        let all = width * height * moments.count();
        let of = if moments.count() == 1 { String::new() } else { format!(" of picture {k}") };
        let Self { differing, .. } = self;
        format!("{differing} of {all} pixels, the first at column {x}, row {y}{of} (from 0)")
    }
}
