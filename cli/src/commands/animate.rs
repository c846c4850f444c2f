//! `drape animate`: a scene in motion.

use std::path::PathBuf;

use clap::builder::RangedU64ValueParser;
use serde::Serialize;

use crate::animation::format::{MAX_FPS, Playback};
use crate::animation::pipeline::{Drawn, Pictures, Pipeline};
use crate::animation::schedule::FrameSchedule;
use crate::animation::sequence::Sequence;
use crate::animation::target::{self, Target};
use crate::args::flag::seconds;
use crate::args::frames::Frames;
use crate::args::part::Part;
use crate::args::render::{RenderArgs, warn_of_nothing_visible};
use crate::args::scene::{SceneArgs, StabilityArgs, frame_at};
use crate::args::state::StateArgs;
use crate::run::start::{renderer, start};
use crate::session::Session;
use crate::session::files::outputs;
use crate::session::files::target::Content;
use drape::error::{Error, Kind, Result};
use drape::output::provenance::{Arguments, Provenance};
use drape::scene::Scene;
use drape::simulation::Simulation;
use drape::simulation::snapshot::Seen;

/// The arguments of `animate`.
#[derive(clap::Args)]
pub(crate) struct Args {
    #[command(flatten)]
    scene: SceneArgs,
    #[arg(value_name = "OUT", help = target::help())]
    out: PathBuf,
    /// Show the simulated frames from A to B, without B; frame 0 is the start (default: those of --time)
    #[arg(long, value_name = "A..B")]
    frames: Option<Frames>,
    /// Show this many simulated seconds from the start (default: the scene's render.time)
    #[arg(long, value_name = "S", value_parser = seconds, conflicts_with = "frames")]
    time: Option<f64>,
    /// Pictures per second, 1 to 1000 (default: the simulated frames per second, as far as the format can). The
    /// animation plays in real time: picture k shows the simulated frame nearest to k / N seconds after the first
    #[arg(long, value_name = "N", value_parser = RangedU64ValueParser::<u16>::new().range(1..=u64::from(MAX_FPS)))]
    fps: Option<u16>,
    /// Draw only part K of N of the numbered pictures, so that several runs can divide them. The simulation
    /// before its first picture is made in each run, or comes from --from-state
    #[arg(long, value_name = "K/N")]
    part: Option<Part>,
    #[command(flatten)]
    state: StateArgs,
    #[command(flatten)]
    render: RenderArgs,
    #[command(flatten)]
    stability: StabilityArgs,
}

/// The summary.
#[derive(Serialize)]
struct Summary {
    out: String,
    width: u32,
    height: u32,
    fps: u16,
    pictures: u64,
    /// Pictures kept from an earlier run.
    kept: u64,
    seconds: f64,
}

/// Simulates, draws and encodes at the same time.
pub(crate) fn run(args: &Args, session: &Session) -> Result<()> {
    let loaded = args.scene.load_with_flags(&args.render.flags(), session)?;
    let scene = &loaded.scene;
    let moments = [("--time", args.time.is_some()), ("--frames", args.frames.is_some())];
    args.scene.caution_of_moment(&moments, &session.ui);
    let target = Target::parse(&args.out)?;
    let [width, height] = scene.render.size;
    let background = background(scene);
    let playback = Playback { width, height, fps: target.fps(args.fps, scene.sim.fps)?, background };
    let schedule = args.schedule(scene, playback.fps)?;
    args.check_outputs(scene, &target, &schedule)?;
    target.check(playback)?;
    args.render.provenance.caution(&args.out, target.says(), &session.ui);
    // All inputs are read before anything is simulated.
    let renderer = renderer(scene, &args.render.textures(), session)?;
    args.render.caution(scene, &renderer, &session.ui);
    let options = args.render.options(false);
    let textures = args.render.texture_hash(scene, &renderer);
    let of =
        |arguments| Provenance { textures: textures.clone(), ..args.render.provenance(&loaded, arguments) };
    let sequence = target.pattern().map(|pattern| Sequence {
        pattern,
        provenance: of(Arguments::default()),
        size: [width, height],
    });
    if let Some(sequence) = &sequence {
        remove_stale(sequence, schedule.count(), session)?;
    }
    let pictures = args.part.unwrap_or(Part::WHOLE).range(schedule.count());
    let share = pictures.end - pictures.start;
    let pipeline = Pipeline {
        target: &target,
        playback,
        schedule: &schedule,
        pictures,
        renderer: &renderer,
        options,
        sequence,
        provenance: of(schedule.arguments()),
    };
    let drawn = args.draw(scene, &pipeline, session)?;
    args.finish(&target, playback, [share, share - drawn.pictures], session)?;
    if drawn.pictures > 0 && !drawn.visible {
        warn_of_nothing_visible("the pictures", &session.ui);
    }
    Ok(())
}

/// The background as it is stored in a picture.
fn background(scene: &Scene) -> [u8; 3] {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 0 to 255")]
    let level = |c: f64| (c.clamp(0.0, 1.0) * 255.0).round_ties_even() as u8;
    [0, 1, 2].map(|channel| level(scene.render.background[channel]))
}

/// Removes what an earlier, longer run has left, and warns of what is not of this program.
fn remove_stale(sequence: &Sequence<'_>, count: u64, session: &Session) -> Result<()> {
    let others = sequence.remove_from(count)?;
    if let Some(first) = others.first() {
        let message = format!(
            "{} files from `{}` on have names of the animation, and are not of it",
            others.len(),
            first.display()
        );
        session.ui.caution(&message, "remove them, or programs that read all numbers show them too");
    }
    Ok(())
}

impl Args {
    /// Draws the missing pictures, and saves the state at the end if that is asked for.
    fn draw(&self, scene: &Scene, pipeline: &Pipeline<'_>, session: &Session) -> Result<Drawn> {
        let end = pipeline.pictures.clone().next_back().filter(|_| self.state.saves());
        let reached = match (pipeline.missing(session)?, end) {
            (Some([first, last]), end) => Some([first, end.unwrap_or(last)]),
            (None, end) => end.map(|end| [end; 2]),
        };
        let Some([first, last]) = reached else { return Ok(Drawn::default()) };
        let mut simulation =
            start(scene, pipeline.schedule.frame(last), self.stability.allow_unstable, session)?;
        self.state.restore(&mut simulation, scene, pipeline.schedule.frame(first))?;
        let mut saving = self.state.saving(scene);
        let save = |now: &Simulation, Pictures { begun, written }| saving.after_pictures(now, begun, written);
        let (drawn, simulation) = pipeline.run(last, simulation, save, session)?;
        saving.finish(&simulation, Seen::default())?;
        Ok(drawn)
    }

    fn schedule(&self, scene: &Scene, fps: u16) -> Result<FrameSchedule> {
        let frames = self.frames.clone().map_or(0..frame_at(self.time, scene), |frames| frames.0);
        let schedule = FrameSchedule::new(frames, scene.sim.fps, fps);
        if schedule.count() == 0 {
            return Err(Error::new(Kind::Nothing, "the time to show is 0 s, so there are no pictures")
                .with_help("set --time or --frames"));
        }
        Ok(schedule)
    }

    /// Checks the output before any long work.
    fn check_outputs(&self, scene: &Scene, target: &Target, schedule: &FrameSchedule) -> Result<()> {
        let inputs = [self.scene.inputs(), self.render.inputs(scene), self.state.inputs().collect()].concat();
        outputs::check(&inputs, self.state.outputs())?;
        let pattern = match target {
            Target::Sequence(pattern) => pattern,
            Target::File(path, _) if self.part.is_some() => {
                let message =
                    format!("--part divides numbered pictures, and `{}` is one file", path.display());
                return Err(Error::new(Kind::Usage, message).with_help("write to frames/%04d.png"));
            }
            Target::File(path, _) => return outputs::check(&inputs, [(path.as_path(), Content::Binary)]),
        };
        if !pattern.folder().as_os_str().is_empty() && !pattern.folder().exists() {
            // The folder is created, but its parent is not.
            return outputs::check(&inputs, [(pattern.folder(), Content::Binary)]);
        }
        let clashes = inputs.iter().filter_map(|path| pattern.number(path));
        let numbers = [0].into_iter().chain(clashes.filter(|number| (1..schedule.count()).contains(number)));
        let pictures: Vec<PathBuf> = numbers.map(|number| pattern.path(number)).collect();
        outputs::check(&inputs, pictures.iter().map(|path| (path.as_path(), Content::Binary)))
    }

    fn finish(
        &self,
        target: &Target,
        playback: Playback,
        [pictures, kept]: [u64; 2],
        session: &Session,
    ) -> Result<()> {
        let Playback { width, height, fps, .. } = playback;
        let out = match target {
            Target::File(path, _) => path,
            Target::Sequence(_) => &self.out,
        };
        let out = out.display().to_string();
        #[expect(clippy::cast_precision_loss, reason = "for people")]
        let seconds = pictures as f64 / f64::from(fps);
        let old = if kept > 0 { format!(", {kept} of them from an earlier run") } else { String::new() };
        let line =
            format!("{out}: {pictures} pictures{old}, {width} x {height}, {fps} per second, {seconds} s");
        session.report(&Summary { out, width, height, fps, pictures, kept, seconds }, &line)
    }
}
