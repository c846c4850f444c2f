//! `drape choose`: the cheapest settings for an accuracy, or the most accurate for a time.

use std::path::PathBuf;
use std::time::Duration;

use crate::args::flag::seconds;
use crate::args::frames::frame;
use crate::args::output::output;
use crate::args::scene::{SceneArgs, frame_at};
use crate::session::files::atomic;
use crate::session::files::outputs;
use crate::session::files::target::Content;
use crate::session::ui::Ui;
use crate::session::{Session, json_failed};
use drape::error::{Error, Kind, Result};
use drape::scene::SEEN;
use drape_lab::accuracy::measure::Measure;
use drape_lab::accuracy::source::Source;
use drape_lab::choose::goal::Tolerance;
use drape_lab::choose::{self, Answer};

/// The arguments of `choose`.
#[derive(clap::Args)]
#[command(group = clap::ArgGroup::new("goal").required(true).args(["within", "budget"]))]
pub(crate) struct Args {
    #[command(flatten)]
    scene: SceneArgs,
    /// How far the points may be from the limit of ever smaller steps, root mean square: a length such as 1mm, or
    /// 0.5px, the largest distance in the picture
    #[arg(long, value_name = "LENGTH")]
    within: Option<Tolerance>,
    /// How long the simulation to the moment may take, such as 2s or 500ms
    #[arg(long, value_name = "TIME", value_parser = duration)]
    budget: Option<Duration>,
    /// The largest distance of a point instead of the root mean square
    #[arg(long)]
    max: bool,
    /// Simulated time in seconds, rounded to the nearest frame (default: the scene's render.time)
    #[arg(long, value_name = "S", value_parser = seconds, conflicts_with = "frame")]
    time: Option<f64>,
    /// Number of the frame, instead of --time
    #[arg(long, value_name = "N", value_parser = frame)]
    frame: Option<u64>,
    /// Write the choice to this file as a JSON merge patch, for --patch of the other commands
    #[arg(long, value_name = "FILE", value_parser = output())]
    patch_out: Option<PathBuf>,
}

/// Keys that change a picture, but no distance in it.
const UNMEASURED: [&str; 9] = [
    "light",
    "material",
    "cloth.material",
    "sphere.material",
    "box.material",
    "plane.material",
    "sphere.resolution",
    "render.samples",
    "render.background",
];

/// Searches, prints what was found and writes the patch.
pub(crate) fn run(args: &Args, session: &Session) -> Result<()> {
    let scene = args.scene.load(session)?;
    let patch = args.patch_out.iter().map(|path| (path.as_path(), Content::Text));
    outputs::check(&args.scene.inputs(), patch)?;
    let source = Source { path: args.scene.path.clone(), overrides: args.scene.overrides() };
    args.caution(&session.ui);
    let frames = args.frame.unwrap_or_else(|| frame_at(args.time, &scene));
    let watch = || session.stop.check();
    let answer = match (args.within, args.budget) {
        (Some(tolerance), _) => choose::within(&source, frames, args.measured(tolerance), &watch),
        (None, Some(budget)) => choose::within_budget(&source, frames, budget, args.measure(), &watch),
        (None, None) => Err(Error::new(Kind::Usage, "neither --within nor --budget is given")),
    }?;
    args.write_patch(&answer)?;
    session.print(&answer, &answer.text())?;
    match answer.reason {
        Some(reason) => Err(Error::new(Kind::Difference, reason.lines().next().unwrap_or_default())),
        None => Ok(()),
    }
}

impl Args {
    /// Warns of options that change nothing.
    fn caution(&self, ui: &Ui) {
        self.scene
            .caution_of_moment(&[("--time", self.time.is_some()), ("--frame", self.frame.is_some())], ui);
        if !self.in_pixels() {
            return self.scene.caution(&SEEN, "no length depends on how the scene is drawn", ui);
        }
        self.scene.caution(&UNMEASURED, "distances in the picture do not depend on it", ui);
        if self.max {
            ui.caution("--max has no effect: in pixels it is the largest distance that counts", "");
        }
    }

    /// Whether the distance is one in the picture.
    fn in_pixels(&self) -> bool {
        self.within.is_some_and(|tolerance| tolerance.measure == Measure::Pixels)
    }

    fn measure(&self) -> Measure {
        if self.max { Measure::Max } else { Measure::Rms }
    }

    fn measured(&self, tolerance: Tolerance) -> Tolerance {
        let measure = if tolerance.measure == Measure::Pixels { Measure::Pixels } else { self.measure() };
        Tolerance { measure, ..tolerance }
    }

    fn write_patch(&self, answer: &Answer) -> Result<()> {
        let Some((path, choice)) = self.patch_out.as_ref().zip(answer.choice.as_ref()) else { return Ok(()) };
        let text = serde_json::to_string_pretty(&choice.patch()).map_err(|e| json_failed(&e))?;
        atomic::write(path, (text + "\n").as_bytes())
    }
}

/// Parses a time such as `2s` or `500ms`.
fn duration(text: &str) -> Result<Duration, String> {
    let wrong = || "expected a time above 0 with its unit, s or ms, such as 2s or 500ms".to_owned();
    let parsed = [("ms", 1e-3), ("s", 1.0)]
        .into_iter()
        .find_map(|(unit, factor)| Some(text.strip_suffix(unit)?.trim_end().parse::<f64>().ok()? * factor));
    let seconds = parsed.filter(|&seconds| seconds > 0.0).ok_or_else(wrong)?;
    Duration::try_from_secs_f64(seconds).map_err(|_| wrong())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_time_has_a_unit() {
        assert_eq!(duration("2s"), Ok(Duration::from_secs(2)));
        assert_eq!(duration("500 ms"), Ok(Duration::from_millis(500)));
        for text in ["", "2", "-1s", "0s", "nans", "infs", "1e30s", "1m"] {
            assert!(duration(text).is_err(), "{text}");
        }
    }
}
