//! `drape horizon`: for how long positions can be trusted.

use std::fmt::Write;
use std::path::PathBuf;

use crate::args::flag::seconds;
use crate::args::frames::frame;
use crate::args::output::output;
use crate::args::scene::{SceneArgs, frame_at};
use crate::session::Session;
use crate::session::files::atomic;
use crate::session::files::outputs;
use crate::session::files::target::Content;
use crate::session::progress::Tally;
use drape::error::{Error, Kind, Result};
use drape::scene::SEEN;
use drape_lab::accuracy::measure::Measure;
use drape_lab::accuracy::source::Source;
use drape_lab::horizon::{self, Horizon};

/// The arguments of `horizon`.
#[derive(clap::Args)]
pub(crate) struct Args {
    #[command(flatten)]
    scene: SceneArgs,
    /// Write a page that draws how the copies part
    #[arg(value_name = "OUT.html", value_parser = output())]
    page: Option<PathBuf>,
    /// Simulated time in seconds, rounded to the nearest frame (default: the scene's render.time)
    #[arg(long, value_name = "S", value_parser = seconds, conflicts_with = "frame")]
    time: Option<f64>,
    /// Number of the frame, instead of --time
    #[arg(long, value_name = "N", value_parser = frame)]
    frame: Option<u64>,
}

/// Runs the scene beside its copies, writes the page and prints when they part.
pub(crate) fn run(args: &Args, session: &Session) -> Result<()> {
    let scene = args.scene.load(session)?;
    outputs::check(&args.scene.inputs(), args.page.iter().map(|path| (path.as_path(), Content::Text)))?;
    args.scene.caution_of_moment(
        &[("--time", args.time.is_some()), ("--frame", args.frame.is_some())],
        &session.ui,
    );
    args.scene.caution(&SEEN, "`horizon` draws nothing", &session.ui);
    let frames = args.frame.unwrap_or_else(|| frame_at(args.time, &scene));
    if scene.cloth.is_none() || frames == 0 {
        return Err(Error::new(
            Kind::Nothing,
            "nothing moves: there is no cloth, or the moment is the start",
        )
        .with_help("name a later moment with --time or --frame"));
    }
    let source = Source { path: args.scene.path.clone(), overrides: args.scene.overrides() };
    let progress = Tally::new(&session.ui, "simulating, frames", frames);
    let watch = || {
        progress.add(1);
        session.stop.check()
    };
    let horizon = Horizon::of(&source, &[], frames, Measure::Max, &watch)?;
    drop(progress);
    if let Some(path) = &args.page {
        let name = args.scene.path.file_name().unwrap_or_default().to_string_lossy();
        atomic::write(path, horizon::page(&horizon, &name)?.as_bytes())?;
    }
    session.print(&horizon, &text(&horizon))
}

fn text(horizon: &Horizon) -> String {
    let mut text = format!("copies start {:.1e} m apart\n", horizon.rounding);
    for reached in &horizon.times {
        let when = reached.time.map_or("not by the end".to_owned(), |time| format!("after {time:.3} s"));
        // Writing to a string cannot fail.
        let _ = writeln!(text, "a point is {:e} m apart {when}", reached.distance);
    }
    if let Some(last) = horizon.partings.last() {
        let _ = writeln!(text, "at {:.3} s: {:.2e} m, at most {:.2e} m", last.time, last.rms, last.max);
    }
    if let Some(growth) = horizon.growth {
        let _ = writeln!(text, "growth before 1e-6 m: by e every {:.4} s", 1.0 / growth);
    }
    text
}
