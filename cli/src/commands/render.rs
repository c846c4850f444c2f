//! `drape render`: one picture of a scene.

use std::path::{Path, PathBuf};

use clap::Parser;
use serde::Serialize;

use crate::args::render::{Look, nothing_seen};
use crate::args::scene::{Moment, SceneArgs};
use crate::run::advance::advance_until;
use crate::run::bench;
use crate::run::start::start;
use crate::session::Session;
use crate::session::files::atomic;
use crate::session::files::outputs;
use crate::session::files::target::Content;
use drape::error::{Error, Kind, Result};
use drape::output::png::{self, Effort};
use drape::output::raw;
use drape::raster::Stats;
use drape::render::{Picture, Renderer};
use drape::scene::Scene;
use drape::simulation::Simulation;

/// What `render` takes.
#[derive(clap::Args)]
pub(crate) struct Args {
    #[command(flatten)]
    pub(crate) scene: SceneArgs,
    /// The picture to write, PNG (default: the scene's name with .png, in this folder; `-` = standard output)
    #[arg(value_name = "OUT.png")]
    picture: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) moment: Moment,
    #[command(flatten)]
    pub(crate) look: Look,
    /// Write the depth of each pixel, f32 little-endian, top row first
    #[arg(long, value_name = "FILE")]
    depth: Option<PathBuf>,
    /// Write object << 24 | (triangle + 1) of each pixel, 0 for the background, u32 little-endian
    #[arg(long, value_name = "FILE")]
    ids: Option<PathBuf>,
    /// Print what drawing took: vertices, primitives, fragments
    #[arg(long)]
    stats: bool,
    /// Draw the scene N times after a warm-up, write no picture, and print the times as JSON
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..),
          conflicts_with_all = ["picture", "depth", "ids", "stats"])]
    bench: Option<u32>,
}

/// What was drawn.
#[derive(Serialize)]
struct Summary {
    picture: String,
    width: u32,
    height: u32,
    frame: u64,
    time: f64,
    stats: Stats,
}

/// Simulates, draws, writes.
pub(crate) fn run(args: &Args, session: &Session) -> Result<()> {
    let mut scene = args.scene.load(session)?;
    args.look.apply(&mut scene);
    let until = args.moment.until(&scene);
    let path = args.picture_path()?;
    args.check_outputs(&path, &scene, session)?;
    // All inputs are read before anything is simulated.
    let renderer = Renderer::new(&scene, &args.look.textures())?;
    let mut simulation = start(&scene, until.frames, args.moment.leniency.allow_unstable, session)?;
    let moved = advance_until(&mut simulation, &scene, until, session, |_| Ok(()))?;
    let options = args.look.options(args.ids.is_some());
    if let Some(runs) = args.bench {
        return bench::run(&renderer, simulation.positions(), &options, runs, session);
    }
    let picture = renderer.draw(simulation.positions(), &options);
    session.signals.check()?;
    args.write(&path, &picture)?;
    args.finish(&path, &picture, &simulation, session)?;
    moved.result()
}

impl Args {
    /// Reads a whole command line: `drape render` and its arguments.
    pub(crate) fn parse_line(words: Vec<String>) -> std::result::Result<Self, clap::Error> {
        #[derive(clap::Parser)]
        enum Drape {
            Render(Args),
        }
        let Drape::Render(args) = Drape::try_parse_from(words)?;
        Ok(args)
    }

    /// Where the picture goes.
    fn picture_path(&self) -> Result<PathBuf> {
        let beside = || Some(Path::new(self.scene.path.file_stem()?).with_extension("png"));
        match self.picture.clone().or_else(beside) {
            Some(path) => Ok(path),
            None => {
                Err(Error::new(Kind::Usage, "the picture needs a name").with_help("name it after the scene"))
            }
        }
    }

    /// Checks all outputs before any long work; a benchmark has none.
    fn check_outputs(&self, picture: &Path, scene: &Scene, session: &Session) -> Result<()> {
        if self.bench.is_some() {
            return Ok(());
        }
        outputs::check_ending(picture, "png")?;
        outputs::check_stdout(self.fills_stdout(), self.stats || session.ui.json)?;
        let raw = [&self.depth, &self.ids].into_iter().flatten().map(PathBuf::as_path);
        let all = [picture].into_iter().chain(raw).map(|path| (path, Content::Binary));
        let textures = self.look.inputs(scene);
        let inputs: Vec<&Path> =
            self.scene.inputs().into_iter().chain(textures.iter().map(PathBuf::as_path)).collect();
        outputs::check(&inputs, all)
    }

    fn fills_stdout(&self) -> bool {
        outputs::takes_stdout(&[&self.picture, &self.depth, &self.ids])
    }

    fn write(&self, path: &Path, picture: &Picture) -> Result<()> {
        let bytes = png::encode(picture.width, picture.height, &picture.rgb, Effort::Fast)?;
        if let Some(path) = &self.depth {
            atomic::write(path, &raw::depths(&picture.depth))?;
        }
        if let Some(path) = &self.ids {
            atomic::write(path, &raw::ids(&picture.ids))?;
        }
        atomic::write(path, &bytes)
    }

    fn finish(
        &self,
        path: &Path,
        picture: &Picture,
        simulation: &Simulation,
        session: &Session,
    ) -> Result<()> {
        let &Picture { width, height, stats, .. } = picture;
        let (frame, time) = (simulation.frame(), simulation.time());
        session.ui.note(&format!("{}: {width} x {height}, frame {frame}, {time} s", path.display()));
        if stats.fragments == 0 {
            session.ui.note(&nothing_seen("the picture"));
        }
        if !self.stats && !session.ui.json {
            return Ok(());
        }
        let summary = Summary { picture: path.display().to_string(), width, height, frame, time, stats };
        session.print(&summary, &text(&stats))
    }
}

fn text(stats: &Stats) -> String {
    let Stats { vertices, triangles, lines, outside, clipped, non_finite, .. } = stats;
    let Stats { degenerate, no_sample, drawn, fragments, covered, .. } = stats;
    format!(
        "vertices    {vertices}\ntriangles   {triangles}\nlines       {lines}\noutside     {outside}\n\
         clipped     {clipped}\nnon-finite  {non_finite}\ndegenerate  {degenerate}\nno sample   {no_sample}\n\
         drawn       {drawn}\nfragments   {fragments}\ncovered     {covered}\n"
    )
}
