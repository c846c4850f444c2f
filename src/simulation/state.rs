//! The state of a cloth and the step that moves it on.

use super::scheme::Scheme;
use super::stopwatch::Stopwatch;
use crate::cloth::forces::Forces;
use crate::cloth::grid::{self, Grid, Pins};
use crate::cloth::guard::{Allowance, Budget};
use crate::cloth::ledger::{Ledger, Recorder};
use crate::cloth::springs::Springs;
use crate::cloth::stretch_limit::StretchLimit;
use crate::cloth::{Constants, Counters, Points};
use crate::collision::self_collision::SelfCollision;
use crate::collision::{ColliderKind, Colliders};
use crate::error::{Error, Kind, Result};
use crate::scene::{Plan, Scene, Start};

/// The state of a cloth and what its step needs; phases that the scene does without are absent.
#[derive(Clone, Debug)]
pub(super) struct State {
    pub(super) constants: Constants,
    pub(super) grid: Grid,
    pub(super) pins: Pins,
    pub(super) springs: Springs,
    pub(super) x: Points,
    pub(super) last: Points,
    pub(super) scheme: Scheme,
    pub(super) self_collision: Option<SelfCollision>,
    pub(super) colliders: Colliders,
    stretch_limit: Option<StretchLimit>,
    pub(super) recorder: Option<Recorder>,
    pub(super) allowance: Allowance,
    pub(super) budget: Budget,
    /// Positions, last positions and what the scheme remembers, where the frame began.
    pub(super) frame_start: Vec<Points>,
}

impl State {
    /// The cloth of `scene`, if there is one, at its start or at `start`.
    pub(super) fn new(scene: &Scene, start: Option<&Points>) -> Result<Option<Self>> {
        let Some(cloth) = &scene.cloth else { return Ok(None) };
        let (sim, plan) = (&scene.sim, Plan::of(scene));
        let grid = Grid::new(cloth)?;
        let mut x = grid::start(cloth, grid)?;
        if let Some(start) = start {
            check_size(start, x.len())?;
            x.copy_from(start);
        }
        let mut last = Points::zeros(grid.len())?;
        last.copy_from(&x);
        let springs = Springs::new(cloth, grid, &x)?;
        let constants = Constants::new(cloth, sim);
        let limit = |limit| StretchLimit::new(limit, sim.stretch_passes, &springs);
        let scheme = Scheme::new(cloth, sim, &springs)?;
        let colliders = Colliders::new(scene, &x)?;
        let mut state = Self {
            constants,
            grid,
            pins: Pins::new(cloth, grid)?,
            last,
            self_collision: SelfCollision::new(plan.self_collision, cloth, sim, grid, &x)?,
            stretch_limit: plan.stretch_limit.map(limit).transpose()?,
            recorder: None,
            budget: Budget::default(),
            frame_start: vec![Points::zeros(grid.len())?; 2 + scheme.memory().len()],
            allowance: Allowance::new(scene, cloth, &springs, &constants, colliders.lift()),
            colliders,
            scheme,
            springs,
            x,
        };
        if sim.start == Start::HalfStep {
            state.start_half_step()?;
        }
        state.set_budget();
        Ok(Some(state))
    }

    /// Puts the last positions where points at rest would have been one step ago under the forces at
    /// the start: `last = x + f dt² / (2 m)`.
    fn start_half_step(&mut self) -> Result<()> {
        let Self { constants, pins, springs, x, last, .. } = self;
        let mut forces = Forces::new(springs)?;
        forces.compute(x, springs, constants.weight.into(), &mut Counters::default());
        let half = 0.5 * constants.dt * constants.dt / constants.mass;
        for p in pins.free.iter().cloned().flatten() {
            last.set(p, x.get(p) + forces.sum().get(p) * half);
        }
        Ok(())
    }

    /// One step of the method. The phases after the integrator's change positions and never `last`.
    pub(super) fn step(&mut self, counters: &mut Counters, stopwatch: &mut Stopwatch) {
        stopwatch.start();
        if let Some(recorder) = &mut self.recorder {
            recorder.begin(&self.x, &self.last, &self.springs, &self.constants);
        }

        // 1. and 2. The integrator: under the forces every free point moves on.
        self.advance(counters, stopwatch);
        let Self { constants, pins, springs, x, last, scheme, recorder, .. } = self;
        if let Some(recorder) = recorder {
            let split = |p, before, moved| scheme.split(p, before, moved, constants);
            recorder.advanced(x, last, springs, pins, constants, split);
        }
        let mut book = |x: &Points, last: &Points, entry: fn(&mut Ledger) -> &mut f64| {
            if let Some(recorder) = recorder {
                recorder.corrected(x, last, springs, constants, entry);
            }
        };

        // 3. Self-collision: close points move apart.
        if let Some(self_collision) = &mut self.self_collision {
            self_collision.apply(x, pins, counters);
            stopwatch.lap(|timings| &mut timings.self_collision);
            book(x, last, |ledger| &mut ledger.self_collision);
        }

        // 4. Objects: points that went through a plane or into a sphere are put back.
        if !self.colliders.is_empty() {
            for kind in ColliderKind::ALL {
                self.colliders.resolve(kind, x, last, pins, counters);
                stopwatch.lap(|timings| &mut timings.objects);
                book(x, last, entry(kind));
            }
        }

        // 5. Stretch limit: springs that are too long are shortened.
        if let Some(stretch_limit) = &mut self.stretch_limit {
            stretch_limit.apply(x, springs, pins, counters);
            stopwatch.lap(|timings| &mut timings.stretch_limit);
            book(x, last, |ledger| &mut ledger.stretch_limit);
        }

        // Where the scene asks for it: points that the phases left inside an object leave it.
        if self.colliders.keep_outside() {
            for kind in ColliderKind::ALL {
                self.colliders.depenetrate(kind, x, pins, counters);
                stopwatch.lap(|timings| &mut timings.objects);
                book(x, last, entry(kind));
            }
        }
    }
}

/// The ledger's entry for objects of one kind.
fn entry(kind: ColliderKind) -> fn(&mut Ledger) -> &mut f64 {
    match kind {
        ColliderKind::Plane => |ledger| &mut ledger.planes,
        ColliderKind::Sphere => |ledger| &mut ledger.spheres,
    }
}

/// Checks that `x` has `points` positions.
pub(super) fn check_size(x: &Points, points: usize) -> Result<()> {
    if [&x.x, &x.y, &x.z].iter().all(|component| component.len() == points) {
        return Ok(());
    }
    Err(Error::new(Kind::Scene, format!("the state is not one of {points} points")))
}
