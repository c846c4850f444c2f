//! The other integrators: whether one reaches the tolerance for less work than Verlet's scheme.

use super::estimate::Limit;
use super::goal::Tolerance;
use super::level::{Level, Outcome, Runner, Settings};
use drape::diagnostics::stability::Stability;
use drape::error::Result;
use drape::scene::Integrator;

/// A run of another integrator, and how it ended.
#[derive(Clone, Debug)]
pub(super) struct Trial {
    pub(super) settings: Settings,
    pub(super) outcome: Outcome,
}

/// Runs `integrator` at its fewest steps and, if that is not within `tolerance` of `limit`, at as many as half of
/// `work` springs allow, and, if the error found there could halve, at as many as all of it allow. Trials end
/// at the first that is within, or that visits more springs than it may. So an integrator that is within for
/// half of the work is never missed.
pub(super) fn trials(
    runner: &Runner<'_>,
    integrator: Integrator,
    cures: &[String],
    limit: &Limit,
    tolerance: Tolerance,
    work: u64,
) -> Result<Vec<Trial>> {
    let mut settings = settings(integrator, cures);
    settings.steps = fewest(runner, &settings)?;
    let mut trials: Vec<Trial> = Vec::new();
    for (most, hope) in [(work / 2, f64::INFINITY), (work / 2, f64::INFINITY), (work, 2.0 * tolerance.value)]
    {
        if let Some(Trial { outcome: Outcome::Done(level), .. }) = trials.last() {
            let error = tolerance.measure.distance(&level.shape, &limit.shape);
            let is_within = error + limit.uncertainty <= tolerance.value;
            let steps = affordable(level, most as f64);
            if is_within || error > hope || steps <= settings.steps {
                break;
            }
            settings.steps = steps;
        }
        let outcome = runner.run_at_most(&settings, most)?;
        let is_done = matches!(outcome, Outcome::Done(_));
        trials.push(Trial { settings: settings.clone(), outcome });
        if !is_done {
            break;
        }
    }
    Ok(trials)
}

/// The steps a frame that visit at most `work` springs, if a step costs as much as one of `level`.
fn affordable(level: &Level, work: f64) -> u32 {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at least 0; saturates")]
    let steps = (f64::from(level.steps) * work / level.springs.max(1) as f64).floor() as u32;
    steps
}

/// One step a frame of `integrator`, with those of the `cures` that it reads. The start is one of Verlet's scheme:
/// with the others a scene must leave it out or say `report`, so this undoes what the scene may say.
pub(super) fn settings(integrator: Integrator, cures: &[String]) -> Settings {
    let of_verlet = |cure: &&String| !cure.starts_with("sim.start=");
    let mut sets: Vec<String> = cures.iter().filter(of_verlet).cloned().collect();
    sets.push("sim.start=report".to_owned());
    Settings { integrator, steps: 1, sets }
}

/// The fewest steps a frame at which the integrator is stable in any shape of the cloth.
pub(super) fn fewest(runner: &Runner<'_>, settings: &Settings) -> Result<u32> {
    let scene = runner.source.scene(&settings.sets())?;
    let Some(cloth) = &scene.cloth else { return Ok(1) };
    let stability = Stability::of_bounded(cloth, &scene.sim)?;
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at least 1; saturates")]
    let fewest = stability.map_or(1.0, |stability| stability.fewest_steps_worst()).max(1.0) as u32;
    Ok(fewest)
}
