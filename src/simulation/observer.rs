//! What watches a step without taking part in it. The step is compiled for its observer, so one that
//! does nothing costs nothing.

use super::phase::Phase;
use super::state::State;
use crate::cloth::Counters;

/// What sees a cloth before a step, after each phase and after the step. What an observer leaves out does
/// nothing.
pub(super) trait Observer {
    /// Whether it sees the cloth between forces and integration, or what needs the force on each point. If none does,
    /// an integrator may do both phases at once.
    fn sees_forces(&self) -> bool;

    /// Sees the cloth before a step.
    fn before_step(&mut self, _cloth: &State) {}

    /// Sees the cloth after a phase.
    fn after(&mut self, _phase: Phase, _cloth: &State) {}

    /// Sees the cloth after a step.
    fn after_step(&mut self, _cloth: &State) {}
}

/// Counters add up the work of the steps.
impl Observer for Counters {
    fn sees_forces(&self) -> bool {
        false
    }

    fn after_step(&mut self, cloth: &State) {
        *self += cloth.work;
    }
}

/// An observer that may be absent.
impl<O: Observer> Observer for Option<O> {
    fn sees_forces(&self) -> bool {
        self.as_ref().is_some_and(O::sees_forces)
    }

    fn before_step(&mut self, cloth: &State) {
        if let Some(observer) = self {
            observer.before_step(cloth);
        }
    }

    fn after(&mut self, phase: Phase, cloth: &State) {
        if let Some(observer) = self {
            observer.after(phase, cloth);
        }
    }

    fn after_step(&mut self, cloth: &State) {
        if let Some(observer) = self {
            observer.after_step(cloth);
        }
    }
}
