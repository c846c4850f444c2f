//! What watches a step without taking part in it. The step is compiled for its observer, so one that
//! does nothing costs nothing.

use super::phase::Phase;
use super::state::State;
use crate::cloth::Counters;

/// What sees a cloth before a step, after each phase and after the step. What an observer leaves out does
/// nothing.
pub(super) trait Observer {
    /// Sees the cloth before a step.
    fn before_step(&mut self, _cloth: &State) {}

    /// Sees the cloth after a phase.
    fn after(&mut self, _phase: Phase, _cloth: &State) {}

    /// Sees the cloth after a step.
    fn after_step(&mut self, _cloth: &State) {}
}

/// Counters add up the work of the steps.
impl Observer for Counters {
    fn after_step(&mut self, cloth: &State) {
        *self += cloth.work;
    }
}

/// An observer that may be absent.
impl<O: Observer> Observer for Option<O> {
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

/// Several observers.
impl<A: Observer, B: Observer, C: Observer> Observer for (A, B, C) {
    fn before_step(&mut self, cloth: &State) {
        self.0.before_step(cloth);
        self.1.before_step(cloth);
        self.2.before_step(cloth);
    }

    fn after(&mut self, phase: Phase, cloth: &State) {
        self.0.after(phase, cloth);
        self.1.after(phase, cloth);
        self.2.after(phase, cloth);
    }

    fn after_step(&mut self, cloth: &State) {
        self.0.after_step(cloth);
        self.1.after_step(cloth);
        self.2.after_step(cloth);
    }
}

#[cfg(test)]
mod tests {
    use super::super::ledger_recorder::LedgerRecorder;
    use super::super::timing::Timing;
    use super::*;
    use crate::scene::load_text;

    /// An observer that does nothing.
    struct Nothing;

    impl Observer for Nothing {}

    /// An observer that counts its calls.
    #[derive(Default)]
    struct Calls {
        phases: Vec<Phase>,
        steps: [usize; 2],
    }

    impl Observer for Calls {
        fn before_step(&mut self, _cloth: &State) {
            self.steps[0] += 1;
        }

        fn after(&mut self, phase: Phase, _cloth: &State) {
            self.phases.push(phase);
        }

        fn after_step(&mut self, _cloth: &State) {
            self.steps[1] += 1;
        }
    }

    fn state() -> State {
        let scene = load_text("a.json", include_str!("../../scenes/sphere.json"), &Default::default());
        State::new(&scene.unwrap().scene, None).unwrap().unwrap()
    }

    #[test]
    fn a_step_has_the_same_bits_whoever_watches() {
        let [mut alone, mut watched] = [state(), state()];
        let ledger = LedgerRecorder::new(watched.x.len()).unwrap();
        let mut observers = (Counters::default(), Some(Timing::default()), Some(ledger));
        for _ in 0..1500 {
            alone.step(&mut Nothing);
            watched.step(&mut observers);
        }
        assert!(alone.x == watched.x && alone.last == watched.last);
        assert!(observers.0.object_moves > 0 && observers.0.steps == 1500, "{:?}", observers.0);
    }

    #[test]
    fn an_observer_is_called_once_a_phase() {
        let mut observers = (Calls::default(), None::<Calls>, Some(Calls::default()));
        let mut state = state();
        (0..2).for_each(|_| state.step(&mut observers));
        for calls in [&observers.0, observers.2.as_ref().unwrap()] {
            assert_eq!(calls.steps, [2, 2]);
            let (first, second) = calls.phases.split_at(calls.phases.len() / 2);
            assert_eq!(first, second);
            assert_eq!(first[..3], [Phase::Forces, Phase::Integration, Phase::SelfCollision]);
            assert!(first.iter().all(|phase| first.iter().filter(|other| *other == phase).count() == 1));
        }
    }
}
