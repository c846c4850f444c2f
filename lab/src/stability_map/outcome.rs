//! One run and its outcome.

use drape::diagnostics::stability::is_always_stable;
use drape::error::{Kind, Result};
use drape::scene::Scene;
use drape::simulation::Simulation;

/// The outcome of a run, from good to worst.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Outcome {
    /// None of the others.
    Ok,
    /// A spring was stretched by more than twice what the stretch limit allows (the stretch bound).
    Stretch,
    /// The cloth held more energy than its forces can give it (the energy bound, `src/diagnostics/energy_bound.rs`).
    Energy,
    /// A position was not a number, or beyond 1e15 m.
    Lost,
}

impl Outcome {
    /// Every outcome, from good to worst.
    pub const ALL: [Self; 4] = [Self::Ok, Self::Stretch, Self::Energy, Self::Lost];

    /// Its name in tables and legends.
    pub fn name(self) -> &'static str {
        match self {
            Self::Ok => "ok",
            Self::Stretch => "stretch bound broken",
            Self::Energy => "energy bound broken",
            Self::Lost => "not a number",
        }
    }

    /// Whether the cloth gained energy from nothing.
    pub fn is_unstable(self) -> bool {
        self >= Self::Energy
    }
}

/// The result of a run.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Run {
    /// The worst that happened.
    pub outcome: Outcome,
    /// Frames that were complete before it became unstable, or all.
    pub frames: u64,
    /// Largest length of a spring over its rest length at the end of a frame.
    pub stretch: f64,
}

/// Runs `scene` for `frames` frames, or until it is unstable.
///
/// # Errors
/// As [`Simulation::new`]; being unstable is an outcome, not an error.
pub fn run(scene: &Scene, frames: u64) -> Result<Run> {
    let mut simulation = Simulation::new(scene)?;
    if may_hide(scene) {
        simulation.record_ledger()?;
    }
    let bound = scene.sim.stretch_limit.map_or(f64::INFINITY, |limit| 1.0 + 2.0 * limit);
    let mut run = Run { outcome: Outcome::Ok, frames: 0, stretch: 0.0 };
    while run.frames < frames {
        match simulation.advance_frame() {
            Err(error) if error.kind == Kind::Unstable => {
                run.outcome = if is_lost(&simulation) { Outcome::Lost } else { Outcome::Energy };
                return Ok(run);
            }
            other => other?,
        }
        run.frames += 1;
        run.stretch = run.stretch.max(simulation.extremes().stretch);
        if run.stretch > bound {
            run.outcome = Outcome::Stretch;
        }
    }
    Ok(run)
}

/// Whether a stretch limit may hide a blow-up, so that only the ledger shows it (docs/stability.md).
fn may_hide(scene: &Scene) -> bool {
    let may_blow_up = |cloth| !is_always_stable(cloth, &scene.sim);
    scene.sim.stretch_limit.is_some() && scene.cloth.as_ref().is_some_and(may_blow_up)
}

/// Whether a position is not a number, or beyond what a scene may hold.
fn is_lost(simulation: &Simulation) -> bool {
    let points = simulation.positions();
    let is_there = |value: &f64| value.abs() <= 1e15;
    ![&points.x, &points.y, &points.z].into_iter().all(|component| component.iter().all(is_there))
}
