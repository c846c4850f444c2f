//! How long each phase of a step takes.

use std::time::Instant;

/// Wall time spent in each phase since the start, in nanoseconds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize)]
pub struct Timings {
    /// Phase 1: weight and springs, under Verlet's scheme.
    pub forces: u64,
    /// Phase 2: Verlet's scheme.
    pub verlet: u64,
    /// Phases 1 and 2 of any other integrator.
    pub solver: u64,
    /// Phase 3: close points of the cloth.
    pub self_collision: u64,
    /// Phase 4: planes and spheres.
    pub objects: u64,
    /// Phase 5: springs that are too long.
    pub stretch_limit: u64,
}

/// Takes the time of the phases, when it was asked to.
#[derive(Clone, Debug, Default)]
pub(super) struct Stopwatch {
    pub(super) timings: Option<Timings>,
    since: Option<Instant>,
}

impl Stopwatch {
    /// Starts a lap.
    pub(super) fn start(&mut self) {
        self.since = self.timings.map(|_| Instant::now());
    }

    /// Ends a lap, adds it to the phase that `phase` picks, and starts the next.
    pub(super) fn lap(&mut self, phase: impl Fn(&mut Timings) -> &mut u64) {
        let (Some(timings), Some(since)) = (&mut self.timings, &mut self.since) else { return };
        let now = Instant::now();
        let nanoseconds = now.duration_since(*since).as_nanos();
        *phase(timings) += u64::try_from(nanoseconds).unwrap_or(u64::MAX);
        *since = now;
    }
}
