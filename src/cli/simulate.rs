//! `drape simulate`: runs a scene without drawing it.

use std::path::PathBuf;
use std::time::Duration;

use serde::Serialize;

use super::advance::{advance, start};
use super::scene::{Leniency, SceneArgs, frame_at, seconds};
use super::{Session, counts, outputs};
use crate::cloth::Counters;
use crate::error::Result;
use crate::output::atomic::{self, Content};
use crate::output::raw;
use crate::simulation::{Simulation, Timings};

/// What `simulate` takes.
#[derive(clap::Args)]
pub(super) struct Args {
    #[command(flatten)]
    scene: SceneArgs,
    /// Simulated time in seconds, rounded to a frame (default: the scene's render.time)
    #[arg(long, value_name = "S", value_parser = seconds, conflicts_with = "frames")]
    time: Option<f64>,
    /// Number of frames
    #[arg(long, value_name = "N")]
    frames: Option<u64>,
    /// Write the last positions: x y z of each point, row by row, f64 little-endian (`-` = standard output)
    #[arg(long, value_name = "FILE")]
    positions: Option<PathBuf>,
    /// Print the number and the state hash of each frame instead of a summary
    #[arg(long)]
    hash: bool,
    /// Print the time per step instead of a summary, as JSON
    #[arg(long, conflicts_with = "hash")]
    bench: bool,
    #[command(flatten)]
    leniency: Leniency,
}

/// What was simulated.
#[derive(Serialize)]
struct Summary {
    frames: u64,
    time: f64,
    points: usize,
    springs: usize,
    state_hash: String,
    counters: Counters,
    /// The state hash of each frame from 0, if asked for.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    hashes: Vec<String>,
}

/// What the simulation took.
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
pub(super) fn run(args: &Args, session: &Session) -> Result<()> {
    let scene = args.scene.load(session)?;
    let frames = args.frames.unwrap_or_else(|| frame_at(args.time, &scene));
    let only_positions = outputs::takes_stdout(&[&args.positions]);
    outputs::check_stdout(only_positions, args.hash || args.bench || session.ui.json)?;
    outputs::check(
        &args.scene.inputs(),
        args.positions.iter().map(|path| (path.as_path(), Content::Binary)),
    )?;
    let mut simulation = start(&scene, frames, args.leniency.allow_unstable, session)?;
    if args.bench {
        simulation.record_timings();
    }
    let mut hashes = Vec::new();
    let elapsed = advance(&mut simulation, frames, session, |now| {
        if args.hash && session.ui.json {
            hashes.push(hex(now.state_hash()));
        } else if args.hash {
            atomic::write_stdout(format!("{} {}\n", now.frame(), hex(now.state_hash())).as_bytes())?;
        }
        Ok(())
    })?;
    if let Some(path) = &args.positions {
        let points = simulation.positions();
        atomic::write(path, &raw::points(&points.x, &points.y, &points.z))?;
    }
    let springs = scene.cloth.as_ref().map_or(0, |cloth| counts::springs(cloth).iter().sum());
    if args.bench {
        return session.print_json(&bench(&simulation, springs, elapsed));
    }
    if only_positions || (args.hash && !session.ui.json) {
        return Ok(());
    }
    let summary = summary(&simulation, springs, hashes);
    session.print(&summary, &summary.text())
}

fn summary(simulation: &Simulation, springs: usize, hashes: Vec<String>) -> Summary {
    Summary {
        frames: simulation.frame(),
        time: simulation.time(),
        points: simulation.positions().len(),
        springs,
        state_hash: hex(simulation.state_hash()),
        counters: simulation.counters(),
        hashes,
    }
}

impl Summary {
    fn text(&self) -> String {
        let Self { frames, time, points, springs, state_hash, counters, .. } = self;
        format!(
            "frames       {frames}\nsteps        {}\ntime         {time} s\npoints       {points}\n\
             springs      {springs}\ncollisions   {} with objects, {} of the cloth with itself\n\
             shortened    {} springs\nstate hash   {state_hash}\n",
            counters.steps, counters.object_moves, counters.self_collision_moves, counters.springs_limited,
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
