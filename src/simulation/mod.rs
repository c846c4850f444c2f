//! One simulation: the state of a cloth and the step that moves it on.

mod blow_up;
mod checks;
#[cfg(test)]
mod levels;
mod ledger_recorder;
mod observer;
mod observers;
mod phase;
pub mod snapshot;
mod state;
mod step;
mod timing;
mod unresolved;
mod variants;

pub use timing::Timings;
pub use unresolved::Unresolved;

use blow_up::Replay;
use ledger_recorder::LedgerRecorder;
use observers::Observers;
use state::State;
use timing::Timing;

use crate::cloth::{Counters, Points, chunks};
use crate::diagnostics::energy::Energy;
use crate::diagnostics::extremes::{Extremes, longest_spring};
use crate::diagnostics::ledger::Ledger;
use crate::error::Result;
use crate::math::StateHash;
use crate::scene::Scene;

/// A scene in motion. Without a cloth it has zero points, and only its clock moves.
#[derive(Clone, Debug)]
pub struct Simulation {
    steps_per_frame: u64,
    steps_per_second: f64,
    steps: u64,
    cloth: Option<State>,
    observers: Observers,
    no_points: Points,
    guarded: bool,
}

impl Simulation {
    /// The simulation of `scene` at its start.
    ///
    /// # Errors
    /// [`crate::error::Kind::Scene`] when the cloth does not fit in memory, has fewer than 2 x 2 points, or a pin
    /// lies outside it.
    pub fn new(scene: &Scene) -> Result<Self> {
        Self::starting_at(scene, None)
    }

    /// The simulation of `scene`; if `start` is given, its points are there at the start, and its
    /// springs at rest.
    ///
    /// # Errors
    /// As [`Simulation::new`]; [`crate::error::Kind::Scene`] too when there is not one position for each point.
    pub fn starting_at(scene: &Scene, start: Option<&Points>) -> Result<Self> {
        Ok(Self {
            steps_per_frame: u64::from(scene.sim.steps_per_frame),
            steps_per_second: scene.sim.fps * f64::from(scene.sim.steps_per_frame),
            steps: 0,
            cloth: State::new(scene, start)?,
            observers: Observers::default(),
            no_points: Points::default(),
            guarded: true,
        })
    }

    /// Puts the points at `x`, coming from `last` one step ago, in metres, as a new start for the cloth. The
    /// springs keep their rest lengths, and [`Simulation::steps`] and [`Simulation::time`] do not change.
    ///
    /// With the positions and last positions of another run, this one goes on as that run did, to the last bit, if the
    /// integrator remembers nothing else. Those that remember velocities (BDF2) start anew: the next step of
    /// every point is a first one, with the velocity `(x - last) / dt`, so it is not that run's. The energy is held
    /// against that of the new start.
    ///
    /// # Errors
    /// [`crate::error::Kind::Scene`] when there is not one position for each point of the cloth.
    pub fn set_state(&mut self, x: Points, last: Points) -> Result<()> {
        let points = self.positions().len();
        state::check_size(&x, points)?;
        state::check_size(&last, points)?;
        if let Some(cloth) = &mut self.cloth {
            (cloth.x, cloth.last) = (x, last);
            cloth.integrator.reset_history();
            cloth.set_energy_bound();
        }
        Ok(())
    }

    /// Makes one step.
    pub fn step(&mut self) {
        match &mut self.cloth {
            Some(cloth) => cloth.step(&mut self.observers),
            None => self.observers.counters.steps += 1,
        }
        self.steps += 1;
    }

    /// Makes the steps of one frame, then checks that every position is a number within ±1e15 m
    /// and, unless [`Simulation::allow_unstable`] was called, that the cloth holds no more energy
    /// than its forces can give it, nor was given more if a ledger is recorded
    /// (see `src/diagnostics/energy_bound.rs`).
    ///
    /// # Errors
    /// [`crate::error::Kind::Unstable`] when it is not so: with the step, the point, the spring and the phase.
    pub fn advance_frame(&mut self) -> Result<()> {
        let before = self.steps;
        self.cloth.iter_mut().for_each(State::note_frame_start);
        self.observers.ledger.iter_mut().for_each(LedgerRecorder::begin_frame);
        let points = self.positions().len();
        chunks::with_threads(points, || (0..self.steps_per_frame).for_each(|_| self.step()));
        self.check(before)
    }

    /// The checks of a frame that began after so many `steps`.
    fn check(&self, steps: u64) -> Result<()> {
        let Self { steps_per_frame, guarded, observers: Observers { ledger, .. }, .. } = self;
        let Some(cloth) = &self.cloth else { return Ok(()) };
        if cloth.is_in_range() && (!guarded || cloth.is_within_energy_bound(ledger.as_ref())) {
            return Ok(());
        }
        let (cloth, ledger) = (cloth.at_frame_start(), ledger.clone());
        Err(Replay { cloth, ledger, steps, steps_per_frame: *steps_per_frame, guarded: *guarded }.error())
    }

    /// The first position that loses what gravity does in `time` seconds to rounding
    /// (see `src/simulation/unresolved.rs`).
    pub fn unresolved(&self, time: f64) -> Option<Unresolved> {
        self.cloth.as_ref()?.unresolved(time)
    }

    /// Lets the energy of the cloth grow without an error; positions are still checked.
    pub fn allow_unstable(&mut self) {
        self.guarded = false;
    }

    /// How many frames are complete.
    pub fn frame(&self) -> u64 {
        self.steps / self.steps_per_frame
    }

    /// How many steps were made.
    pub fn steps(&self) -> u64 {
        self.steps
    }

    /// Simulated time since the start, in seconds.
    pub fn time(&self) -> f64 {
        self.steps as f64 / self.steps_per_second
    }

    /// Where the points are, in metres.
    pub fn positions(&self) -> &Points {
        self.cloth.as_ref().map_or(&self.no_points, |cloth| &cloth.x)
    }

    /// Where the last step moved the points from, in metres: where the phases of the step before it
    /// had left them. With `precision: f32` that is the position less the displacement, and with `contact: coulomb` the
    /// position less what the velocity after contact moves a point by in a step.
    pub fn last_positions(&self) -> &Points {
        self.cloth.as_ref().map_or(&self.no_points, |cloth| &cloth.last)
    }

    /// The energies of the cloth, in J; zero without a cloth.
    pub fn energy(&self) -> Energy {
        self.cloth.as_ref().map_or_else(Energy::default, State::energy)
    }

    /// The extremes of the cloth; zero without a cloth.
    pub fn extremes(&self) -> Extremes {
        let Some(cloth) = &self.cloth else { return Extremes::default() };
        Extremes::new(&cloth.x, &cloth.last, &cloth.springs, cloth.params.dt)
    }

    /// Largest length of a spring over its rest length, as [`Extremes::stretch`], without the work of the others.
    pub fn largest_stretch(&self) -> f64 {
        let longest = self.cloth.as_ref().and_then(|cloth| longest_spring(&cloth.x, &cloth.springs));
        longest.map_or(0.0, |spring| spring.stretch)
    }

    /// Records an energy ledger from now on. The cloth moves as without one, to the last bit.
    ///
    /// # Errors
    /// [`crate::error::Kind::Scene`] when the ledger does not fit in memory.
    pub fn record_ledger(&mut self) -> Result<()> {
        let recorder = self.cloth.as_ref().map(|cloth| LedgerRecorder::new(cloth.x.len()));
        self.observers.ledger = recorder.transpose()?;
        Ok(())
    }

    /// The ledger since [`Simulation::record_ledger`], if it was called and there is a cloth.
    pub fn ledger(&self) -> Option<Ledger> {
        self.observers.ledger.as_ref().map(|recorder| recorder.ledger)
    }

    /// A hash over the bits of the positions, as the arrays x, y and z, and then of the last positions.
    /// The velocities that some integrators remember are not in it.
    pub fn state_hash(&self) -> u64 {
        let mut hash = StateHash::default();
        for points in [self.positions(), self.last_positions()] {
            for &value in points.x.iter().chain(&points.y).chain(&points.z) {
                hash.write_f64(value);
            }
        }
        hash.finish()
    }

    /// What was done since the start.
    pub fn counters(&self) -> Counters {
        self.observers.counters
    }

    /// Measures from now on how long each phase takes.
    pub fn record_timings(&mut self) {
        self.observers.timing = Some(Timing::default());
    }

    /// How long each phase took since [`Simulation::record_timings`], if it was called.
    pub fn timings(&self) -> Option<Timings> {
        self.observers.timing.map(|timing| timing.timings)
    }
}
