//! `drape simulate`: a scene without a picture.

use std::path::PathBuf;
use std::time::Duration;

use serde::Serialize;

use super::positions::PositionsArgs;
use crate::args::flag::seconds;
use crate::args::scene::{REST_TIME, SceneArgs, StabilityArgs, frame_at};
use crate::args::state::StateArgs;
use crate::run::advance::{Rest, Until, advance_until};
use crate::run::start::start;
use crate::session::Session;
use crate::session::files::atomic;
use crate::session::files::outputs;
use crate::session::files::target::Content;
use drape::cloth::{Counters, springs};
use drape::diagnostics::energy::Energy;
use drape::diagnostics::ledger::Ledger;
use drape::error::{Error, Kind, Result};
use drape::scene::Scene;
use drape::simulation::{Simulation, Timings};
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
    #[arg(long, value_name = "N")]
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
    #[arg(long, value_name = "FILE", conflicts_with = "bench")]
    csv: Option<PathBuf>,
    /// Add to the summary the energy that each phase added or removed; a step takes two to four times as long
    #[arg(long, conflicts_with_all = ["bench", "hash"])]
    ledger: bool,
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

/// The summary.
#[derive(Serialize)]
struct Summary {
    frames: u64,
    time: f64,
    points: usize,
    springs: usize,
    state_hash: String,
    counters: Counters,
    /// The energies at the end, in J.
    energy: Energy,
    /// The energy that each phase added over the run, in J, if a ledger was recorded.
    #[serde(skip_serializing_if = "Option::is_none")]
    ledger: Option<Ledger>,
    /// What the stretch limit left, if the scene has one.
    #[serde(skip_serializing_if = "Option::is_none")]
    stretch: Option<Stretch>,
    /// The figures of the rest, if it was asked for and reached.
    #[serde(skip_serializing_if = "Option::is_none")]
    rest: Option<Rest>,
    /// The state hash of each frame from 0, if asked for.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    hashes: Vec<String>,
}

/// What the stretch limit left at the end.
#[derive(Clone, Copy, Serialize)]
struct Stretch {
    /// Largest length of a spring over its rest length.
    largest: f64,
    /// The same at the limit.
    limit: f64,
    /// Springs that the limit shortened in each step of the last frame.
    shortened_per_step: f64,
}

impl Stretch {
    /// Of a scene with a stretch limit, which shortened so many springs in the last frame.
    fn of(simulation: &Simulation, scene: &Scene, limited: u64) -> Option<Self> {
        let limit = 1.0 + scene.needed_stretch_limit()?;
        #[expect(clippy::cast_precision_loss, reason = "a number of springs is far below 2^53")]
        let shortened_per_step = limited as f64 / f64::from(scene.sim.steps_per_frame);
        Some(Self { largest: simulation.largest_stretch(), limit, shortened_per_step })
    }

    /// Lines of the summary: nothing where the limit holds and has nothing to do.
    fn text(&self) -> String {
        let Self { largest, limit, shortened_per_step } = *self;
        let beyond = if largest > limit + 1e-3 {
            format!(
                "stretch      {:.1} % at most: the limit of {:.1} % did not hold; more sim.stretch_passes or steps do\n",
                100.0 * (largest - 1.0),
                100.0 * (limit - 1.0)
            )
        } else {
            String::new()
        };
        let carried = if shortened_per_step >= 1.0 {
            format!(
                "stretch      {shortened_per_step:.1} springs a step were at the limit at the end: there the sag is the \
                 limit's, not ks's\n"
            )
        } else {
            String::new()
        };
        beyond + &carried
    }
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
    let scene = args.scene.load(session)?;
    let until = args.until(&scene);
    args.check_outputs(session)?;
    let mut simulation = start(&scene, until.frames, args.stability.allow_unstable, session)?;
    if args.bench {
        simulation.record_timings();
    }
    let mut table = args.csv.is_some().then(Table::new);
    if table.is_some() || args.ledger {
        simulation.record_ledger()?;
    }
    args.state.restore(&mut simulation, &scene, until.frames)?;
    let mut saving = args.state.saving(&scene);
    let mut hashes = Vec::new();
    let (mut before, mut limited) = (0, 0);
    let ended = advance_until(&mut simulation, &scene, until, session, |now| {
        let all = now.counters().springs_limited;
        (limited, before) = (all - before, all);
        table.iter_mut().for_each(|table| table.row(now));
        args.positions.after_frame(&scene, now)?;
        saving.after_frame(now)?;
        args.take_hash(now, session, &mut hashes)
    });
    let ended = args.write_failed(table.as_ref(), ended)?;
    saving.finish(&simulation)?;
    args.positions.finish(&scene, &simulation)?;
    args.write_table(table.as_ref())?;
    let springs = scene.cloth.as_ref().map_or(0, |cloth| springs::counts(cloth).iter().sum());
    if args.bench {
        session.print_json(&bench(&simulation, springs, ended.elapsed))?;
    } else if !args.fills_stdout() && (!args.hash || session.ui.json) {
        let stretch = Stretch::of(&simulation, &scene, limited);
        let summary = summary(&simulation, springs, hashes, ended.rest, stretch);
        session.print(&summary, &summary.text())?;
    }
    ended.result()
}

impl Args {
    fn until(&self, scene: &Scene) -> Until {
        let time = self.time.or(self.until_rest.then_some(REST_TIME));
        Until { frames: self.frames.unwrap_or_else(|| frame_at(time, scene)), rest: self.until_rest }
    }

    fn check_outputs(&self, session: &Session) -> Result<()> {
        outputs::check_stdout(self.fills_stdout(), self.hash || self.bench || session.ui.json)?;
        let positions = self.positions.output()?;
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

fn summary(
    simulation: &Simulation,
    springs: usize,
    hashes: Vec<String>,
    rest: Option<Rest>,
    stretch: Option<Stretch>,
) -> Summary {
    Summary {
        frames: simulation.frame(),
        time: simulation.time(),
        points: simulation.positions().len(),
        springs,
        state_hash: hex(simulation.state_hash()),
        counters: simulation.counters(),
        energy: simulation.energy(),
        ledger: simulation.ledger(),
        stretch,
        rest,
        hashes,
    }
}

impl Summary {
    fn text(&self) -> String {
        let Self { frames, time, points, springs, state_hash, counters, energy, .. } = self;
        let Energy { kinetic, spring, gravitational } = energy;
        let entries = self.ledger.map(Ledger::entries).into_iter().flatten();
        let ledger: String =
            entries.map(|(name, joule)| format!("  by {name:15} {joule:+.6e} J\n")).collect();
        let stretch = self.stretch.map_or_else(String::new, |stretch| stretch.text());
        let rest = self.rest.map_or_else(String::new, |rest| rest.text());
        format!(
            "frames       {frames}\nsteps        {}\ntime         {time} s\npoints       {points}\n\
             springs      {springs}\ncollisions   {} with objects, {} of the cloth with itself\n\
             shortened    {} springs\nenergy       {:.6e} J = kinetic {kinetic:.6e}, spring {spring:.6e}, \
             gravitational {gravitational:.6e}\n{ledger}{stretch}{rest}state hash   {state_hash}\n",
            counters.steps,
            counters.object_moves,
            counters.self_collision_moves,
            counters.springs_limited,
            energy.total(),
        )
    }
}

fn bench(simulation: &Simulation, springs: usize, elapsed: Duration) -> Bench {
    let substeps = simulation.steps();
    Bench {
        #[expect(clippy::cast_precision_loss, reason = "a number of steps is far below 2^53")]
        ns_per_substep: elapsed.as_secs_f64() * 1e9 / substeps.max(1) as f64,
        substeps,
        points: simulation.positions().len(),
        springs,
        threads: rayon::current_num_threads(),
        stages: simulation.timings().unwrap_or_default(),
    }
}

fn hex(hash: u64) -> String {
    format!("{hash:016x}")
}
