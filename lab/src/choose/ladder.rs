//! The ladder: the scene under Verlet's scheme at n, 2 n, 4 n, ... steps a frame, from its bound up, until the
//! limit is known well enough. It is the cheapest way to the limit: no other integrator was as accurate for
//! the same work at any stiffness that was tried (`docs/findings.md`).

use super::estimate::Limit;
use super::goal::Tolerance;
use super::level::{Level, Outcome, Runner, Settings};
use crate::accuracy::measure::Shape;
use drape::error::{Error, Kind, Result};
use drape::math;
use drape::scene::{Damping, Integrator, Scene};

/// Differences of successive levels that are more than [`SHRINKS`] of the one before: after so many the ladder has no
/// limit that it can find.
const PATIENCE: usize = 3;

/// The most that a difference may be of the one before it where the method converges; half a power of the step.
const SHRINKS: f64 = 0.75;

/// How far beyond its last level the power law of a ladder is believed, as a factor on the steps.
const BEYOND: f64 = 1.5;

/// The part of a level's steps below which fewer are tried: a run of its own has to save a third.
const WORTH: f64 = 2.0 / 3.0;

/// How many times nearer to the limit than Verlet's scheme with as many steps another is taken to be at best, where the
/// error is that of what acts once a step. Among random scenes the nearest was at 0.9 of the distance (`docs/choose.md`).
const BETTER: f64 = 1.5;

/// The highest order that is seen where what acts once a step decides.
const ONCE_A_STEP: f64 = 1.75;

/// The part of what is asked for by which two runs may differ that are far nearer to each other.
const FAR_NEARER: f64 = 0.1;

/// Most steps a frame that a ladder begins with.
const MOST_STEPS: u32 = 1 << 20;

/// Most levels: the last has 2^12 times the steps of the first.
const MOST_LEVELS: usize = 13;

/// The runs, coarsest first, and the limit that the last three show.
#[derive(Clone, Debug)]
pub(super) struct Ladder {
    pub(super) levels: Vec<Level>,
    /// The changes of the scene that all of them have.
    pub(super) cures: Vec<String>,
    pub(super) limit: Option<Limit>,
    /// Further runs, of steps between the levels.
    pub(super) tried: Vec<Level>,
}

/// The changes that give Verlet's scheme on `scene` a limit: damping that is a share of the motion per step has
/// none, and the report's start is of first order.
pub(super) fn cures(scene: &Scene) -> Vec<String> {
    let damped = scene.cloth.as_ref().is_some_and(|cloth| cloth.damping > 0.0);
    let mut cures = vec!["sim.precision=f64".to_owned(), "sim.start=half_step".to_owned()];
    if damped && scene.sim.damping == Damping::PerStep {
        cures.push("sim.damping=per_second".to_owned());
    }
    cures
}

impl Ladder {
    /// Climbs until a number of steps is known that is within `tolerance`, or until that will not happen.
    pub(super) fn climb(runner: &Runner<'_>, scene: &Scene, tolerance: Tolerance) -> Result<Self> {
        let mut ladder = Self::start(runner, scene)?;
        ladder.climb_on(runner, tolerance)?;
        Ok(ladder)
    }

    /// Adds levels, at least one if there can be more, as [`Ladder::climb`] does. Where that is in vain, the limit is
    /// forgotten.
    pub(super) fn climb_on(&mut self, runner: &Runner<'_>, tolerance: Tolerance) -> Result<()> {
        while self.levels.len() < MOST_LEVELS && !self.stands_still(tolerance) {
            let steps = 2 * self.levels[self.levels.len() - 1].steps;
            self.push(runner, steps)?;
            if self.enough(tolerance).is_some() {
                return Ok(());
            }
        }
        self.limit = None;
        Ok(())
    }

    /// The fewest steps that are within `tolerance` as far as the levels tell: between the levels and a little beyond
    /// the last, [`BEYOND`], where an order is seen; otherwise those of a level.
    pub(super) fn enough(&self, tolerance: Tolerance) -> Option<u32> {
        let limit = self.limit.as_ref()?;
        let of_levels = self.levels.iter().find(|level| self.worst(level, limit) <= tolerance.value);
        let of_levels = of_levels.map(|level| level.steps);
        let (Some(order), Some(last)) = (limit.order, self.levels.last()) else { return of_levels };
        let room = tolerance.value - limit.uncertainty;
        // A hundredth more, since the error of a step in between follows the power law only nearly.
        let ratio = math::pow(self.error(last, limit) / room, 1.0 / order) * 1.01;
        if room <= 0.0 || ratio.is_nan() || ratio > BEYOND {
            return of_levels;
        }
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "at most 1.5 times a u32 below 2^20"
        )]
        let predicted = (f64::from(last.steps) * ratio).ceil() as u32;
        let predicted = predicted.max(self.levels[0].steps);
        let is_worth = |steps: u32| f64::from(predicted) <= WORTH * f64::from(steps);
        Some(of_levels.filter(|&steps| !is_worth(steps)).unwrap_or(predicted))
    }

    /// Whether no integrator can be within with `steps` steps a frame. What acts once a step, contact, self-collision
    /// and the stretch limit, does so under all of them: where their error decides, which shows as a low order or none,
    /// no integrator is much nearer to the limit than Verlet's scheme with as many steps.
    pub(super) fn is_hopeless(&self, steps: u32, limit: &Limit, tolerance: Tolerance) -> bool {
        let rough = self.levels.iter().any(|level| level.rough);
        let decides = rough && self.levels.len() > 3 && limit.order.is_none_or(|order| order < ONCE_A_STEP);
        let level = self.levels.iter().find(|level| level.steps >= steps);
        let room = tolerance.value - limit.uncertainty;
        decides && level.is_some_and(|level| self.error(level, limit) > BETTER * room)
    }

    /// Whether the last two levels are far nearer to each other than is asked for, or an order is seen. Then copies that
    /// differ by rounding are nearer too: their motion parts as that of runs which differ by their step, from a smaller
    /// difference.
    pub(super) fn is_told(&self, limit: &Limit, tolerance: Tolerance) -> bool {
        let agree = |pair: &[Level]| {
            tolerance.measure.distance(&pair[0].shape, &pair[1].shape) <= FAR_NEARER * tolerance.value
        };
        limit.order.is_some() || self.levels.windows(2).next_back().is_some_and(agree)
    }

    /// The first level alone.
    pub(super) fn start(runner: &Runner<'_>, scene: &Scene) -> Result<Self> {
        let mut ladder = Self { levels: Vec::new(), cures: cures(scene), limit: None, tried: Vec::new() };
        let settings = ladder.settings(1);
        if runner.source.scene(&settings.sets())?.cloth.is_none() {
            return Err(Error::new(
                Kind::Nothing,
                "the scene has no cloth, so every step gives the same answer",
            ));
        }
        let steps = runner.fewest(&settings)?;
        if steps > MOST_STEPS {
            let message =
                format!("Verlet's scheme needs {steps} steps a frame, more than can be tried ({MOST_STEPS})");
            return Err(Error::new(Kind::Difference, message));
        }
        ladder.push(runner, steps)?;
        Ok(ladder)
    }

    /// What is run at `steps` steps a frame.
    pub(super) fn settings(&self, steps: u32) -> Settings {
        Settings { integrator: Integrator::Verlet, steps, sets: self.cures.clone() }
    }

    /// Runs one more level.
    pub(super) fn push(&mut self, runner: &Runner<'_>, steps: u32) -> Result<()> {
        let level = self.run(runner, steps)?;
        self.levels.push(level);
        let shapes: Vec<&Shape> = self.levels.iter().map(|level| &level.shape).collect();
        let rough = self.levels.iter().any(|level| level.rough);
        self.limit = Limit::new(&shapes, rough, runner.measure);
        Ok(())
    }

    /// Runs at `steps` steps a frame, which changes nothing of the limit.
    pub(super) fn run(&self, runner: &Runner<'_>, steps: u32) -> Result<Level> {
        let Outcome::Done(level) = runner.run(&self.settings(steps))? else {
            let message = format!("the cloth blows up at {steps} steps a frame, which its springs allow");
            return Err(Error::new(Kind::Unstable, message).with_help(
                "`drape simulate` says where; what contact adds, no step cures, but `sim.contact` = `coulomb` adds nothing",
            ));
        };
        Ok(level)
    }

    /// The most that `level` may be off `limit`.
    pub(super) fn worst(&self, level: &Level, limit: &Limit) -> f64 {
        self.error(level, limit) + limit.uncertainty
    }

    /// The estimated distance of `level` from `limit`.
    pub(super) fn error(&self, level: &Level, limit: &Limit) -> f64 {
        limit.measure.distance(&level.shape, &limit.shape)
    }

    /// Whether halving the step does not bring the points closer: it failed to [`PATIENCE`] times.
    fn stands_still(&self, tolerance: Tolerance) -> bool {
        let between = |pair: &[Level]| tolerance.measure.distance(&pair[0].shape, &pair[1].shape);
        let differences: Vec<f64> = self.levels.windows(2).map(between).collect();
        differences.windows(2).filter(|pair| pair[1] > SHRINKS * pair[0]).count() >= PATIENCE
    }
}
