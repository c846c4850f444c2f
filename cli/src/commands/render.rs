//! `drape render`: one picture of a scene.

use std::path::{Path, PathBuf};

use clap::Parser;
use serde::Serialize;

use crate::args::output::output;
use crate::args::render::{RenderArgs, warn_of_nothing_visible};
use crate::args::scene::{Moment, SceneArgs};
use crate::args::state::StateArgs;
use crate::run::advance::{Until, advance_until};
use crate::run::bench;
use crate::run::start::{renderer, start};
use crate::session::Session;
use crate::session::files::atomic;
use crate::session::files::outputs;
use crate::session::files::target::Content;
use drape::error::{Error, Kind, Result};
use drape::output::png::{self, Effort};
use drape::output::provenance::{Arguments, Provenance, hex};
use drape::output::raw;
use drape::raster::Stats;
use drape::render::Picture;
use drape::scene::Scene;
use drape::simulation::Simulation;

/// The arguments of `render`.
#[derive(clap::Args)]
pub(crate) struct Args {
    #[command(flatten)]
    pub(crate) scene: SceneArgs,
    /// The picture to write, a PNG file (default: the name of the scene with .png, in the current folder; `-` for
    /// standard output)
    #[arg(value_name = "OUT.png", value_parser = output())]
    picture: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) moment: Moment,
    #[command(flatten)]
    state: StateArgs,
    #[command(flatten)]
    pub(crate) render: RenderArgs,
    /// Write the depth of each pixel to this file: f32 little-endian, top row first (`-` for standard output)
    #[arg(long, value_name = "FILE", value_parser = output())]
    depth: Option<PathBuf>,
    /// Write the distance along the view axis of what each pixel shows to this file, in metres, infinite for the
    /// background: f32 little-endian, top row first (`-` for standard output)
    #[arg(long, value_name = "FILE", value_parser = output())]
    depth_metres: Option<PathBuf>,
    /// Write what each pixel shows to this file: object << 24 | (triangle + 1), or 0 for the background; u32
    /// little-endian, top row first (`-` for standard output)
    #[arg(long, value_name = "FILE", value_parser = output())]
    ids: Option<PathBuf>,
    /// Print the statistics of drawing: counts of vertices, primitives and fragments
    #[arg(long)]
    stats: bool,
    /// Draw the picture N times after a warm-up and print the times as JSON; no picture is written
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..),
          conflicts_with_all = ["picture", "depth", "depth_metres", "ids", "stats"])]
    bench: Option<u32>,
    /// Print the hash of the picture, over the bytes of its red, green and blue from the top row on; no picture is
    /// written
    #[arg(long, conflicts_with_all = ["picture", "depth", "depth_metres", "ids", "stats", "bench"])]
    hash: bool,
}

/// The hash of a picture.
#[derive(Serialize)]
struct Hash {
    picture_hash: String,
    width: u32,
    height: u32,
    frame: u64,
    time: f64,
}

/// The summary.
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
    let loaded = args.scene.load_with_flags(&args.render.flags(), session)?;
    let scene = &loaded.scene;
    args.moment.caution(&args.scene, &session.ui);
    let until = args.moment.until(scene);
    let path = args.picture_path()?;
    args.check_outputs(&path, scene, session)?;
    // All inputs are read before anything is simulated.
    let renderer = renderer(scene, &args.render.textures(), session)?;
    args.render.caution(scene, &renderer, &session.ui);
    if !args.writes() {
        args.render.provenance.caution_of_no_file(&session.ui);
    }
    let mut simulation = start(scene, until.frames, args.moment.stability.allow_unstable, session)?;
    let seen = args.state.restore(&mut simulation, scene, until.frames)?;
    let until = Until { seen, ..until };
    let mut saving = args.state.saving(scene);
    let ended =
        advance_until(&mut simulation, scene, until, session, |now, seen| saving.after_frame(now, seen))?;
    saving.finish(&simulation, ended.seen)?;
    let options = args.render.options(args.ids.is_some());
    if let Some(runs) = args.bench {
        return bench::run(&renderer, simulation.positions(), &options, runs, session);
    }
    let picture = renderer.draw(simulation.positions(), &options);
    session.stop.check()?;
    if args.hash {
        print_hash(&picture, &simulation, session)?;
    } else {
        let arguments = Arguments { frame: Some(simulation.frame()), ..Arguments::default() };
        let textures = args.render.texture_hash(scene, &renderer);
        let provenance = Provenance { textures, ..args.render.provenance(&loaded, arguments) };
        let provenance = provenance.of_picture(simulation.state_hash(), picture.hash());
        if let Some(path) = &args.depth_metres {
            let metres = renderer.metres(&picture.depth, simulation.positions(), &options);
            atomic::write(path, &raw::depths(&metres))?;
        }
        args.write(&path, &picture, &provenance)?;
        args.finish(&path, &picture, &simulation, session)?;
    }
    ended.result()
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

    /// Whether the picture is written.
    fn writes(&self) -> bool {
        self.bench.is_none() && !self.hash
    }

    /// The path of the picture; none is needed where it is not written.
    fn picture_path(&self) -> Result<PathBuf> {
        if !self.writes() {
            return Ok(PathBuf::new());
        }
        let named = (self.scene.path.as_os_str() != "-").then_some(&self.scene.path);
        let beside = || Some(Path::new(named?.file_stem()?).with_extension("png"));
        match self.picture.clone().or_else(beside) {
            Some(path) => Ok(path),
            None => Err(Error::new(Kind::Usage, "the scene has no file name to name the picture after")
                .with_help("name the picture: drape render SCENE OUT.png")),
        }
    }

    /// Checks all outputs before any long work; with `--bench` and `--hash` there are none.
    fn check_outputs(&self, picture: &Path, scene: &Scene, session: &Session) -> Result<()> {
        if !self.writes() {
            return Ok(());
        }
        outputs::check_ending(picture, "png")?;
        outputs::check_stdout(self.fills_stdout(), self.stats || session.ui.json)?;
        let raw = [&self.depth, &self.depth_metres, &self.ids].into_iter().flatten().map(PathBuf::as_path);
        let all = [picture].into_iter().chain(raw).map(|path| (path, Content::Binary));
        let inputs = [self.scene.inputs(), self.render.inputs(scene), self.state.inputs().collect()].concat();
        outputs::check(&inputs, all.chain(self.state.outputs()))
    }

    fn fills_stdout(&self) -> bool {
        outputs::takes_stdout(&[&self.picture, &self.depth, &self.depth_metres, &self.ids])
    }

    fn write(&self, path: &Path, picture: &Picture, provenance: &Provenance) -> Result<()> {
        let &Picture { width, height, ref rgb, .. } = picture;
        let bytes = png::encode_with(width, height, rgb, Effort::Fast, &provenance.texts())?;
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
            warn_of_nothing_visible("the picture", &session.ui);
        }
        if !self.stats && !session.ui.json {
            return Ok(());
        }
        let summary = Summary { picture: path.display().to_string(), width, height, frame, time, stats };
        session.print(&summary, &text(&stats))
    }
}

fn print_hash(picture: &Picture, simulation: &Simulation, session: &Session) -> Result<()> {
    let &Picture { width, height, .. } = picture;
    let picture_hash = hex(picture.hash());
    let text = format!("{picture_hash}\n");
    let (frame, time) = (simulation.frame(), simulation.time());
    session.print(&Hash { picture_hash, width, height, frame, time }, &text)
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
