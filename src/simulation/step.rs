//! One step of the method.

use super::observer::Observer;
use super::phase::Phase;
use super::state::State;
use crate::cloth::Counters;
use crate::scene::ColliderKind;

impl State {
    /// Makes a step. The phases after the integration change positions; only under `coulomb` do they change `last`.
    pub(super) fn step(&mut self, observer: &mut impl Observer) {
        self.work = Counters { steps: 1, ..Counters::default() };
        observer.before_step(self);

        // 1. Forces: the weight of every point and the pull of its springs.
        // 2. Integration: under the forces every free point moves on.
        if observer.sees_forces() {
            self.compute_forces();
            observer.after(Phase::Forces, self);
            self.integrate();
        } else {
            self.compute_forces_and_integrate();
        }
        observer.after(Phase::Integration, self);

        // 3. Self-collision: close points of the cloth move apart.
        self.collide_with_itself();
        observer.after(Phase::SelfCollision, self);

        // 4. Collision: points that hit an object during the step are put on its surface.
        for &kind in ColliderKind::ALL {
            self.collide(kind);
            observer.after(Phase::Collision(kind), self);
        }

        // 5. Stretch limit: springs that are too long are shortened.
        self.limit_stretch();
        observer.after(Phase::StretchLimit, self);

        // Where the scene asks for it: points that are still inside an object are put outside.
        for &kind in ColliderKind::ALL {
            self.depenetrate(kind);
            observer.after(Phase::Depenetration(kind), self);
        }

        // Under `coulomb`, instead of 4: the way of the step is swept against the objects; approach ends, slides
        // are braked.
        self.touch();
        observer.after(Phase::Contact, self);

        observer.after_step(self);
    }
}
