//! Accuracy on demand: the cheapest integrator and steps per frame whose points are within a given distance of the
//! limit of ever smaller steps, at the moment that a user draws, or the most accurate within a given time.
//!
//! The limit is that of the model that the scene asks for, contact, stretch limit and self-collision included, with the
//! settings that have no limit replaced by those that have ([`ladder`](self)): damping per step is damping per
//! second, whose difference is told apart. A ladder of runs under Verlet's scheme finds it; the error of every candidate is its
//! distance from there, so it needs no order of convergence of its own.
//! `docs/choose.md` has what an estimate is worth.

pub mod goal;
mod estimate;
mod level;
mod ladder;
mod others;
mod answer;
mod reason;
mod budget;
mod own_error;

use crate::accuracy::measure::Measure;
use crate::accuracy::source::Source;
use crate::horizon::{Horizon, Parting};
use drape::error::{Error, Kind, Result};
use drape::scene::{Integrator, Scene};
use estimate::Limit;
use goal::Tolerance;
use ladder::Ladder;
use level::{Level, Outcome, Runner};
use others::{Search, Trial};

pub use answer::{Answer, Candidate, Choice, Model};
pub use budget::within_budget;
pub use own_error::{OwnError, own_error};

/// The cheapest settings within `tolerance` at frame `frames`. `watch` is called after each simulated frame, from several
/// threads, and can end the search with an error.
///
/// # Errors
/// Those of the scene, of the simulations and of `watch`; [`Kind::Nothing`] for a scene without a cloth, or for the start.
pub fn within(
    source: &Source,
    frames: u64,
    tolerance: Tolerance,
    watch: &(dyn Fn() -> Result<()> + Sync),
) -> Result<Answer> {
    let scene = source.scene(&[])?;
    check_moment(frames)?;
    let runner = Runner::new(source, frames, tolerance.measure, watch);
    let mut ladder = Ladder::climb(&runner, &scene, tolerance)?;
    let Some((verlet, limit)) = on_the_ladder(&runner, &mut ladder, tolerance)? else {
        return reason::none(&runner, &scene, &ladder, tolerance);
    };
    let search = Search { runner: &runner, ladder: &ladder, limit: &limit, tolerance };
    let found = search.trials(verlet.springs)?;
    let mut best = (ladder.settings(verlet.steps), verlet);
    for trial in &found {
        let within = trial.level().filter(|level| search.is_within(level));
        if let Some(level) = within.filter(|level| level.springs < best.1.springs) {
            best = (trial.settings.clone(), level.clone());
        }
    }
    let horizon = match ladder.is_told(&limit, tolerance) {
        true => None,
        false => Some(runner.horizon(&ladder.settings(ladder.levels[0].steps))?),
    };
    let is_beyond = |horizon: &Horizon| is_beyond(&horizon.partings, tolerance);
    if horizon.as_ref().is_some_and(is_beyond) {
        return reason::none(&runner, &scene, &ladder, tolerance);
    }
    let (settings, level) = best;
    let springs_visited = runner.springs_visited();
    Ok(Answer {
        choice: Some(Choice::new(&settings, &level, [ladder.error(&level, &limit), limit.uncertainty])),
        candidates: candidates(&ladder, Some(&limit), &found),
        springs_visited,
        horizon: horizon.and_then(|horizon| horizon.reached(tolerance.measure, tolerance.value)),
        model: model(&runner, &scene, &ladder, &limit)?,
        reason: None,
        measure: tolerance.measure,
    })
}

/// Whether copies that differ by rounding are farther apart at the moment than is allowed.
fn is_beyond(partings: &[Parting], Tolerance { value, measure }: Tolerance) -> bool {
    let apart = |last: &Parting| if measure == Measure::Rms { last.rms } else { last.largest(measure) };
    partings.last().is_some_and(|last| apart(last) > value)
}

fn check_moment(frames: u64) -> Result<()> {
    if frames > 0 {
        return Ok(());
    }
    Err(Error::new(Kind::Nothing, "at the start every step gives the same answer")
        .with_help("name a later moment with --time or --frame"))
}

/// The level with the largest step that is within `tolerance`, and the limit; `None` if there is no limit. A number
/// of steps that the ladder only predicts is run and looked at; if it is not within, the ladder goes on.
fn on_the_ladder(
    runner: &Runner<'_>,
    ladder: &mut Ladder,
    tolerance: Tolerance,
) -> Result<Option<(Level, Limit)>> {
    while let Some((steps, limit)) = ladder.enough(tolerance).zip(ladder.limit.clone()) {
        let known = ladder.levels.iter().find(|level| level.steps == steps).cloned();
        let is_new = known.is_none();
        let level = known.map_or_else(|| ladder.run(runner, steps), Ok)?;
        let within = ladder.worst(&level, &limit) <= tolerance.value;
        if is_new {
            ladder.tried.push(level.clone());
        }
        if within {
            return Ok(Some((level, limit)));
        }
        ladder.climb_on(runner, tolerance)?;
    }
    Ok(None)
}

/// Everything that was run.
fn candidates(ladder: &Ladder, limit: Option<&Limit>, found: &[Trial]) -> Vec<Candidate> {
    let done = |mut candidate: Candidate, level: &Level| {
        candidate.error = limit.map(|limit| ladder.error(level, limit));
        candidate.uncertainty = limit.map(|limit| limit.uncertainty);
        candidate.ms = Some(level.time.as_secs_f64() * 1e3);
        candidate
    };
    let mut levels: Vec<&Level> = ladder.levels.iter().chain(&ladder.tried).collect();
    levels.sort_by_key(|level| level.steps);
    let of_ladder = levels
        .into_iter()
        .map(|level| done(Candidate::of(Integrator::Verlet, level.steps, level.springs), level));
    let of_others = found.iter().map(|Trial { settings, outcome }| {
        let of = |springs| Candidate::of(settings.integrator, settings.steps, springs);
        match outcome {
            Outcome::Done(level) => done(of(level.springs), level),
            Outcome::Unstable => Candidate { ended: Some("unstable"), ..of(0) },
            Outcome::TooDear(springs) => {
                Candidate { ended: Some("given up, as it visits more springs"), ..of(*springs) }
            }
            Outcome::Hopeless => {
                Candidate { ended: Some("not run, as verlet is far off with no fewer steps"), ..of(0) }
            }
        }
    });
    of_ladder.chain(of_others).collect()
}

/// How far the scene as it is written is from the limit, and what damping per step makes of that.
fn model(runner: &Runner<'_>, scene: &Scene, ladder: &Ladder, limit: &Limit) -> Result<Vec<Model>> {
    let mut model = Vec::new();
    if let Outcome::Done(level) = runner.run_as_written(scene)? {
        model.push(Model { what: "the scene as it is written, off by", error: ladder.error(&level, limit) });
    }
    let mut settings = ladder.settings(ladder.levels[0].steps);
    let same = own_error::same_damping(scene).filter(|sets| settings.sets.contains(&sets[0]));
    if let Some(sets) = same.filter(|_| !own_error::is_at_the_report_s_rate(scene)) {
        settings.sets.extend(sets);
        if let Outcome::Done(level) = runner.run(&settings)? {
            let what = "damping per step takes another part of the motion in a second, which no step cures, and moves the points by";
            model.push(Model { what, error: limit.measure.distance(&level.shape, &ladder.levels[0].shape) });
        }
    }
    Ok(model)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_counts_is_how_far_copies_are_apart_at_the_moment() {
        let parting = |rms: f64| Parting { time: 0.1, rms, max: 10.0 * rms, pixels: Some(1000.0 * rms) };
        let beyond = |rms: &[f64], measure: Measure| {
            let partings: Vec<Parting> = rms.iter().map(|&rms| parting(rms)).collect();
            is_beyond(&partings, Tolerance { value: 1e-3, measure })
        };
        assert!(beyond(&[1e-9, 2e-3], Measure::Rms) && !beyond(&[2e-3, 1e-9], Measure::Rms));
        assert!(beyond(&[2e-4], Measure::Max) && !beyond(&[2e-4], Measure::Rms));
        assert!(beyond(&[2e-6], Measure::Pixels) && !beyond(&[2e-6], Measure::Max));
        assert!(!beyond(&[], Measure::Max));
    }
}
