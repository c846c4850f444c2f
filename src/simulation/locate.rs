//! Where a frame went wrong: found by making its steps once more and looking after each.

use super::state::State;
use crate::cloth::grid::Grid;
use crate::cloth::guard::{RANGE, first_lost};
use crate::cloth::ledger::Recorder;
use crate::cloth::measure::{fastest_point, longest_spring};
use crate::error::{Error, Kind, Result};

/// The error of a frame that began at `state`, after `steps` steps, and failed.
pub(super) fn error(mut state: State, steps: u64, steps_per_frame: u64, guarded: bool) -> Error {
    let last_good = steps / steps_per_frame;
    match first_bad_step(&mut state, steps_per_frame, guarded) {
        Ok(step) => {
            let message = format!(
                "unstable: {} at step {}{}; last good frame: {last_good}",
                state.what_broke(),
                steps + step,
                state.suspects(),
            );
            let help = if first_lost(&state.x).is_some() {
                "raise sim.steps_per_frame, lower cloth.ks or raise cloth.density"
            } else {
                "raise sim.steps_per_frame, lower cloth.ks or raise cloth.density; --allow-unstable runs on"
            };
            Error::new(Kind::Unstable, message).with_help(help)
        }
        Err(error) => error,
    }
}

/// Moves `state` on to the first step that breaks a check, at most `steps`; its number from 1.
fn first_bad_step(state: &mut State, steps: u64, guarded: bool) -> Result<u64> {
    if state.recorder.is_none() {
        state.recorder = Some(Recorder::new(state.x.len(), false)?);
    }
    for step in 1..steps {
        state.step(&mut Default::default(), &mut Default::default());
        if !state.is_sound(guarded) {
            return Ok(step);
        }
    }
    state.step(&mut Default::default(), &mut Default::default());
    Ok(steps)
}

impl State {
    /// What the checks found.
    fn what_broke(&self) -> String {
        if let Some(point) = first_lost(&self.x) {
            return format!("{} is lost (no number, or beyond {RANGE:e} m)", name(point, self.grid));
        }
        let energy = self.watched_energy();
        let fastest = fastest_point(&self.x, &self.last).map_or(0, |(point, _)| point);
        let point = name(fastest, self.grid);
        let what = if energy.spring > 0.0 { "motion, height and springs" } else { "motion and height" };
        match &self.recorder {
            Some(Recorder { ledger, judged: true, .. }) if !self.budget.is_broken(energy) => format!(
                "springs and gravity have put in {:.4e} J, more than the {:.4e} J that they can, fastest is {point},",
                ledger.gravity + ledger.springs,
                self.budget.exchange_limit(energy),
            ),
            _ => format!(
                "{what} hold {:.4e} J, more than the {:.4e} J that there can be, most in {point},",
                energy.total(),
                self.budget.limit(energy),
            ),
        }
    }

    /// The spring that is stretched most, and the phase that put in most energy since the frame began.
    fn suspects(&self) -> String {
        let mut text = String::new();
        if let Some(spring) = longest_spring(&self.x, &self.springs) {
            let [a, b] = spring.ends.map(|point| name(point, self.grid));
            text += &format!(
                "; longest: the {} spring between {a} and {b}, {:.4e} of its rest length",
                spring.kind.name(),
                spring.stretch
            );
        }
        let entries = self.recorder.as_ref().map(Recorder::since_frame_start);
        let finite = entries.into_iter().flatten().filter(|(_, energy)| energy.is_finite());
        if let Some((phase, energy)) = finite.max_by(|(_, a), (_, b)| a.total_cmp(b)) {
            text += &format!("; most energy came from {phase}, {energy:.4e} J since the frame began");
        }
        text
    }
}

fn name(point: usize, grid: Grid) -> String {
    let (i, j) = grid.column_row(point);
    format!("point ({i}, {j})")
}
