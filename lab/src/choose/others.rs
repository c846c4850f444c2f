//! The other integrators: whether one reaches the tolerance for less work than Verlet's scheme.

use rayon::prelude::*;

use super::estimate::Limit;
use super::goal::Tolerance;
use super::ladder::Ladder;
use super::level::{Level, Outcome, Runner, Settings};
use drape::error::Result;
use drape::scene::Integrator;

/// A run of another integrator, and how it ended.
#[derive(Clone, Debug)]
pub(super) struct Trial {
    pub(super) settings: Settings,
    pub(super) outcome: Outcome,
}

/// The integrators that are tried beside Verlet's scheme.
pub(super) fn integrators() -> impl ParallelIterator<Item = Integrator> {
    let names: Vec<Integrator> = Integrator::NAMES.iter().map(|row| row.1).collect();
    names.into_par_iter().filter(|integrator| *integrator != Integrator::Verlet)
}

/// What is looked for: a run within `tolerance` of `limit`, the limit of `ladder`.
pub(super) struct Search<'a> {
    pub(super) runner: &'a Runner<'a>,
    pub(super) ladder: &'a Ladder,
    pub(super) limit: &'a Limit,
    pub(super) tolerance: Tolerance,
}

impl Search<'_> {
    /// Runs each integrator at its fewest steps, and then at as many as half of the least work allows that is known to
    /// do: at first the `work` of Verlet's scheme. A run ends as soon as it is known to visit more, and one that cannot
    /// be within is not begun. So an integrator that is within for half of the work is not missed.
    pub(super) fn trials(&self, work: u64) -> Result<Vec<Trial>> {
        let at_fewest = |integrator| {
            let mut settings = settings(integrator, &self.ladder.cures);
            settings.steps = self.runner.fewest(&settings)?;
            self.trial(settings, work / 2)
        };
        let mut trials = integrators().map(at_fewest).collect::<Result<Vec<Trial>>>()?;
        let within = trials.iter().filter_map(Trial::level).filter(|level| self.is_within(level));
        let half = within.map(|level| level.springs).fold(work, u64::min) / 2;
        let with_more_steps = |trial: &Trial| {
            let level = trial.level().filter(|level| !self.is_within(level))?;
            let settings = Settings { steps: affordable(level, half), ..trial.settings.clone() };
            let hope = settings.steps > level.steps && self.can_be_within(level, &settings);
            hope.then(|| self.trial(settings, half))
        };
        let more = trials.par_iter().filter_map(with_more_steps).collect::<Result<Vec<Trial>>>()?;
        trials.extend(more);
        Ok(trials)
    }

    fn trial(&self, settings: Settings, most: u64) -> Result<Trial> {
        let outcome = if self.ladder.is_hopeless(settings.steps, self.limit, self.tolerance) {
            Outcome::Hopeless
        } else {
            self.runner.run_at_most(&settings, most)?
        };
        Ok(Trial { settings, outcome })
    }

    pub(super) fn is_within(&self, level: &Level) -> bool {
        self.ladder.worst(level, self.limit) <= self.tolerance.value
    }

    /// Whether a run with `settings` can be within where one with fewer steps came to `level`: if its error falls by one
    /// power of the step faster than the order of the integrator.
    fn can_be_within(&self, level: &Level, settings: &Settings) -> bool {
        let more = f64::from(settings.steps) / f64::from(level.steps);
        let fall = (0..=order(settings.integrator)).fold(1.0, |fall, _| fall * more);
        let error = self.ladder.error(level, self.limit) - self.limit.uncertainty;
        error <= fall * self.tolerance.value
    }
}

impl Trial {
    /// The run, if it was finished.
    pub(super) fn level(&self) -> Option<&Level> {
        match &self.outcome {
            Outcome::Done(level) => Some(level),
            _ => None,
        }
    }
}

/// The order of an integrator where nothing but springs acts.
fn order(integrator: Integrator) -> u32 {
    match integrator {
        Integrator::Xpbd | Integrator::ImplicitEuler => 1,
        Integrator::Verlet | Integrator::Bdf2 => 2,
        Integrator::Rk4 => 4,
    }
}

/// The steps a frame that visit at most `work` springs, if a step costs as much as one of `level`.
fn affordable(level: &Level, work: u64) -> u32 {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at least 0; saturates")]
    let steps = (f64::from(level.steps) * work as f64 / level.springs.max(1) as f64).floor() as u32;
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
