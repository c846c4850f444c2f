//! `drape simulate`: a scene without a picture.

use std::path::PathBuf;
use std::time::Duration;

use serde::Serialize;

use super::positions::PositionsArgs;
use crate::args::flag::seconds;
use crate::args::frames::frame;
use crate::args::output::output;
use crate::args::scene::{REST_TIME, SceneArgs, StabilityArgs, frame_at};
use crate::args::state::StateArgs;
use crate::run::advance::{Until, advance_until};
use crate::run::start::start;
use crate::run::summary::{Seen, Summary, hex, springs_of};
use crate::session::Session;
use crate::session::files::atomic;
use crate::session::files::outputs;
use crate::session::files::target::Content;
use crate::session::ui::Ui;
use drape::error::{Error, Kind, Result};
use drape::scene::{SEEN, Scene};
use drape::simulation::{Simulation, Timings};
use drape_lab::accuracy::source::Source;
use drape_lab::choose::{OwnError, own_error};
use drape_lab::run::table::Table;

/// The arguments of `simulate`.
#[derive(clap::Args)]
pub(crate) struct Args {
    #[command(flatten)]
    scene: SceneArgs,
    /// Simulated time in seconds, rounded to the nearest frame (default: the scene's render.time)
    #[arg(long, value_name = "S", value_parser = seconds, conflicts_with = "frames")]
    time: Option<f64>,
    /// Number of frames to simulate, instead of --time
    #[arg(long, value_name = "N", value_parser = frame)]
    frames: Option<u64>,
    /// Simulate until the cloth is at rest, at most until --time or --frames (default: 60 s). If it is not at rest
    /// by then, the results are written and the exit code is 1
    #[arg(long)]
    until_rest: bool,
    #[command(flatten)]
    positions: PositionsArgs,
    /// Write a CSV table to this file, a row for each frame: time, energies, the energy that each phase added or
    /// removed, largest stretch, smallest distance, largest speed (`-` for standard output). A run that blows up or
    /// does not come to rest leaves the rows up to its last good frame
    #[arg(long, value_name = "FILE", value_parser = output(), conflicts_with = "bench")]
    csv: Option<PathBuf>,
    /// Add to the summary the energy that each phase added or removed; a step takes two to four times as long
    #[arg(long, conflicts_with_all = ["bench", "hash"])]
    ledger: bool,
    /// Add to the summary how wrong the positions are, estimated from one more run with twice the steps; with --from-state
    /// too that run is one from the start
    #[arg(long, conflicts_with_all = ["bench", "hash", "allow_unstable"])]
    error: bool,
    /// Print the number and the state hash of each frame instead of the summary
    #[arg(long)]
    hash: bool,
    /// Print the time per step as JSON instead of the summary
    #[arg(long, conflicts_with_all = ["hash", "from_state"])]
    bench: bool,
    #[command(flatten)]
    state: StateArgs,
    #[command(flatten)]
    stability: StabilityArgs,
}

/// The times of the simulation.
#[derive(Serialize)]
struct Bench {
    ns_per_substep: f64,
    substeps: u64,
    points: usize,
    springs: usize,
    threads: usize,
    stages: Timings,
}

/// Simulates, writes the positions, prints the result.
pub(crate) fn run(args: &Args, session: &Session) -> Result<()> {
    let loaded = args.scene.load_with_flags(&[], session)?;
    let scene = &loaded.scene;
    args.caution(&session.ui);
    let until = args.until(scene);
    let said = args.positions.provenance(&loaded)?;
    let said = said.as_ref();
    args.check_outputs(session)?;
    let mut simulation = start(scene, until.frames, args.stability.allow_unstable, session)?;
    if args.bench {
        simulation.record_timings();
    }
    let mut table = args.csv.is_some().then(Table::new);
    if table.is_some() || args.ledger {
        simulation.record_ledger()?;
    }
    let heights = simulation.positions().y.clone();
    let seen = args.state.restore(&mut simulation, scene, until.frames)?;
    let until = Until { seen, ..until };
    let mut saving = args.state.saving(scene);
    let mut hashes = Vec::new();
    let ended = advance_until(&mut simulation, scene, until, session, |now, seen| {
        table.iter_mut().for_each(|table| table.row(now));
        args.positions.after_frame(scene, said, now)?;
        saving.after_frame(now, seen)?;
        args.take_hash(now, session, &mut hashes)
    });
    let ended = args.write_failed(table.as_ref(), ended)?;
    saving.finish(&simulation, ended.seen)?;
    args.positions.finish(scene, said, &simulation, &session.ui)?;
    args.write_table(table.as_ref())?;
    if args.bench {
        session.print_json(&bench(&simulation, scene, ended.elapsed))?;
    } else if !args.fills_stdout() && (!args.hash || session.ui.json) {
        let error = args.error(scene, &simulation, session)?;
        let limited = ended.seen.springs_limited;
        let seen = Seen { rest: ended.rest, hashes, heights, limited, error };
        let summary = Summary::new(&simulation, scene, seen);
        session.print(&summary, &summary.text())?;
    }
    ended.result()
}

impl Args {
    /// Warns of options that change nothing.
    fn caution(&self, ui: &Ui) {
        let moments = [
            ("--time", self.time.is_some()),
            ("--frames", self.frames.is_some()),
            ("--until-rest", self.until_rest),
        ];
        self.scene.caution_of_moment(&moments, ui);
        self.scene.caution(&SEEN, "`simulate` draws nothing", ui);
        if self.ledger && self.fills_stdout() {
            ui.caution(
                "--ledger has no effect: there is no summary where standard output has other results",
                "--csv has the energies of every frame",
            );
        }
        self.positions.caution(ui);
    }

    fn until(&self, scene: &Scene) -> Until {
        let time = self.time.or(self.until_rest.then_some(REST_TIME));
        let frames = self.frames.unwrap_or_else(|| frame_at(time, scene));
        Until { frames, rest: self.until_rest, watched: !self.bench, ..Until::default() }
    }

    /// How wrong the positions are, if that was asked for.
    fn error(&self, scene: &Scene, now: &Simulation, session: &Session) -> Result<Option<OwnError>> {
        if !self.error {
            return Ok(None);
        }
        let source = Source { path: self.scene.path.clone(), overrides: self.scene.overrides() };
        own_error(&source, scene, now, &|| session.stop.check()).map(Some)
    }

    fn check_outputs(&self, session: &Session) -> Result<()> {
        let prints = self.hash || self.bench || self.error || session.ui.json;
        outputs::check_stdout(self.fills_stdout(), prints)?;
        let positions = self.positions.outputs()?;
        let positions = positions.iter().map(|(path, content)| (path.as_path(), *content));
        let csv = self.csv.iter().map(|path| (path.as_path(), Content::Text));
        let inputs: Vec<PathBuf> = self.scene.inputs().into_iter().chain(self.state.inputs()).collect();
        outputs::check(&inputs, positions.chain(csv).chain(self.state.outputs()))
    }

    fn fills_stdout(&self) -> bool {
        outputs::takes_stdout(&[&self.positions.positions, &self.csv])
    }

    /// Prints the hash of a frame, or stores it if all are printed as one JSON object.
    fn take_hash(&self, now: &Simulation, session: &Session, hashes: &mut Vec<String>) -> Result<()> {
        if !self.hash {
            return Ok(());
        }
        let hash = hex(now.state_hash());
        if session.ui.json {
            hashes.push(hash);
            return Ok(());
        }
        session.print_text(format!("{} {hash}\n", now.frame()))
    }

    fn write_table(&self, table: Option<&Table>) -> Result<()> {
        let pair = self.csv.as_ref().zip(table);
        pair.map_or(Ok(()), |(path, table)| atomic::write(path, table.text().as_bytes()))
    }

    /// Passes on the end of a run; writes the table of a run that blew up.
    fn write_failed<T>(&self, table: Option<&Table>, ended: Result<T>) -> Result<T> {
        if let Err(Error { kind: Kind::Unstable, .. }) = ended {
            // If this fails too, the error of the run says more.
            let _ = self.write_table(table);
        }
        ended
    }
}

fn bench(simulation: &Simulation, scene: &Scene, elapsed: Duration) -> Bench {
    let substeps = simulation.steps();
    Bench {
        #[expect(clippy::cast_precision_loss, reason = "a number of steps is far below 2^53")]
        ns_per_substep: elapsed.as_secs_f64() * 1e9 / substeps.max(1) as f64,
        substeps,
        points: simulation.positions().len(),
        springs: springs_of(scene),
        threads: rayon::current_num_threads(),
        stages: simulation.timings().unwrap_or_default(),
    }
}
