//! The observers that a simulation keeps.

use super::ledger_recorder::LedgerRecorder;
use super::observer::Observer;
use super::phase::Phase;
use super::state::State;
use super::timing::Timing;
use crate::cloth::Counters;

/// The observers of a simulation: what is counted, and what is measured only when it is asked for.
#[derive(Clone, Debug, Default)]
pub(super) struct Observers {
    pub(super) counters: Counters,
    pub(super) timing: Option<Timing>,
    pub(super) ledger: Option<LedgerRecorder>,
}

impl Observer for Observers {
    fn sees_forces(&self) -> bool {
        self.counters.sees_forces() || self.timing.sees_forces() || self.ledger.sees_forces()
    }

    fn before_step(&mut self, cloth: &State) {
        self.counters.before_step(cloth);
        self.timing.before_step(cloth);
        self.ledger.before_step(cloth);
    }

    fn after(&mut self, phase: Phase, cloth: &State) {
        self.counters.after(phase, cloth);
        self.timing.after(phase, cloth);
        self.ledger.after(phase, cloth);
    }

    fn after_step(&mut self, cloth: &State) {
        self.counters.after_step(cloth);
        self.timing.after_step(cloth);
        self.ledger.after_step(cloth);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::load_text;

    /// An observer that does nothing.
    struct Nothing;

    impl Observer for Nothing {
        fn sees_forces(&self) -> bool {
            false
        }
    }

    /// An observer that counts its calls.
    #[derive(Default)]
    struct Calls {
        phases: Vec<Phase>,
        steps: [usize; 2],
    }

    impl Observer for Calls {
        fn sees_forces(&self) -> bool {
            true
        }

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
        let counters = Counters::default();
        let mut observers = Observers { counters, timing: Some(Timing::default()), ledger: Some(ledger) };
        for _ in 0..1500 {
            alone.step(&mut Nothing);
            watched.step(&mut observers);
        }
        assert!(alone.x == watched.x && alone.last == watched.last);
        let counters = observers.counters;
        assert!(counters.object_moves > 0 && counters.steps == 1500, "{counters:?}");
    }

    #[test]
    fn an_observer_is_called_once_a_phase() {
        let (mut calls, mut state) = (Some(Calls::default()), state());
        (0..2).for_each(|_| state.step(&mut calls));
        let calls = calls.unwrap();
        assert_eq!(calls.steps, [2, 2]);
        let (first, second) = calls.phases.split_at(calls.phases.len() / 2);
        assert_eq!(first, second);
        assert_eq!(first[..3], [Phase::Forces, Phase::Integration, Phase::SelfCollision]);
        assert!(first.iter().all(|phase| first.iter().filter(|other| *other == phase).count() == 1));
    }
}
