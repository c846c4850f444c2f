//! The checks after a frame, and the state that it began with.

use super::ledger_recorder::LedgerRecorder;
use super::state::State;
use crate::diagnostics::energy::Energy;
use crate::diagnostics::energy_bound::first_lost;

impl State {
    /// Notes the state before a frame, for the search after a failure.
    pub(super) fn note_frame_start(&mut self) {
        let now = [&self.x, &self.last].into_iter().chain(self.integrator.memory());
        self.frame_start.iter_mut().zip(now).for_each(|(kept, now)| kept.copy_from(now));
    }

    /// The state before the frame.
    pub(super) fn at_frame_start(&self) -> Self {
        let mut state = self.clone();
        let Self { x, last, integrator, .. } = &mut state;
        let then = [x, last].into_iter().chain(integrator.memory_mut());
        then.zip(&self.frame_start).for_each(|(then, kept)| then.copy_from(kept));
        state
    }

    /// The energies that are held against the bound.
    pub(super) fn watched_energy(&self) -> Energy {
        if self.integrator.bounds_spring_energy() {
            return self.energy();
        }
        Energy::without_springs(&self.x, &self.last, &self.params)
    }

    /// Whether all positions are in range.
    pub(super) fn is_in_range(&self) -> bool {
        first_lost(&self.x).is_none()
    }

    /// Whether the energy is within its bound, and what springs and gravity put in, if `ledger` recorded it.
    pub(super) fn is_within_energy_bound(&self, ledger: Option<&LedgerRecorder>) -> bool {
        let energy = self.watched_energy();
        let exchange = ledger.map(|recorder| recorder.ledger);
        !self.energy_bound.is_exceeded(energy)
            && !exchange.is_some_and(|ledger| self.energy_bound.is_exceeded_by_exchange(ledger, energy))
    }
}
