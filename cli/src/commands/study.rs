//! `drape study`: cost against accuracy.

use std::path::{Path, PathBuf};

use crate::args::address::address;
use crate::args::flag::seconds;
use crate::args::part::Part;
use crate::args::scene::SceneArgs;
use crate::args::textures;
use crate::commands::cells;
use crate::session::files::atomic;
use crate::session::files::outputs;
use crate::session::files::target::Content;
use crate::session::progress::Tally;
use crate::session::ui::Ui;
use crate::session::{Session, json_failed};
use drape::error::{Error, Kind, Result};
use drape::scene::Scene;
use drape::texture_source::TextureSource;
use drape_lab::accuracy::source::Source;
use drape_lab::printable;
use drape_lab::study::extent::{Extent, KEPT};
use drape_lab::study::{self, Results};

/// The latest moment of a study, in tenths of a second.
const MOST_TENTHS: f64 = 600.0;

/// Keys of which a study tries values of its own.
const VARIED: [&str; 5] =
    ["sim.integrator", "sim.steps_per_frame", "sim.precision", "sim.start", "sim.damping"];

/// The arguments of `study`.
#[derive(clap::Args)]
pub(crate) struct Args {
    #[command(flatten)]
    scene: SceneArgs,
    /// The folder for index.html, results.json, results.csv and the finished runs (default: the name of the scene
    /// with -study, in the current folder)
    #[arg(value_name = "OUT")]
    folder: Option<PathBuf>,
    /// Fewer runs, in under two minutes for a cloth of 50 x 50 points
    #[arg(long)]
    quick: bool,
    /// Compare at moments up to this one, in tenths of a second, instead of up to 0.5 s (--quick: 0.2 s)
    #[arg(long, value_name = "S", value_parser = seconds)]
    time: Option<f64>,
    /// Keep this option of the scene in the model that all methods approach, although it may have no limit as the
    /// step shrinks; repeatable
    #[arg(long, value_name = "KEY", value_parser = clap::builder::PossibleValuesParser::new(KEPT))]
    keep: Vec<String>,
    /// Only the runs whose name contains this text in upper or lower case, or that have this integrator, such as
    /// `bdf2`, `BDF2 at 600 steps/s` or `k/m 8.33e4`; repeatable. No pictures are drawn
    #[arg(long, value_name = "TEXT")]
    only: Vec<String>,
    /// Run only part K of N and keep the results in OUT/cells, for the command without --part. Times are comparable
    /// only if the machines are alike and do nothing else
    #[arg(long, value_name = "K/N")]
    part: Option<Part>,
    /// Read all textures from this folder (texture_1.png, ..., cube/posx.png, ...) instead of the built-in set
    #[arg(long, value_name = "DIR")]
    textures: Option<PathBuf>,
    /// Link each run on the page to its cloth on the live page at this address (see web/README.md)
    #[arg(long, value_name = "URL", value_parser = address)]
    live: Option<String>,
}

/// Runs what no earlier study has finished, writes the page and prints the advice.
pub(crate) fn run(args: &Args, session: &Session) -> Result<()> {
    let scene = args.scene.load(session)?;
    args.caution(&scene, &session.ui);
    let source = Source { path: args.scene.path.clone(), overrides: args.scene.overrides() };
    let extent = if args.quick { Extent::quick() } else { Extent::full() };
    let extent = args.time.map_or_else(|| Ok(extent.clone()), |time| up_to(extent.clone(), time))?;
    let kept = KEPT.into_iter().filter(|key| args.keep.iter().any(|keep| keep == key)).collect();
    let extent = Extent { only: args.only.clone(), part: args.part.and_then(Part::of), kept, ..extent };
    let textures = args.textures.clone().map_or(TextureSource::BuiltIn, TextureSource::Folder);
    let folder = args.folder()?;
    let live = args.live.as_deref().map(|url| args.scene.live(url)).transpose()?;
    let steps = study::steps(&source, &extent)?;
    let store = cells::open(&folder)?;
    let [page, json, table] = ["index.html", "results.json", "results.csv"].map(|name| folder.join(name));
    let files = [&page, &json, &table].map(|file| (file.as_path(), Content::Text));
    outputs::check(&args.scene.inputs(), files)?;
    let progress = Tally::new(&session.ui, "studying, steps", steps);
    let watch = |made: u32| {
        progress.add(u64::from(made));
        cells::check_stop(session)
    };
    let study = study::run(&source, &textures, &extent, &store, &watch)?;
    drop(progress);
    if args.part.is_some() {
        cells::finish_part(&store, &folder, session);
        return Ok(());
    }
    cells::warn_of_damaged(&store, session);
    let name = args.scene.path.file_name().unwrap_or_default().to_string_lossy();
    let results = Results::new(&study, &name, store.counts());
    let text = serde_json::to_string_pretty(&results).map_err(|e| json_failed(&e))?;
    atomic::write(&json, printable::json(&text).as_bytes())?;
    atomic::write(&table, study::csv(&study).as_bytes())?;
    atomic::write(&page, study::page(&study, &name, live.as_ref())?.as_bytes())?;
    session.ui.note(&format!("{}: page written", page.display()));
    session.print(&results, &results.text())
}

/// The same study up to `time` seconds.
fn up_to(extent: Extent, time: f64) -> Result<Extent> {
    let tenths = (10.0 * time).round();
    if !(1.0..=MOST_TENTHS).contains(&tenths) {
        let error = Error::new(
            Kind::Usage,
            format!("--time {time}: a study takes from 0.1 s to {} s", MOST_TENTHS / 10.0),
        );
        return Err(error.with_help("`drape choose` answers for a single moment, however late"));
    }
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 1 to 600")]
    Ok(extent.up_to(tenths as u32))
}

impl Args {
    /// Warns of options that change nothing.
    fn caution(&self, scene: &Scene, ui: &Ui) {
        self.scene.caution_of_own_moments(ui);
        self.scene.caution(&VARIED, "the study tries values of its own", ui);
        for (key, path) in KEPT.into_iter().map(|key| (key, format!("sim.{key}"))) {
            if !self.keep.iter().any(|keep| keep == key) {
                self.scene.caution(
                    &[&path],
                    &format!("the study goes without it, except for --keep {key}"),
                    ui,
                );
            }
        }
        if self.live.is_some() && self.part.is_some() {
            ui.caution("--live has no effect: a part writes no page", "");
        }
        if self.only.is_empty() {
            textures::caution(self.textures.as_deref(), scene, ui);
        } else if self.textures.is_some() {
            ui.caution("--textures has no effect: with --only no pictures are drawn", "");
        }
    }

    fn folder(&self) -> Result<PathBuf> {
        let beside = || {
            let named = Some(&self.scene.path).filter(|path| path.as_os_str() != "-");
            let name = named?.file_stem()?.to_string_lossy();
            Some(Path::new(&format!("{name}-study")).to_owned())
        };
        let missing = || {
            Error::new(Kind::Usage, "the scene has no file name to name the folder after")
                .with_help("name the folder: drape study SCENE OUT")
        };
        self.folder.clone().or_else(beside).ok_or_else(missing)
    }
}
