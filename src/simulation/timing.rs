//! How long each phase of a step takes.

use std::time::Instant;

use super::observer::Observer;
use super::phase::Phase;
use super::state::State;

/// Wall time spent in each phase since the start, in nanoseconds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize)]
pub struct Timings {
    /// Phase 1, weight and springs, under Verlet's scheme; phase 2 too, because both are one sweep, but in steps that do
    /// them apart for the ledger.
    pub forces: u64,
    /// Phase 2, Verlet's scheme, in steps that do it apart.
    pub verlet: u64,
    /// Phases 1 and 2 of any other integrator.
    pub solver: u64,
    /// Phase 3: close points of the cloth.
    pub self_collision: u64,
    /// Phase 4, and what keeps points outside: the objects of the scene. Under `coulomb`, all contact.
    pub objects: u64,
    /// Phase 5: springs that are too long.
    pub stretch_limit: u64,
}

/// Measures the phases. It alone reads a clock, which some platforms do not have.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Timing {
    pub(super) timings: Timings,
    /// When the last phase ended.
    since: Option<Instant>,
    /// Whether this step does phase 1 apart.
    forces_apart: bool,
}

impl Observer for Timing {
    fn sees_forces(&self) -> bool {
        false
    }

    fn before_step(&mut self, _cloth: &State) {
        self.since = Some(Instant::now());
        self.forces_apart = false;
    }

    fn after(&mut self, phase: Phase, cloth: &State) {
        let Some(since) = self.since.filter(|_| cloth.has(phase)) else { return };
        let now = Instant::now();
        let nanoseconds = now.duration_since(since).as_nanos();
        self.forces_apart |= matches!(phase, Phase::Forces);
        let timings = &mut self.timings;
        *match phase {
            Phase::Integration if !cloth.has(Phase::Forces) => &mut timings.solver,
            Phase::Integration if self.forces_apart => &mut timings.verlet,
            Phase::Forces | Phase::Integration => &mut timings.forces,
            Phase::SelfCollision => &mut timings.self_collision,
            Phase::Collision(_) | Phase::Depenetration(_) | Phase::Contact => &mut timings.objects,
            Phase::StretchLimit => &mut timings.stretch_limit,
        } += u64::try_from(nanoseconds).unwrap_or(u64::MAX);
        self.since = Some(now);
    }
}
