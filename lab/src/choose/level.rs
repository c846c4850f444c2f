//! One run of the scene to the moment, with other settings.

use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Duration;

use crate::accuracy::measure::{Measure, Shape};
use crate::accuracy::run::Run;
use crate::accuracy::source::Source;
use crate::horizon::Horizon;
use drape::diagnostics::stability::Stability;
use drape::error::{Kind, Result};
use drape::scene::{Integrator, Scene};
use drape::simulation::Simulation;

/// Runs the scene.
pub(super) struct Runner<'a> {
    pub(super) source: &'a Source,
    /// The frame of the moment.
    pub(super) frames: u64,
    pub(super) measure: Measure,
    /// Called after each frame; its error ends the run.
    pub(super) watch: &'a (dyn Fn() -> Result<()> + Sync),
    /// Springs visited by all runs so far.
    visited: AtomicU64,
}

/// What is run: an integrator and its steps, with further changes of the scene.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Settings {
    pub(super) integrator: Integrator,
    pub(super) steps: u32,
    /// As `--set` takes them.
    pub(super) sets: Vec<String>,
}

/// The cloth at the moment, and what it took to get there.
#[derive(Clone, Debug)]
pub(super) struct Level {
    pub(super) steps: u32,
    pub(super) shape: Shape,
    /// Springs visited: to compute a force, to multiply with the stiffness matrix, or to limit a stretch.
    pub(super) springs: u64,
    /// Whether contact, self-collision or the stretch limit moved a point.
    pub(super) rough: bool,
    /// Wall time of the simulation.
    pub(super) time: Duration,
    /// The lowest, the mean and the highest height of a point, in metres.
    pub(super) extent: [f64; 3],
}

/// How a run ended.
#[derive(Clone, Debug)]
pub(super) enum Outcome {
    Done(Level),
    /// The cloth blew up.
    Unstable,
    /// More springs were visited, or more time passed, than allowed; so many springs by then.
    TooDear(u64),
    /// It was not run, as it cannot be within: [`super::ladder::Ladder::is_hopeless`].
    Hopeless,
}

impl Settings {
    /// All changes, as `--set` takes them.
    pub(super) fn sets(&self) -> Vec<String> {
        let name = self.integrator.name();
        let mut sets = vec![format!("sim.integrator={name}"), format!("sim.steps_per_frame={}", self.steps)];
        sets.extend_from_slice(&self.sets);
        sets
    }
}

impl<'a> Runner<'a> {
    /// Runs `source` to frame `frames`.
    pub(super) fn new(
        source: &'a Source,
        frames: u64,
        measure: Measure,
        watch: &'a (dyn Fn() -> Result<()> + Sync),
    ) -> Self {
        Self { source, frames, measure, watch, visited: AtomicU64::new(0) }
    }

    /// Springs visited by all runs so far.
    pub(super) fn springs_visited(&self) -> u64 {
        self.visited.load(Ordering::Relaxed)
    }

    /// Runs the scene with `settings` beside copies that differ by rounding.
    pub(super) fn horizon(&self, settings: &Settings) -> Result<Horizon> {
        let horizon = Horizon::of(self.source, &settings.sets(), self.frames, self.measure, self.watch)?;
        self.visited.fetch_add(horizon.springs_visited, Ordering::Relaxed);
        Ok(horizon)
    }

    /// The fewest steps a frame at which the integrator of `settings` is stable in any shape of the cloth.
    pub(super) fn fewest(&self, settings: &Settings) -> Result<u32> {
        let scene = self.source.scene(&settings.sets())?;
        let Some(cloth) = &scene.cloth else { return Ok(1) };
        let stability = Stability::of_bounded(cloth, &scene.sim)?;
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at least 1; saturates")]
        let fewest = stability.map_or(1.0, |stability| stability.fewest_steps_worst()).max(1.0) as u32;
        Ok(fewest)
    }

    /// Runs the scene with `settings`.
    pub(super) fn run(&self, settings: &Settings) -> Result<Outcome> {
        self.run_while(&settings.sets(), settings.steps, &|_| true)
    }

    /// Runs the scene as it is written.
    pub(super) fn run_as_written(&self, scene: &Scene) -> Result<Outcome> {
        self.run_with(&[], scene.sim.steps_per_frame)
    }

    /// Runs the scene with the changes `sets`, which make it `steps` steps a frame.
    pub(super) fn run_with(&self, sets: &[String], steps: u32) -> Result<Outcome> {
        self.run_while(sets, steps, &|_| true)
    }

    /// Runs the scene with `settings` until it is known that more than `most` springs will be visited: an integrator whose
    /// steps cost the same each shows that in its first frame.
    pub(super) fn run_at_most(&self, settings: &Settings, most: u64) -> Result<Outcome> {
        let steady = matches!(settings.integrator, Integrator::Verlet | Integrator::Rk4 | Integrator::Xpbd);
        let goes_on = |run: &Run| {
            let [all, done] = if steady { [self.frames, run.simulation.frame()] } else { [1, 1] };
            u128::from(run.springs()) * u128::from(all) <= u128::from(most) * u128::from(done)
        };
        self.run_while(&settings.sets(), settings.steps, &goes_on)
    }

    /// Runs the scene with `settings` for at most `time`.
    pub(super) fn run_for(&self, settings: &Settings, time: Duration) -> Result<Outcome> {
        self.run_while(&settings.sets(), settings.steps, &|run| run.elapsed <= time)
    }

    /// Runs the scene with these changes while it `goes_on`.
    fn run_while(&self, sets: &[String], steps: u32, goes_on: &dyn Fn(&Run) -> bool) -> Result<Outcome> {
        let scene = self.source.scene(sets)?;
        let mut run = Run::new(&scene)?;
        let ended = self.advance(&mut run, goes_on);
        self.visited.fetch_add(run.springs(), Ordering::Relaxed);
        if let Some(outcome) = ended? {
            return Ok(outcome);
        }
        let x = run.simulation.positions();
        let heights = (0..x.len()).map(|p| x.get(p).y);
        let [low, high] = [
            heights.clone().fold(f64::INFINITY, f64::min),
            heights.clone().fold(f64::NEG_INFINITY, f64::max),
        ];
        let mean = heights.sum::<f64>() / x.len().max(1) as f64;
        Ok(Outcome::Done(Level {
            steps,
            shape: self.measure.shape(&scene, x)?,
            springs: run.springs(),
            rough: is_rough(&run.simulation),
            time: run.elapsed,
            extent: [low, mean, high],
        }))
    }

    /// Advances `run` to the moment; how it ended, if it ended before.
    fn advance(&self, run: &mut Run, goes_on: &dyn Fn(&Run) -> bool) -> Result<Option<Outcome>> {
        for _ in 0..self.frames {
            let ended = run.timed(Simulation::advance_frame);
            (self.watch)()?;
            match ended {
                Err(error) if error.kind == Kind::Unstable => return Ok(Some(Outcome::Unstable)),
                ended => ended?,
            }
            if !goes_on(run) {
                return Ok(Some(Outcome::TooDear(run.springs())));
            }
        }
        Ok(None)
    }
}

fn is_rough(simulation: &Simulation) -> bool {
    let counters = simulation.counters();
    counters.object_moves + counters.self_collision_moves + counters.springs_limited > 0
}
