//! `drape compare-positions`: where positions computed by another program differ from ours, and why.

use std::path::PathBuf;

use crate::args::frames::Frames;
use crate::args::scene::{SceneArgs, StabilityArgs, frame_at};
use crate::run::start::start_from;
use crate::session::Session;
use crate::session::progress::{Progress, Tally};
use drape::cloth::Points;
use drape::error::{Error, Kind, Result};
use drape::scene::Scene;
use drape::simulation::Simulation;
use drape_lab::grader::{self, Case, Comparison, Difference, Ours};

/// The arguments of `compare-positions`.
#[derive(clap::Args)]
pub(crate) struct Args {
    #[command(flatten)]
    scene: SceneArgs,
    /// The positions of the other program: x y z of each point, row by row, as f64 little-endian or as text with 17
    /// digits (%.17g); one state, or several one after the other
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// The frame of the state in the file, if there is one state (default: that of the scene's render.time)
    #[arg(long, value_name = "N", conflicts_with = "frames", value_parser = clap::value_parser!(u64).range(..u64::MAX))]
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

/// Compares and prints; a difference beyond the tolerance is an error of [`Kind::Difference`].
pub(crate) fn run(args: &Args, session: &Session) -> Result<()> {
    let scene = args.scene.load(session)?;
    let Some(cloth) = &scene.cloth else {
        return Err(Error::new(
            Kind::Nothing,
            "the scene has no cloth, so there are no positions to compare",
        ));
    };
    let theirs = grader::read(&args.file, [cloth.num_width_points, cloth.num_height_points])?;
    let first_frame = args.first_frame(theirs.len(), &scene)?;
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
    let progress = Tally::new(&session.ui, "trying mistakes", grader::trials_at_most(&scene));
    let comparison = Comparison::new(&case, args.tolerance, &|tried| {
        progress.add(tried);
        session.signals.check()
    })?;
    drop(progress);
    session.print(&comparison, &comparison.text())?;
    result(&comparison, args.tolerance)
}

impl Args {
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
            session.signals.check()
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
        let message =
            format!("`{}` contains {count} states, not {}", self.file.display(), frames.end - frames.start);
        Err(Error::new(Kind::Usage, message).with_help("give the frames of the states with --frames A..B"))
    }
}

/// The error of a difference, which decides the exit code.
fn result(comparison: &Comparison, tolerance: f64) -> Result<()> {
    let Some(Difference { frame, .. }) = comparison.difference else { return Ok(()) };
    let beyond = if tolerance > 0.0 { "differ by more than the tolerance" } else { "are not equal" };
    let message = format!("the positions {beyond} from frame {frame} on");
    Err(Error::new(Kind::Difference, message)
        .with_help("--tolerance 1e-6 accepts differences that come from rounding"))
}

/// Parses a distance that is not negative.
fn distance(text: &str) -> Result<f64, String> {
    let number = text.parse().ok().filter(|metres: &f64| metres.is_finite() && *metres >= 0.0);
    number.ok_or_else(|| "expected a number of metres, 0 or above".to_owned())
}
