//! Where a frame went wrong: found by repeating its steps and checking after each.

use super::ledger_recorder::LedgerRecorder;
use super::state::State;
use crate::cloth::grid::Grid;
use crate::diagnostics::energy_bound::{RANGE, first_lost};
use crate::diagnostics::extremes::{fastest_point, longest_spring};
use crate::error::{Error, Kind, Result};

/// A frame that failed, to be repeated.
pub(super) struct Replay {
    /// The cloth, first as the frame began.
    pub(super) cloth: State,
    /// The ledger up to there, if the cloth is checked by it.
    pub(super) ledger: Option<LedgerRecorder>,
    /// Steps before the frame.
    pub(super) steps: u64,
    /// Steps of the frame.
    pub(super) steps_per_frame: u64,
    /// Whether the energy is checked.
    pub(super) guarded: bool,
}

impl Replay {
    /// The error of the frame.
    pub(super) fn error(mut self) -> Error {
        let last_good = self.steps / self.steps_per_frame;
        match self.run_to_first_bad_step() {
            Ok((step, recorder)) => {
                let message = format!(
                    "unstable: {} at step {}{}; last good frame: {last_good}",
                    self.what_broke(&recorder),
                    self.steps + step,
                    suspects(&self.cloth, &recorder),
                );
                let help = "raise sim.steps_per_frame, lower cloth.ks or raise cloth.density";
                let go_on = if self.cloth.is_in_range() { "; --allow-unstable runs on" } else { "" };
                Error::new(Kind::Unstable, message).with_help(format!("{help}{go_on}"))
            }
            Err(error) => error,
        }
    }

    /// Repeats the frame up to the first step that fails a check, or its last step: the number of that step
    /// from 1, and the ledger.
    fn run_to_first_bad_step(&mut self) -> Result<(u64, LedgerRecorder)> {
        let mut recorder = match &self.ledger {
            Some(recorder) => recorder.clone(),
            None => LedgerRecorder::new(self.cloth.x.len())?,
        };
        recorder.restart_frame();
        let mut step = 0;
        loop {
            self.cloth.step(&mut recorder);
            step += 1;
            if step == self.steps_per_frame || !self.is_sound(&recorder) {
                return Ok((step, recorder));
            }
        }
    }

    fn is_sound(&self, recorder: &LedgerRecorder) -> bool {
        let checked = self.ledger.as_ref().map(|_| recorder);
        self.cloth.is_in_range() && (!self.guarded || self.cloth.is_within_energy_bound(checked))
    }

    /// What the checks found.
    fn what_broke(&self, recorder: &LedgerRecorder) -> String {
        let State { x, last, grid, energy_bound, .. } = &self.cloth;
        if let Some(point) = first_lost(x) {
            return format!("{} is lost (no number, or beyond {RANGE:e} m)", name(point, *grid));
        }
        let energy = self.cloth.watched_energy();
        let point = name(fastest_point(x, last).map_or(0, |(point, _)| point), *grid);
        if self.ledger.is_some() && !energy_bound.is_exceeded(energy) {
            let ledger = recorder.ledger;
            return format!(
                "springs and gravity have put in {:.4e} J, more than the {:.4e} J that they can, fastest is {point},",
                energy_bound.put_in(ledger),
                energy_bound.exchange_limit(energy),
            );
        }
        let what = if energy.spring > 0.0 { "motion, height and springs" } else { "motion and height" };
        format!(
            "{what} hold {:.4e} J, more than the {:.4e} J that there can be, most in {point},",
            energy.total(),
            energy_bound.limit(energy),
        )
    }
}

/// The spring that is stretched most, and the phase that put in most energy since the frame began.
fn suspects(cloth: &State, recorder: &LedgerRecorder) -> String {
    let mut text = String::new();
    if let Some(spring) = longest_spring(&cloth.x, &cloth.springs) {
        let [a, b] = spring.ends.map(|point| name(point, cloth.grid));
        text += &format!(
            "; longest: the {} spring between {a} and {b}, {:.4e} of its rest length",
            spring.kind.name(),
            spring.stretch
        );
    }
    let finite = recorder.since_frame_start().filter(|(_, energy)| energy.is_finite());
    if let Some((phase, energy)) = finite.max_by(|(_, a), (_, b)| a.total_cmp(b)) {
        text += &format!("; most energy came from {phase}, {energy:.4e} J since the frame began");
    }
    text
}

fn name(point: usize, grid: Grid) -> String {
    let (i, j) = grid.column_row(point);
    format!("point ({i}, {j})")
}
