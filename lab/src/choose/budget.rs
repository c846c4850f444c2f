//! The most accurate settings that simulate to the moment within a given wall time.

use std::time::Duration;

use super::answer::{Answer, Choice};
use super::ladder::Ladder;
use super::level::{Level, Outcome, Runner, Settings};
use super::others::{self, Trial};
use super::{candidates, model};
use crate::accuracy::measure::Measure;
use crate::accuracy::source::Source;
use drape::error::{Error, Kind, Result};
use drape::scene::Integrator;
use rayon::prelude::*;

/// The part of the budget that is planned with: times of the same run differ.
const PLANNED: f64 = 0.9;

/// The most accurate settings whose simulation to frame `frames` takes at most `budget`, with their error in
/// `measure`. `watch` is as for [`super::within`].
///
/// # Errors
/// As [`super::within`].
pub fn within_budget(
    source: &Source,
    frames: u64,
    budget: Duration,
    measure: Measure,
    watch: &(dyn Fn() -> Result<()> + Sync),
) -> Result<Answer> {
    let scene = source.scene(&[])?;
    super::check_moment(frames)?;
    let runner = Runner::new(source, frames, measure, watch);
    let mut ladder = Ladder::start(&runner, &scene)?;
    let first = ladder.levels[0].clone();
    let steps = affordable(&first, budget);
    if steps < first.steps {
        return Ok(too_short(&runner, &ladder, budget));
    }
    // Levels up to the steps that the budget allows, or as many as the limit needs: three, or four where it is rough.
    let lowest = (steps / 8).max(first.steps);
    ladder.levels.clear();
    for level in [lowest, 2 * lowest, 4 * lowest, 8 * lowest] {
        ladder.push(&runner, level)?;
    }
    if ladder.levels.iter().all(|level| level.steps != steps) {
        let level = ladder.run(&runner, steps)?;
        ladder.tried.push(level);
    }
    let Some(limit) = ladder.limit.clone() else {
        return Err(Error::new(Kind::Internal, "four runs give no limit"));
    };
    let found: Vec<Trial> = others::integrators()
        .filter_map(|integrator| largest(&runner, integrator, &ladder, budget).transpose())
        .collect::<Result<_>>()?;
    let of_verlet =
        ladder.levels.iter().chain(&ladder.tried).map(|level| (ladder.settings(level.steps), level.clone()));
    let of_others = found.iter().filter_map(|trial| Some((trial.settings.clone(), trial.level()?.clone())));
    let mut in_time: Vec<(Settings, Level)> =
        of_verlet.chain(of_others).filter(|(_, level)| level.time <= budget).collect();
    let error = |level: &Level| ladder.error(level, &limit);
    in_time.sort_by(|(_, a), (_, b)| error(a).total_cmp(&error(b)).then(a.springs.cmp(&b.springs)));
    let Some((settings, level)) = in_time.first() else { return Ok(too_short(&runner, &ladder, budget)) };
    Ok(Answer {
        choice: Some(Choice::new(settings, level, [error(level), limit.uncertainty])),
        candidates: candidates(&ladder, Some(&limit), &found),
        springs_visited: runner.springs_visited(),
        horizon: None,
        model: model(&runner, &scene, &ladder, &limit)?,
        reason: None,
        measure,
    })
}

/// The steps a frame that take at most `budget`, if a step takes as long as one of `level`.
fn affordable(level: &Level, budget: Duration) -> u32 {
    let part = PLANNED * budget.as_secs_f64() / level.time.as_secs_f64().max(1e-9);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at least 0; saturates")]
    let steps = (f64::from(level.steps) * part) as u32;
    steps
}

/// The run of `integrator` with as many steps as the budget allows, if it allows its fewest.
fn largest(
    runner: &Runner<'_>,
    integrator: Integrator,
    ladder: &Ladder,
    budget: Duration,
) -> Result<Option<Trial>> {
    let mut settings = others::settings(integrator, &ladder.cures);
    settings.steps = runner.fewest(&settings)?;
    let Outcome::Done(first) = runner.run_for(&settings, budget)? else { return Ok(None) };
    let steps = affordable(&first, budget);
    if steps > settings.steps {
        settings.steps = steps;
        if let Outcome::Done(level) = runner.run_for(&settings, budget)? {
            return Ok(Some(Trial { settings, outcome: Outcome::Done(level) }));
        }
        return Ok(None);
    }
    Ok(Some(Trial { settings, outcome: Outcome::Done(first) }))
}

/// The answer where even the fewest steps take longer than the budget.
fn too_short(runner: &Runner<'_>, ladder: &Ladder, budget: Duration) -> Answer {
    let first = &ladder.levels[0];
    let reason = format!(
        "the fewest steps at which the cloth is stable, {} a frame, take {:.0} ms, and {:.0} ms are allowed",
        first.steps,
        first.time.as_secs_f64() * 1e3,
        budget.as_secs_f64() * 1e3
    );
    Answer {
        choice: None,
        candidates: candidates(ladder, None, &[]),
        springs_visited: runner.springs_visited(),
        horizon: None,
        model: Vec::new(),
        reason: Some(reason),
        measure: runner.measure,
    }
}
