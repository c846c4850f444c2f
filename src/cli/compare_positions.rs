//! `drape compare-positions`: where the positions of another program part from ours, and why.

use std::ops::Range;
use std::path::PathBuf;

use serde::Serialize;

use super::Session;
use super::advance::start;
use super::mistakes::{self, Mistake};
use super::moments::Frames;
use super::parting::{Difference, Ours, difference, first, largest, simulate};
use super::scene::{Leniency, SceneArgs, frame_at};
use super::states::{self, State};
use crate::cloth::Counters;
use crate::error::{Error, Kind, Result};
use crate::scene::Scene;

/// How many states from the first that differs a mistake is held against. Further on chaos hides it.
const WINDOW: usize = 10;

/// A mistake that leaves less than this part of the difference is the one that was made.
const EXPLAINS: f64 = 1e-3;

/// A mistake that leaves less than this part of the difference is like the one that was made.
const RESEMBLES: f64 = 0.3;

/// Largest difference, in metres, that a changed order of operations is known to make at first.
const ROUNDING: f64 = 1e-11;

/// What `compare-positions` takes.
#[derive(clap::Args)]
pub(super) struct Args {
    #[command(flatten)]
    scene: SceneArgs,
    /// The other program's positions, x y z of each point, row by row: f64 little-endian or text; several
    /// states one after the other
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// The frame of the one state in the file
    #[arg(long, value_name = "N", conflicts_with = "frames")]
    frame: Option<u64>,
    /// The frames of the states in the file, from A up to, without, B (default: found by their number)
    #[arg(long, value_name = "A..B")]
    frames: Option<Frames>,
    /// Largest distance between two points that is let pass, in metres; 0 asks for equal bits
    #[arg(long, value_name = "M", default_value_t = 0.0, value_parser = distance)]
    tolerance: f64,
    #[command(flatten)]
    leniency: Leniency,
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

/// A mistake that was run.
#[derive(Serialize)]
struct Tried {
    mistake: &'static str,
    /// 0: the mistake explains everything, 1: nothing.
    left: f64,
}

/// Compares and prints; a difference beyond the tolerance is an error of [`Kind::Difference`].
pub(super) fn run(args: &Args, session: &Session) -> Result<()> {
    let scene = args.scene.load(session)?;
    let Some(cloth) = &scene.cloth else {
        return Err(Error::new(Kind::Nothing, "the scene has no cloth, so there are no positions"));
    };
    let theirs = states::read(&args.file, cloth.num_width_points * cloth.num_height_points)?;
    let first_frame = args.first_frame(theirs.len(), &scene)?;
    session.ui.note(&format!("{} states, the first at frame {first_frame}", theirs.len()));
    let last_frame = first_frame + theirs.len() as u64 - 1;
    let simulation = start(&scene, last_frame, args.leniency.allow_unstable, session)?;
    let ours = simulate(simulation, first_frame, theirs.len(), session)?;
    let mut report = Report {
        states: theirs.len(),
        first_frame,
        tolerance: args.tolerance,
        difference: None,
        mistakes: Vec::new(),
        verdict: "the positions are those of the method".to_owned(),
    };
    let parts =
        ours.iter().zip(&theirs).position(|(ours, theirs)| first(ours, theirs, args.tolerance).is_some());
    if let Some(k) = parts {
        report.difference =
            difference(&ours, &theirs, k, first_frame, args.tolerance, cloth.num_width_points);
        let window = k..(k + WINDOW).min(theirs.len());
        report.mistakes = try_all(&mistakes::all(&scene), &ours, &theirs, first_frame, window, session)?;
        report.verdict = report.judge(&ours[k], &scene);
    }
    session.print(&report, &report.text())?;
    match report.difference {
        None => Ok(()),
        Some(Difference { frame, .. }) => {
            Err(Error::new(Kind::Difference, format!("the positions part at frame {frame}")))
        }
    }
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

/// Runs every mistake over the states `window`; the one that comes nearest to `theirs` first.
fn try_all(
    mistakes: &[Mistake],
    ours: &[Ours],
    theirs: &[State],
    first_frame: u64,
    window: Range<usize>,
    session: &Session,
) -> Result<Vec<Tried>> {
    let error = |states: &[Ours]| -> f64 {
        states
            .iter()
            .zip(&theirs[window.clone()])
            .map(|(ours, theirs)| largest(&ours.positions, theirs))
            .sum()
    };
    let without = error(&ours[window.clone()]);
    let mut tried = Vec::new();
    for mistake in mistakes {
        let run = mistake.simulation().and_then(|simulation| {
            simulate(simulation, first_frame + window.start as u64, window.len(), session)
        });
        match run {
            // A mistake that leads nowhere is not the one that was made.
            Err(error) if error.kind == Kind::Unstable => {}
            Err(error) => return Err(error),
            Ok(states) => {
                let left = error(&states) / without;
                tried.push(Tried {
                    mistake: mistake.name,
                    left: if left.is_finite() { left } else { f64::MAX },
                });
            }
        }
    }
    tried.sort_by(|a, b| a.left.total_cmp(&b.left));
    Ok(tried)
}

impl Report {
    /// What the difference comes from, as far as can be told. `ours` is our first state that differs.
    fn judge(&self, ours: &Ours, scene: &Scene) -> String {
        if self.difference.as_ref().and_then(|d| d.largest).is_some_and(|largest| largest <= ROUNDING) {
            return "this looks like rounding: the same method with its operations in another order"
                .to_owned();
        }
        match self.mistakes.first() {
            Some(best) if best.left <= EXPLAINS => format!("this is the mistake: {}", best.mistake),
            Some(best) if best.left <= RESEMBLES => {
                format!("this is most like the mistake: {}", best.mistake)
            }
            _ => suspects(ours.counters, scene),
        }
    }

    fn text(&self) -> String {
        let mut text = format!("states      {} from frame {}\n", self.states, self.first_frame);
        if let Some(found) = &self.difference {
            let Difference { frame, point: [i, j], ours, theirs, .. } = found;
            let metres = |value: Option<f64>| value.map_or("no number".to_owned(), |m| format!("{m:.3e} m"));
            let theirs = theirs.map(|value| value.unwrap_or(f64::NAN));
            text += &format!(
                "parts at    frame {frame}, point ({i}, {j})\n  ours      {ours:?}\n  theirs    {theirs:?}\n\
                 distance    {}, the largest there {}, in the last frame {}\n",
                metres(found.distance),
                metres(found.largest),
                metres(found.largest_at_the_end),
            );
            for Tried { mistake, left } in self.mistakes.iter().take(3) {
                text += &format!("tried       leaves {left:.1e} of the difference: {mistake}\n");
            }
        }
        text + &format!("verdict     {}\n", self.verdict)
    }
}

/// What no run can tell apart, but acted before the positions parted.
fn suspects(counters: Counters, scene: &Scene) -> String {
    let self_collision = "self-collision (boxes told apart by a hash; order of points)";
    let planes = "collision with planes (the offset of 0.0001 m, its side, friction)";
    let spheres = "collision with spheres (friction, points at the centre)";
    let limit = "the stretch limit (its order, pinned ends)";
    let touched = counters.object_moves > 0;
    let acted = [
        (counters.self_collision_moves > 0, self_collision),
        (touched && !scene.planes.is_empty(), planes),
        (touched && !scene.spheres.is_empty(), spheres),
        (counters.springs_limited > 0, limit),
    ];
    let names: Vec<&str> = acted.iter().filter(|(acted, _)| *acted).map(|(_, name)| *name).collect();
    if names.is_empty() {
        return "none of the mistakes that can be run; no collision and no limit had acted yet, so look at the \
                start, the forces and Verlet's step"
            .to_owned();
    }
    format!("none of the mistakes that can be run; up to there acted {}", names.join(", "))
}

/// Reads a distance that is not negative.
fn distance(text: &str) -> Result<f64, String> {
    let number = text.parse().ok().filter(|metres: &f64| metres.is_finite() && *metres >= 0.0);
    number.ok_or_else(|| "a distance is a number of metres, 0 or above".to_owned())
}
