//! The checks of a frame, and the state that it began with.

use super::state::State;
use crate::cloth::energy::Energy;
use crate::cloth::guard::first_lost;

impl State {
    /// Takes the state as the start that the energy is held against.
    pub(super) fn set_budget(&mut self) {
        let energy = Energy::new(&self.x, &self.last, &self.springs, &self.constants);
        self.budget = self.allowance.budget(&self.x, energy, &self.constants);
    }

    /// Notes the state before a frame, for the search after a failure.
    pub(super) fn note_frame_start(&mut self) {
        let now = [&self.x, &self.last].into_iter().chain(self.scheme.memory());
        self.frame_start.iter_mut().zip(now).for_each(|(kept, now)| kept.copy_from(now));
    }

    /// The state before the frame.
    pub(super) fn at_frame_start(&self) -> Self {
        let mut state = self.clone();
        let Self { x, last, scheme, .. } = &mut state;
        let then = [x, last].into_iter().chain(scheme.memory_mut());
        then.zip(&self.frame_start).for_each(|(then, kept)| then.copy_from(kept));
        state
    }

    /// The energies that are held against the budget: without the springs' under Verlet's scheme.
    pub(super) fn watched_energy(&self) -> Energy {
        if self.scheme.is_verlet() {
            return Energy::without_springs(&self.x, &self.last, &self.constants);
        }
        Energy::new(&self.x, &self.last, &self.springs, &self.constants)
    }

    /// Whether all positions are in range and, if `guarded`, the energy is.
    pub(super) fn is_sound(&self, guarded: bool) -> bool {
        first_lost(&self.x).is_none() && !(guarded && self.budget.is_broken(self.watched_energy()))
    }
}
