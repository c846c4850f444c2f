//! Trials: mistakes are run, and compared with the states of the other program.

use rayon::prelude::*;
use serde::Serialize;

use super::case::{Case, Ours};
use super::mistakes::Mistake;
use super::precision::Precision;
use super::watch::{Event, Run, Watch};
use drape::error::{Kind, Result};

/// The most states after the first clear difference that a mistake is compared with. Later ones are chaotic.
pub(super) const WINDOW: usize = 10;

/// A mistake that leaves less than this part of the difference does what the other program does.
pub(super) const EXPLAINS: f64 = 1e-3;

/// A mistake that was run.
#[derive(Serialize)]
pub struct Tried {
    /// Its name.
    pub mistake: String,
    /// The part of the difference that it leaves: 0 if it explains everything, 1 if nothing; the largest
    /// number of the type if the mistake is unstable.
    pub left: f64,
}

impl Tried {
    /// Whether the mistake explains the whole difference.
    pub(super) fn explains(&self) -> bool {
        self.left <= EXPLAINS
    }

    /// The result as a line of text.
    pub(super) fn line(&self) -> String {
        let Self { mistake, left } = self;
        if self.explains() {
            return format!("tried       explains the whole difference: {mistake}\n");
        }
        format!("tried       leaves {:.1} % of the difference: {mistake}\n", left * 100.0)
    }
}

/// Runs every mistake over some states from `k` on; the one that comes nearest to theirs is the first. `what`
/// names the mistakes for `watch`.
///
/// # Errors
/// Those of the simulations and of `watch`.
pub(super) fn run(
    what: &str,
    case: &Case<'_>,
    mistakes: &[Mistake],
    k: usize,
    precision: &Precision,
    watch: Watch<'_>,
) -> Result<Vec<Tried>> {
    let ahead = case.theirs[k..].iter().take(WINDOW);
    let finite = ahead.take_while(|state| state.as_flattened().iter().all(|x| x.is_finite()));
    let window = k..k + finite.count();
    let error = |ours: &[Ours]| case.distances(window.clone(), ours, precision).iter().sum::<f64>();
    let without = error(&case.ours[window.clone()]);
    let frames = case.frame(k) + window.len() as u64;
    watch(Event::Stage(
        format!("running {} {what}, frames", mistakes.len()),
        frames * mistakes.len() as u64,
    ))?;
    let tried = mistakes.par_iter().map(|mistake| {
        let run = Run::new(watch, frames);
        let states = mistake.states(case.start.as_ref(), case.frame(k), window.len(), &|| run.frame());
        run.finish()?;
        let left = match states {
            // A mistake that is unstable is not the one that was made.
            Err(error) if error.kind == Kind::Unstable => f64::MAX,
            Err(error) => return Err(error),
            Ok(states) => error(&states) / without,
        };
        let left = if left.is_finite() { left } else { f64::MAX };
        Ok(Tried { mistake: mistake.name.clone(), left })
    });
    let mut tried = tried.collect::<Result<Vec<Tried>>>()?;
    tried.sort_by(|a, b| a.left.total_cmp(&b.left));
    Ok(tried)
}
