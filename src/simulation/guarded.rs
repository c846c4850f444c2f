//! The checks of a frame, and the state that it began with.

use super::state::State;
use crate::cloth::energy::Energy;
use crate::cloth::guard::first_lost;
use crate::cloth::ledger::Recorder;

impl State {
    /// Takes the state as the start that the energy is held against.
    pub(super) fn set_budget(&mut self) {
        let energy = Energy::new(&self.x, &self.last, &self.springs, &self.constants);
        let depths = self.colliders.depths();
        self.budget = self.allowance.budget(&self.x, energy, &self.constants, depths);
    }

    /// Notes the state before a frame, for the search after a failure.
    pub(super) fn note_frame_start(&mut self) {
        let now = [&self.x, &self.last].into_iter().chain(self.scheme.memory());
        self.frame_start.iter_mut().zip(now).for_each(|(kept, now)| kept.copy_from(now));
        self.recorder.iter_mut().for_each(Recorder::begin_frame);
    }

    /// The state before the frame.
    pub(super) fn at_frame_start(&self) -> Self {
        let mut state = self.clone();
        let Self { x, last, scheme, .. } = &mut state;
        let then = [x, last].into_iter().chain(scheme.memory_mut());
        then.zip(&self.frame_start).for_each(|(then, kept)| then.copy_from(kept));
        state.recorder.iter_mut().for_each(Recorder::restart_frame);
        state
    }

    /// The energies that are held against the budget: without the springs' under Verlet's scheme.
    pub(super) fn watched_energy(&self) -> Energy {
        if self.scheme.is_verlet() {
            return Energy::without_springs(&self.x, &self.last, &self.constants);
        }
        Energy::new(&self.x, &self.last, &self.springs, &self.constants)
    }

    /// Whether all positions are in range and, if `guarded`, the energy is and the ledger, if one
    /// is kept.
    pub(super) fn is_sound(&self, guarded: bool) -> bool {
        first_lost(&self.x).is_none() && !(guarded && (self.has_too_much() || self.is_overdrawn()))
    }

    /// Whether motion and height are more than there can be.
    fn has_too_much(&self) -> bool {
        self.budget.is_broken(self.watched_energy())
    }

    /// Whether the ledger, if one is kept, shows that springs and gravity put in more than they can.
    fn is_overdrawn(&self) -> bool {
        let judged = self.recorder.as_ref().filter(|recorder| recorder.judged);
        judged.is_some_and(|recorder| self.budget.is_overdrawn(recorder.ledger, self.watched_energy()))
    }
}
