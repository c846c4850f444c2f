//! One run: where the points are at each moment, with what energy, and how long it took.

use std::time::{Duration, Instant};

use serde::{Deserialize, Serialize};

use crate::cloth::Points;
use crate::error::Result;
use crate::scene::Scene;
use crate::simulation::Simulation;

/// Steps between two looks at the watch.
const PATIENCE: u32 = 500;

/// What a run gave.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Trajectory {
    /// The moments; those after the cloth was lost are absent.
    pub moments: Vec<Moment>,
    /// Springs that were visited, to compute a force or to limit a stretch, per simulated second.
    pub springs: f64,
    /// Wall time per simulated second, in seconds.
    pub wall: f64,
}

/// The cloth at one moment.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Moment {
    /// Simulated time, in seconds.
    pub time: f64,
    /// Components of the positions, in metres.
    pub x: [Vec<f64>; 3],
    /// Total energy above that at the start, in J.
    pub energy: f64,
    /// Energy of height above that at the start, in J.
    pub height: f64,
    /// Largest length of a spring over its rest length.
    pub stretch: f64,
}

/// Runs `scene` at `rate` steps per second, a multiple of 10, and looks at it at each of `tenths` of a
/// second. `watch` is told the steps that were made since it was last called, and can end the run.
///
/// # Errors
/// Those of [`Simulation::new`] and of `watch`.
pub fn run(
    scene: &Scene,
    rate: u32,
    tenths: &[u32],
    watch: &dyn Fn(u32) -> Result<()>,
) -> Result<Trajectory> {
    let mut simulation = Simulation::new(scene)?;
    simulation.allow_unstable();
    let mut probe = Probe::new(scene)?;
    let (mut moments, mut elapsed, mut done) = (Vec::new(), Duration::ZERO, 0);
    for &tenth in tenths {
        let steps = rate / 10 * tenth - done;
        elapsed += advance(&mut simulation, steps - 1, watch)?;
        let before = simulation.positions().clone();
        elapsed += advance(&mut simulation, 1, watch)?;
        done += steps;
        match probe.moment(&simulation, &before, f64::from(tenth) * 0.1)? {
            Some(moment) => moments.push(moment),
            None => break,
        }
    }
    let counters = simulation.counters();
    let simulated = f64::from(done.max(1)) / f64::from(rate);
    #[expect(clippy::cast_precision_loss, reason = "counts far below 2^53")]
    let springs = (counters.springs_evaluated + counters.springs_checked) as f64 / simulated;
    Ok(Trajectory { moments, springs, wall: elapsed.as_secs_f64() / simulated })
}

/// Makes `steps` steps and tells how long they took.
fn advance(simulation: &mut Simulation, steps: u32, watch: &dyn Fn(u32) -> Result<()>) -> Result<Duration> {
    let (mut elapsed, mut left) = (Duration::ZERO, steps);
    while left > 0 {
        let some = left.min(PATIENCE);
        let started = Instant::now();
        (0..some).for_each(|_| simulation.step());
        elapsed += started.elapsed();
        left -= some;
        watch(some)?;
    }
    Ok(elapsed)
}

/// Measures energies with velocities at the moment itself: `(x₊ - x₋) / 2 dt` over the steps before and
/// after it, which is second order for every method; `(x - x₋) / dt` would lag half a step behind.
struct Probe {
    simulation: Simulation,
    start: [f64; 2],
}

impl Probe {
    fn new(scene: &Scene) -> Result<Self> {
        let mut simulation = Simulation::new(scene)?;
        let x = simulation.positions().clone();
        simulation.set_state(x.clone(), x)?;
        let energy = simulation.energy();
        Ok(Self { start: [energy.total(), energy.gravitational], simulation })
    }

    /// The state of `now`, whose points were at `before` one step ago; nothing once a point is lost.
    fn moment(&mut self, now: &Simulation, before: &Points, time: f64) -> Result<Option<Moment>> {
        let mut next = now.clone();
        next.step();
        let (x, after) = (now.positions(), next.positions());
        let mut last = x.clone();
        for p in 0..x.len() {
            last.set(p, x.get(p) - (after.get(p) - before.get(p)) * 0.5);
        }
        self.simulation.set_state(x.clone(), last)?;
        let energy = self.simulation.energy();
        let [total, height] = self.start;
        let moment = Moment {
            time,
            x: [x.x.clone(), x.y.clone(), x.z.clone()],
            energy: energy.total() - total,
            height: energy.gravitational - height,
            stretch: self.simulation.extremes().stretch,
        };
        // An energy that is no number, or too large for one, belongs to a cloth that is lost.
        Ok(Some(moment).filter(|moment| moment.energy.is_finite() && moment.stretch.is_finite()))
    }
}
