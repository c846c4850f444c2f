//! One run of the scene to the moment, with other settings.

use std::time::{Duration, Instant};

use super::goal::{Measure, Shape};
use crate::study::source::Source;
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

impl Runner<'_> {
    /// Runs the scene with `settings`.
    pub(super) fn run(&self, settings: &Settings) -> Result<Outcome> {
        self.run_while(&settings.sets(), settings.steps, &|_, _| true)
    }

    /// Runs the scene as it is written.
    pub(super) fn run_as_written(&self, scene: &Scene) -> Result<Outcome> {
        self.run_with(&[], scene.sim.steps_per_frame)
    }

    /// Runs the scene with the changes `sets`, which make it `steps` steps a frame.
    pub(super) fn run_with(&self, sets: &[String], steps: u32) -> Result<Outcome> {
        self.run_while(sets, steps, &|_, _| true)
    }

    /// Runs the scene with `settings` until more than `most` springs were visited.
    pub(super) fn run_at_most(&self, settings: &Settings, most: u64) -> Result<Outcome> {
        self.run_while(&settings.sets(), settings.steps, &|springs, _| springs <= most)
    }

    /// Runs the scene with `settings` for at most `time`.
    pub(super) fn run_for(&self, settings: &Settings, time: Duration) -> Result<Outcome> {
        self.run_while(&settings.sets(), settings.steps, &|_, passed| passed <= time)
    }

    /// Runs the scene with these changes while `goes_on`, given the springs visited and the time passed.
    fn run_while(
        &self,
        sets: &[String],
        steps: u32,
        goes_on: &dyn Fn(u64, Duration) -> bool,
    ) -> Result<Outcome> {
        let scene = self.source.scene(sets)?;
        let mut simulation = Simulation::new(&scene)?;
        let mut time = Duration::ZERO;
        for _ in 0..self.frames {
            let started = Instant::now();
            let ended = simulation.advance_frame();
            time += started.elapsed();
            (self.watch)()?;
            match ended {
                Err(error) if error.kind == Kind::Unstable => return Ok(Outcome::Unstable),
                ended => ended?,
            }
            if !goes_on(springs(&simulation), time) {
                return Ok(Outcome::TooDear(springs(&simulation)));
            }
        }
        let x = simulation.positions();
        let heights = (0..x.len()).map(|p| x.get(p).y);
        let [low, high] = [
            heights.clone().fold(f64::INFINITY, f64::min),
            heights.clone().fold(f64::NEG_INFINITY, f64::max),
        ];
        let mean = heights.sum::<f64>() / x.len().max(1) as f64;
        Ok(Outcome::Done(Level {
            steps,
            shape: self.measure.shape(&scene, x)?,
            springs: springs(&simulation),
            rough: is_rough(&simulation),
            time,
            extent: [low, mean, high],
        }))
    }
}

fn springs(simulation: &Simulation) -> u64 {
    let counters = simulation.counters();
    counters.springs_evaluated + counters.springs_checked
}

fn is_rough(simulation: &Simulation) -> bool {
    let counters = simulation.counters();
    counters.object_moves + counters.self_collision_moves + counters.springs_limited > 0
}
