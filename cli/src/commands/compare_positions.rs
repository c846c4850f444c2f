//! `drape compare-positions`: where positions computed by another program differ from ours, and why.

use std::fs::{self, File};
use std::io::Read;
use std::path::{Path, PathBuf};

use crate::animation::pattern::Pattern;
use crate::args::frames::{Frames, frame};
use crate::args::scene::{SceneArgs, StabilityArgs, frame_at};
use crate::run::start::start_from;
use crate::session::Session;
use crate::session::files::{numbered, target};
use crate::session::progress::{Progress, Stages};
use drape::cloth::Points;
use drape::error::{Error, Kind, Result};
use drape::scene::{SEEN, Scene};
use drape::simulation::Simulation;
use drape_lab::grader::{self, Case, Comparison, Difference, Event, Ours, Pair, State};

/// The arguments of `compare-positions`.
#[derive(clap::Args)]
pub(crate) struct Args {
    #[command(flatten)]
    scene: SceneArgs,
    /// The positions of the other program: x y z of each point, row by row, as .npy, as f64 little-endian or as text
    /// with 17 digits (%.17g); one state, or several one after the other. A name with %04d in it, such as
    /// dump/%04d.npy, means a file for each frame, numbered by frame. If SCENE is such a file of positions too, the two
    /// are compared with each other
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// Do not look for the cause of a difference, which runs many simulations
    #[arg(long)]
    no_diagnosis: bool,
    /// The frame of the state in the file, if there is one state (default: that of the scene's render.time)
    #[arg(long, value_name = "N", conflicts_with = "frames", value_parser = frame)]
    frame: Option<u64>,
    /// The frames of the states in the file, from A to B, without B (default: derived from the number of states)
    #[arg(long, value_name = "A..B")]
    frames: Option<Frames>,
    /// Accept distances of up to this many metres between two points; 0 requires equal bits
    #[arg(long, value_name = "M", default_value_t = 0.0, value_parser = distance)]
    tolerance: f64,
    #[command(flatten)]
    stability: StabilityArgs,
}

/// Why two files need no scene.
const PAIR: &str = "two files of positions are compared number by number";

/// Compares and prints; a difference beyond the tolerance is an error of [`Kind::Difference`].
pub(crate) fn run(args: &Args, session: &Session) -> Result<()> {
    if is_positions(&args.scene.path) {
        return args.run_pair(session);
    }
    let scene = args.scene.load(session)?;
    args.scene.caution(&SEEN, "positions do not depend on how they are drawn", &session.ui);
    let Some(cloth) = &scene.cloth else {
        return Err(Error::new(
            Kind::Nothing,
            "the scene has no cloth, so there are no positions to compare",
        ));
    };
    let (numbered, theirs) = args.read([cloth.num_width_points, cloth.num_height_points])?;
    let first_frame = numbered.map_or_else(|| args.first_frame(theirs.len(), &scene), Ok)?;
    let plural = if theirs.len() == 1 { "" } else { "s" };
    session.ui.note(&format!("{} state{plural}, the first at frame {first_frame}", theirs.len()));
    let plain = Simulation::new(&scene)?;
    let start = grader::start_of(&theirs[0], plain.positions(), cloth).filter(|_| first_frame == 0);
    if start.is_some() {
        session.ui.note("the cloth starts at random depths; those of the file are used");
    }
    let ours = args.simulate(&scene, start.as_ref(), first_frame, theirs.len(), session)?;
    let last_frame = frame_at(None, &scene).max(first_frame + theirs.len() as u64);
    let case = Case { scene: &scene, cloth, first_frame, last_frame, start, ours: &ours, theirs: &theirs };
    let comparison = args.compare(&case, session)?;
    session.print(&comparison, &comparison.text())?;
    result(&comparison, args.tolerance)
}

/// Whether a file holds positions rather than a scene, which is called so or starts with a brace.
fn is_positions(path: &Path) -> bool {
    if path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("json")) {
        return false;
    }
    let mut start = [0; 64];
    let read = File::open(path).and_then(|mut file| file.read(&mut start));
    let first = |length: usize| start[..length].iter().find(|byte| !byte.is_ascii_whitespace()).copied();
    read.is_ok_and(|length| first(length).is_some_and(|first| first != b'{'))
}

impl Args {
    /// Compares two files of positions.
    fn run_pair(&self, session: &Session) -> Result<()> {
        if self.frame.is_some() || self.frames.is_some() {
            let message = format!("{PAIR}, so there are no frames to name");
            return Err(Error::new(Kind::Usage, message).with_help("leave out --frame and --frames"));
        }
        for (given, option) in [
            (self.scene.is_changed(), "--set or --patch"),
            (self.no_diagnosis, "--no-diagnosis"),
            (self.stability.allow_unstable, "--allow-unstable"),
        ] {
            if given {
                session.ui.caution(&format!("{option} has no effect: {PAIR}"), "");
            }
        }
        let [a, b] = [&self.scene.path, &self.file].map(|path| grader::read_numbers(path));
        let pair = Pair::new(&a?, &b?, self.tolerance)?;
        session.print(&pair, &pair.text())?;
        if pair.differing == 0 { Ok(()) } else { Err(difference("the positions", "", self.tolerance)) }
    }

    /// The result of the comparison, with the cause of a difference if that is asked for.
    fn compare(&self, case: &Case<'_>, session: &Session) -> Result<Comparison> {
        let progress = Stages::new(&session.ui);
        let watch = |event| {
            match event {
                Event::Stage(what, frames) => progress.begin(what, frames),
                Event::Frames(frames) => progress.add(frames),
            }
            session.stop.check()
        };
        Comparison::new(case, self.tolerance, (!self.no_diagnosis).then_some(&watch))
    }

    /// The states of the other program, and the first one's frame if their names say it.
    fn read(&self, grid: [usize; 2]) -> Result<(Option<u64>, Vec<State>)> {
        let Some(pattern) = Pattern::parse(&self.file)? else {
            return Ok((None, grader::read(&numbered::one(&self.file)?, grid)?));
        };
        if self.frame.is_some() || self.frames.is_some() {
            let message = "the names of the files say their frames, so there are none to name";
            return Err(Error::new(Kind::Usage, message).with_help("leave out --frame and --frames"));
        }
        let folder = target::folder(&self.file);
        let entries = fs::read_dir(folder).map_err(|e| {
            Error::new(Kind::Io, format!("cannot read the folder `{}`: {e}", folder.display()))
        })?;
        let mut frames: Vec<u64> = entries.filter_map(|entry| pattern.number(&entry.ok()?.path())).collect();
        frames.sort_unstable();
        let Some(&first) = frames.first() else {
            let message = format!("there is no file `{}`", self.file.display());
            return Err(Error::new(Kind::Io, message).with_help("the number in a name is that of the frame"));
        };
        if (first..).zip(&frames).any(|(expected, &frame)| frame != expected) {
            let message = format!("the frames of `{}` are not one after the other", self.file.display());
            return Err(Error::new(Kind::Usage, message)
                .with_help("write every frame, or compare one file with --frame N"));
        }
        let mut states = Vec::new();
        for frame in frames {
            states.extend(grader::read(&pattern.path(frame), grid)?);
        }
        Ok((Some(first), states))
    }

    /// The states of the method at `count` frames from `first_frame` on, started with the points at `start` if
    /// they are given.
    fn simulate(
        &self,
        scene: &Scene,
        start: Option<&Points>,
        first_frame: u64,
        count: usize,
        session: &Session,
    ) -> Result<Vec<Ours>> {
        let last_frame = first_frame + count as u64 - 1;
        let simulation = start_from(scene, last_frame, start, self.stability.allow_unstable, session)?;
        let mut progress = Progress::new(&session.ui, "simulating", last_frame);
        Ours::simulate(simulation, first_frame, count, |simulation| {
            progress.set(simulation.frame());
            session.stop.check()
        })
    }

    /// The frame of the first of `count` states.
    fn first_frame(&self, count: usize, scene: &Scene) -> Result<u64> {
        let count = count as u64;
        let frames = match (&self.frames, self.frame) {
            (Some(frames), _) => frames.0.clone(),
            (None, Some(frame)) => frame..frame + 1,
            // One state is the last frame, as `simulate --positions` writes it; as many states as frames are
            // all frames but the start.
            (None, None) => match frame_at(None, scene) {
                end if count == 1 => end..end + 1,
                end if count == end => 1..count + 1,
                _ => 0..count,
            },
        };
        if frames.end - frames.start == count {
            return Ok(frames.start);
        }
        let plural = if count == 1 { "" } else { "s" };
        let asked = frames.end - frames.start;
        let message = format!("`{}` contains {count} state{plural}, not {asked}", self.file.display());
        let (first, end) = (frames.start, frames.start.saturating_add(count));
        Err(Error::new(Kind::Usage, message).with_help(match self.frames {
            Some(_) => format!("from frame {first} on they are --frames {first}..{end}"),
            None => "give the frames of the states with --frames A..B".to_owned(),
        }))
    }
}

/// The error of a difference, which decides the exit code.
fn result(comparison: &Comparison, tolerance: f64) -> Result<()> {
    let Some(Difference { frame, .. }) = comparison.difference else { return Ok(()) };
    Err(difference("the positions", &format!(" from frame {frame} on"), tolerance))
}

/// The error of a difference; its help names only what was not given.
fn difference(what: &str, place: &str, tolerance: f64) -> Error {
    let (beyond, help) = if tolerance > 0.0 {
        ("differ by more than the tolerance", "")
    } else {
        ("are not equal", "--tolerance 1e-6 accepts differences that come from rounding")
    };
    Error::new(Kind::Difference, format!("{what} {beyond}{place}")).with_help(help)
}

/// Parses a distance that is not negative.
fn distance(text: &str) -> Result<f64, String> {
    let number = text.parse().ok().filter(|metres: &f64| metres.is_finite() && *metres >= 0.0);
    number.ok_or_else(|| "expected a number of metres, 0 or above".to_owned())
}
