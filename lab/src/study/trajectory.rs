//! One run: the positions and the energy of the cloth at each moment, and what the run cost.

use serde::{Deserialize, Serialize};

use crate::accuracy::run::Run;
use drape::cloth::Points;
use drape::error::Result;
use drape::scene::Scene;
use drape::simulation::Simulation;

/// Most steps between two checks of the cost.
const STEPS_PER_CHECK: u32 = 10;

/// Factor on the allowed cost up to the first moment: a run that ends before it gives no result at all.
const FIRST: f64 = 2.0;

/// The result of a run.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Trajectory {
    /// The moments that were reached before the cloth was lost or the run was given up.
    pub moments: Vec<Moment>,
    /// Springs visited per simulated second: to compute a force, to multiply with the stiffness matrix, or
    /// to limit a stretch.
    pub springs: f64,
    /// Wall time per simulated second, in seconds.
    pub wall: f64,
    /// Whether it was given up because it cost too much.
    pub given_up: bool,
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

/// The length of a run, and the cost that it may reach.
#[derive(Clone, Copy, Debug)]
pub struct Limits<'a> {
    /// The moments, in tenths of a second, ascending.
    pub tenths: &'a [u32],
    /// Springs after which the run is given up, or twice as many before the first moment. A run may pass it by
    /// a few steps: how many springs an implicit step visits is known only afterwards.
    pub most_springs: f64,
}

/// Runs `scene` at `rate` steps per second, a multiple of 10. `watch` is told the number of steps since its
/// last call, which add up to those of a complete run, and can end the run with an error.
///
/// # Errors
/// Those of [`Simulation::new`] and of `watch`.
pub fn run(
    scene: &Scene,
    rate: u32,
    limits: Limits<'_>,
    watch: &dyn Fn(u32) -> Result<()>,
) -> Result<Trajectory> {
    let left = limits.tenths.last().map_or(0, |last| rate / 10 * last);
    let mut way = Way { run: Run::new(scene)?, left, watch };
    way.run.simulation.allow_unstable();
    let mut probe = Probe::new(scene)?;
    let (mut moments, mut given_up, mut done) = (Vec::new(), false, 0);
    for &tenth in limits.tenths {
        let steps = rate / 10 * tenth - done;
        let most = limits.most_springs * if done == 0 { FIRST } else { 1.0 };
        let in_time = way.advance(steps - 1, most)?;
        let before = way.run.simulation.positions().clone();
        given_up = !(in_time && way.advance(1, most)?);
        if given_up {
            break;
        }
        done += steps;
        match probe.moment(&way.run.simulation, &before, f64::from(tenth) / 10.0)? {
            Some(moment) => moments.push(moment),
            None => break,
        }
    }
    watch(way.left)?;
    let run = way.run;
    let simulated = run.simulation.steps().max(1) as f64 / f64::from(rate);
    let wall = run.elapsed.as_secs_f64() / simulated;
    Ok(Trajectory { moments, springs: run.springs() as f64 / simulated, wall, given_up })
}

/// A run that tells its steps.
struct Way<'a> {
    run: Run,
    /// Steps that `watch` was not told yet.
    left: u32,
    watch: &'a dyn Fn(u32) -> Result<()>,
}

impl Way<'_> {
    /// Makes `steps` steps, and stops once more than `most` springs were visited; whether it made them all.
    fn advance(&mut self, steps: u32, most: f64) -> Result<bool> {
        let mut left = steps;
        while left > 0 {
            if self.run.springs() as f64 > most {
                return Ok(false);
            }
            let some = left.min(STEPS_PER_CHECK);
            self.run.timed(|simulation| (0..some).for_each(|_| simulation.step()));
            left -= some;
            self.left -= some;
            (self.watch)(some)?;
        }
        Ok(true)
    }
}

/// Measures energies with the velocity at the moment itself: `(x₊ - x₋) / 2 dt` over the steps before and
/// after it, which is of second order for every method; `(x - x₋) / dt` would lag half a step behind.
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

    /// The moment of `now`, whose points were at `before` one step ago; `None` once a point is lost.
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
        // A cloth whose energy is not finite is lost.
        Ok(Some(moment).filter(|moment| moment.energy.is_finite() && moment.stretch.is_finite()))
    }
}
