//! A run that is timed, and whose work is counted.

use std::time::{Duration, Instant};

use drape::error::Result;
use drape::scene::Scene;
use drape::simulation::Simulation;

/// A simulation, and what it took so far.
#[derive(Debug)]
pub struct Run {
    /// The simulation.
    pub simulation: Simulation,
    /// Wall time of what was [`Run::timed`].
    pub elapsed: Duration,
}

impl Run {
    /// The simulation of `scene` at its start.
    ///
    /// # Errors
    /// As [`Simulation::new`].
    pub fn new(scene: &Scene) -> Result<Self> {
        Ok(Self { simulation: Simulation::new(scene)?, elapsed: Duration::ZERO })
    }

    /// Does `work`, and adds its time.
    pub fn timed<T>(&mut self, work: impl FnOnce(&mut Simulation) -> T) -> T {
        let started = Instant::now();
        let done = work(&mut self.simulation);
        self.elapsed += started.elapsed();
        done
    }

    /// Springs visited so far: to compute a force, to multiply with the stiffness matrix, or to limit a stretch. The same
    /// on every machine.
    pub fn springs(&self) -> u64 {
        let counters = self.simulation.counters();
        counters.springs_evaluated + counters.springs_checked
    }
}
