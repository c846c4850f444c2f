//! `drape compare-positions`: where the positions of another program part from ours, and why.

mod mistakes;
mod numbers;
mod parting;
mod states;
mod verdict;

use std::path::PathBuf;

use serde::Serialize;

use self::parting::{Difference, Ours};
use self::verdict::{Case, Tried, Verdict};
use crate::args::frames::Frames;
use crate::args::scene::{SceneArgs, StabilityArgs, frame_at};
use crate::run::start::start_from;
use crate::session::Session;
use crate::session::progress::Progress;
use drape::error::{Error, Kind, Result};
use drape::scene::Scene;
use drape::simulation::Simulation;

/// What `compare-positions` takes.
#[derive(clap::Args)]
pub(crate) struct Args {
    #[command(flatten)]
    scene: SceneArgs,
    /// The other program's positions, x y z of each point, row by row: f64 little-endian, or text with 17
    /// digits (%.17g); several states one after the other
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// The frame of the one state in the file (default: that of the scene's render.time)
    #[arg(long, value_name = "N", conflicts_with = "frames", value_parser = clap::value_parser!(u64).range(..u64::MAX))]
    frame: Option<u64>,
    /// The frames of the states in the file, from A up to, without, B (default: found by their number)
    #[arg(long, value_name = "A..B")]
    frames: Option<Frames>,
    /// Largest accepted distance between two points, in metres; 0 asks for equal bits
    #[arg(long, value_name = "M", default_value_t = 0.0, value_parser = distance)]
    tolerance: f64,
    #[command(flatten)]
    stability: StabilityArgs,
}

/// How the positions differ.
#[derive(Serialize)]
struct Report {
    states: usize,
    first_frame: u64,
    tolerance: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    difference: Option<Difference>,
    /// The mistakes that were run and what each leaves of the difference, the best first.
    mistakes: Vec<Tried>,
    verdict: String,
}

/// Compares and prints; a difference beyond the tolerance is an error of [`Kind::Difference`].
pub(crate) fn run(args: &Args, session: &Session) -> Result<()> {
    let scene = args.scene.load(session)?;
    let Some(cloth) = &scene.cloth else {
        return Err(Error::new(Kind::Nothing, "the scene has no cloth, so there are no positions"));
    };
    let theirs = states::read(&args.file, [cloth.num_width_points, cloth.num_height_points])?;
    let first_frame = args.first_frame(theirs.len(), &scene)?;
    let plural = if theirs.len() == 1 { "" } else { "s" };
    session.ui.note(&format!("{} state{plural}, the first at frame {first_frame}", theirs.len()));
    let last_frame = first_frame + theirs.len() as u64 - 1;
    let plain = Simulation::new(&scene)?;
    let start = parting::start_of(&theirs[0], plain.positions(), cloth).filter(|_| first_frame == 0);
    if start.is_some() {
        session.ui.note("the cloth stands at random depths, so ours starts from those of the file");
    }
    let simulation = start_from(&scene, last_frame, start.as_ref(), args.stability.allow_unstable, session)?;
    let mut progress = Progress::new(&session.ui, "simulating", last_frame);
    let ours = Ours::simulate(simulation, first_frame, theirs.len(), |simulation| {
        progress.set(simulation.frame());
        session.signals.check()
    })?;
    drop(progress);
    let case = Case { scene: &scene, cloth, first_frame, start, ours: &ours, theirs: &theirs };
    let difference = Difference::first(&case, args.tolerance);
    let Verdict { words, mistakes } = match &difference {
        None if args.tolerance > 0.0 => {
            Verdict::only("the positions are within the tolerance of the method's")
        }
        None => Verdict::only("the positions are those of the method: every bit is equal"),
        Some(_) => case.judge(args.tolerance, session)?,
    };
    let (states, tolerance) = (theirs.len(), args.tolerance);
    let report = Report { states, first_frame, tolerance, difference, mistakes, verdict: words };
    session.print(&report, &report.text())?;
    report.result()
}

impl Args {
    /// The frame of the first of `count` states.
    fn first_frame(&self, count: usize, scene: &Scene) -> Result<u64> {
        let count = count as u64;
        let frames = match (&self.frames, self.frame) {
            (Some(frames), _) => frames.0.clone(),
            (None, Some(frame)) => frame..frame + 1,
            // One state is the end, as `simulate --positions` writes it; as many as there are frames
            // leave out the start.
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
            format!("`{}` holds {count} states, not {}", self.file.display(), frames.end - frames.start);
        Err(Error::new(Kind::Usage, message).with_help("--frames A..B says which frames they are"))
    }
}

impl Report {
    fn text(&self) -> String {
        let mut text = format!("states      {} from frame {}\n", self.states, self.first_frame);
        if let Some(found) = &self.difference {
            let Difference { frame, point: [i, j], ours, theirs, .. } = found;
            let metres = |value: Option<f64>| value.map_or("no number".to_owned(), |m| format!("{m:.3e} m"));
            let theirs = theirs.map(|value| value.unwrap_or(f64::NAN));
            text += &format!(
                "parts at    frame {frame}, column {i}, row {j}\n  ours      {ours:?}\n  theirs    {theirs:?}\n\
                 distance    {}, the largest there {}, in the last frame {}\n",
                metres(found.distance),
                metres(found.largest),
                metres(found.largest_at_the_end),
            );
            let helps = self.mistakes.iter().filter(|tried| tried.left < 0.9);
            text += &helps.take(3).map(Tried::line).collect::<String>();
        }
        text + &format!("verdict     {}\n", self.verdict)
    }

    /// The exit code's error.
    fn result(&self) -> Result<()> {
        let Some(Difference { frame, .. }) = self.difference else { return Ok(()) };
        let beyond = if self.tolerance > 0.0 { "differ by more than the tolerance" } else { "are not equal" };
        let message = format!("the positions {beyond} from frame {frame} on");
        Err(Error::new(Kind::Difference, message).with_help("--tolerance 1e-6 lets rounding pass"))
    }
}

/// Reads a distance that is not negative.
fn distance(text: &str) -> Result<f64, String> {
    let number = text.parse().ok().filter(|metres: &f64| metres.is_finite() && *metres >= 0.0);
    number.ok_or_else(|| "a distance is a number of metres, 0 or above".to_owned())
}
