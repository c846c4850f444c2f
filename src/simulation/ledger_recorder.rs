//! The observer that enters what each phase does to the energies into a [`Ledger`].

use super::observer::Observer;
use super::phase::Phase;
use super::state::State;
use crate::cloth::{Params, Points};
use crate::collision::coulomb::Coulomb;
use crate::diagnostics::energy::{Energy, spring_energy};
use crate::diagnostics::ledger::Ledger;
use crate::error::Result;
use crate::math::dot;
use crate::scene::ColliderKind;

/// Records the ledger of a cloth while it moves.
#[derive(Clone, Debug)]
pub(super) struct LedgerRecorder {
    /// The entries since the start of the recording.
    pub(super) ledger: Ledger,
    /// The entries at the start of the frame.
    frame_start: Ledger,
    /// How each point moved in the step before, in metres.
    before: Points,
    /// Energy of the springs before the step, in J.
    spring: f64,
    /// Energy of weight before the step, in J.
    gravitational: f64,
    /// Total energy after the last phase, in J.
    total: f64,
    /// Of that, the energy of weight.
    height: f64,
}

impl LedgerRecorder {
    /// An empty ledger for a cloth of `points` points.
    ///
    /// # Errors
    /// [`crate::error::Kind::Scene`] when it does not fit in memory.
    pub(super) fn new(points: usize) -> Result<Self> {
        let (ledger, before) = (Ledger::default(), Points::zeros(points)?);
        Ok(Self {
            ledger,
            frame_start: ledger,
            before,
            spring: 0.0,
            gravitational: 0.0,
            total: 0.0,
            height: 0.0,
        })
    }

    /// Notes the entries at the start of a frame.
    pub(super) fn begin_frame(&mut self) {
        self.frame_start = self.ledger;
    }

    /// Takes the entries back to the start of the frame.
    pub(super) fn restart_frame(&mut self) {
        self.ledger = self.frame_start;
    }

    /// What each part put in since the frame began, by name.
    pub(super) fn since_frame_start(&self) -> impl Iterator<Item = (&'static str, f64)> {
        let pairs = self.ledger.entries().zip(self.frame_start.entries());
        pairs.map(|((name, now), (_, before))| (name, now - before))
    }

    /// Enters what the integrator did.
    fn record_integration(&mut self, cloth: &State) {
        let State { params, x, last, .. } = cloth;
        let Params { mass, dt, weight, .. } = *params;
        let inertia = mass / (2.0 * dt * dt);
        for p in cloth.pins.free.iter().cloned().flatten() {
            let (d0, d1) = (self.before.get(p), x.get(p) - last.get(p));
            let [drag, f] = cloth.integrator.decompose(p, d0, d1, params);
            self.ledger.damping += inertia * dot(drag, d0 + d1);
            self.ledger.gravity += 0.5 * dot(weight, d0 + d1);
            self.ledger.springs += 0.5 * dot(f - weight, d0 + d1);
        }
        let energy = cloth.energy();
        self.ledger.gravity += energy.gravitational - self.gravitational;
        self.ledger.springs += energy.spring - self.spring;
        self.total = energy.total();
        self.height = energy.gravitational;
    }

    /// Enters what contact under `coulomb` took from the motion. What it changed of height and springs only takes back
    /// a part of the step, and so is theirs, as is what the integrator's velocity differs from `(x - last) / dt`.
    fn record_contact(&mut self, cloth: &State) {
        let Some(Coulomb { change, .. }) = &cloth.coulomb else { return };
        let Params { mass, dt, .. } = cloth.params;
        let to_joule = mass / (2.0 * dt * dt);
        self.ledger.self_collision += change.self_collision * to_joule;
        let mut taken = change.self_collision * to_joule;
        for &kind in ColliderKind::ALL {
            self.ledger.colliders[kind] += change.colliders[kind] * to_joule;
            taken += change.colliders[kind] * to_joule;
        }
        let energy = cloth.energy();
        let raised = energy.gravitational - self.height;
        self.ledger.gravity += raised;
        self.ledger.springs += energy.total() - self.total - taken - raised;
        self.total = energy.total();
    }

    /// Enters what a phase after the integrator's did.
    fn record_correction(&mut self, phase: Phase, energy: Energy) {
        let total = energy.total();
        let ledger = &mut self.ledger;
        let entry = match phase {
            Phase::Forces | Phase::Integration | Phase::Contact => return,
            Phase::SelfCollision => &mut ledger.self_collision,
            Phase::Collision(kind) | Phase::Depenetration(kind) => &mut ledger.colliders[kind],
            Phase::StretchLimit => &mut ledger.stretch_limit,
        };
        *entry += total - self.total;
        self.total = total;
        self.height = energy.gravitational;
    }
}

impl Observer for LedgerRecorder {
    fn sees_forces(&self) -> bool {
        true
    }

    fn before_step(&mut self, cloth: &State) {
        let State { x, last, springs, params, .. } = cloth;
        (0..x.len()).for_each(|p| self.before.set(p, x.get(p) - last.get(p)));
        self.spring = spring_energy(x, springs);
        self.gravitational = -(0..x.len()).map(|p| dot(params.weight, x.get(p))).sum::<f64>();
    }

    fn after(&mut self, phase: Phase, cloth: &State) {
        match phase {
            _ if !cloth.has(phase) => {}
            Phase::Forces => {}
            Phase::Integration => self.record_integration(cloth),
            Phase::Contact => self.record_contact(cloth),
            _ => self.record_correction(phase, cloth.energy()),
        }
    }
}
