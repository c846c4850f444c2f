//! Scenes with one value at the end of its range, or beyond: what is promised, and what happened.

use serde::Serialize;

use super::outcome::{Outcome, run};
use drape::diagnostics::stability::Stability;
use drape::error::Result;
use drape::scene::Scene;
use drape::simulation::Simulation;

/// Frames that each scene is run for.
pub(super) const FRAMES: u64 = 10;

/// What is promised of an extreme.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Promise {
    /// It runs, and no energy comes from nothing.
    Runs,
    /// It is refused before the first step.
    Refused,
}

/// An extreme of one parameter.
struct Extreme {
    what: &'static str,
    sets: &'static [&'static str],
    promise: Promise,
}

/// One row of the table.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Row {
    /// Which extreme.
    pub what: &'static str,
    /// The changes to the scene that make it.
    pub sets: &'static [&'static str],
    /// What is promised.
    pub promise: Promise,
    /// What happened, in words.
    pub happened: String,
    /// Whether the promise was kept.
    pub kept: bool,
}

/// Every extreme, tried on the scene that `load` gives with the changes of each; `done` is called
/// after each.
///
/// # Errors
/// Those of `done` and of [`Simulation::new`].
pub fn table(
    load: &dyn Fn(&[&str]) -> Result<Scene>,
    done: &mut dyn FnMut() -> Result<()>,
) -> Result<Vec<Row>> {
    let rows = EXTREMES.iter().map(|extreme| {
        let (fate, happened) = match load(extreme.sets) {
            Ok(scene) => try_out(&scene)?,
            Err(error) => (Some(Promise::Refused), format!("refused: {}", first_words(&error))),
        };
        done()?;
        let Extreme { what, sets, promise } = *extreme;
        Ok(Row { what, sets, promise, happened, kept: fate == Some(promise) })
    });
    rows.collect()
}

/// A summary of `rows`, in a sentence.
pub fn headline(rows: &[Row]) -> String {
    let kept = rows.iter().filter(|row| row.kept).count();
    format!(
        "{kept} of {} scenes with a value at the end of its range did what is promised: they ran, or were refused \
         before the first step",
        rows.len()
    )
}

/// How many rows the table has.
pub fn len() -> usize {
    EXTREMES.len()
}

/// The promise that `scene` keeps, `None` if it became unstable in motion, and what happened in words.
fn try_out(scene: &Scene) -> Result<(Option<Promise>, String)> {
    let Some(cloth) = &scene.cloth else { return Ok((Some(Promise::Runs), "nothing moves".into())) };
    let Stability { dt, omega_rest, limit, .. } = Stability::new(cloth, &scene.sim)?;
    if dt * omega_rest >= limit {
        let happened = format!("refused before step 0: dt·ω = {:.4} ≥ {limit:.4}", dt * omega_rest);
        return Ok((Some(Promise::Refused), happened));
    }
    if Simulation::new(scene)?.unresolved(FRAMES as f64 / scene.sim.fps).is_some() {
        return Ok((Some(Promise::Refused), "refused before step 0: gravity is lost in rounding".into()));
    }
    let run = run(scene, FRAMES)?;
    if run.outcome.is_unstable() {
        return Ok((None, format!("{} after {} frames", run.outcome.name(), run.frames)));
    }
    let beyond = if run.outcome == Outcome::Stretch { ", beyond the stretch limit" } else { "" };
    Ok((Some(Promise::Runs), format!("ran; longest spring {:.4} of its rest length{beyond}", run.stretch)))
}

/// The first message of a scene error.
fn first_words(error: &drape::error::Error) -> String {
    error.diagnostics.first().map_or_else(|| error.message.clone(), |diagnostic| diagnostic.message.clone())
}

const fn extreme(what: &'static str, sets: &'static [&'static str], promise: Promise) -> Extreme {
    Extreme { what, sets, promise }
}

/// The rows of the table. The limits are those of the scene format.
const EXTREMES: &[Extreme] = &[
    extreme("no stiffness", &["cloth.ks=0"], Promise::Runs),
    extreme("stiffness 1e12 N/m", &["cloth.ks=1e12"], Promise::Refused),
    extreme("density 1e-6 kg/m²", &["cloth.density=1e-6"], Promise::Refused),
    extreme("density 1e12 kg/m²", &["cloth.density=1e12"], Promise::Runs),
    extreme("no damping", &["cloth.damping=0"], Promise::Runs),
    extreme("damping 100 %", &["cloth.damping=100"], Promise::Runs),
    extreme("damping 101 %", &["cloth.damping=101"], Promise::Refused),
    extreme("negative damping", &["cloth.damping=-1"], Promise::Refused),
    extreme("no gravity", &["sim.gravity=[0,0,0]"], Promise::Runs),
    extreme("gravity 1e6 m/s²", &["sim.gravity=[0,-1e6,0]"], Promise::Runs),
    extreme("thickness 0", &["cloth.thickness=0"], Promise::Runs),
    extreme("thickness of five spacings", &["cloth.thickness=0.1"], Promise::Runs),
    extreme(
        "2 x 2 points",
        &["cloth.num_width_points=2", "cloth.num_height_points=2", "cloth.pinned=[[0,0]]"],
        Promise::Runs,
    ),
    extreme(
        "2000 x 2000 points at 30 steps",
        &["cloth.num_width_points=2000", "cloth.num_height_points=2000"],
        Promise::Refused,
    ),
    extreme("1 nm wide", &["cloth.width=1e-9", "cloth.height=1e-9"], Promise::Refused),
    // Lying flat: upright, gravity would be lost in the rounding of heights.
    extreme(
        "1e9 m wide",
        &["cloth.width=1e9", "cloth.height=1e9", "cloth.density=150", "cloth.orientation=0"],
        Promise::Runs,
    ),
    extreme("step of 1 ns", &["sim.fps=33333333"], Promise::Refused),
    extreme("step of 1 s", &["sim.fps=1", "sim.steps_per_frame=1"], Promise::Refused),
];
