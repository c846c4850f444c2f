//! One simulation: the state of a cloth and the step that moves it on.

mod guarded;
mod locate;
mod stiffness;
mod stopwatch;

use stopwatch::Stopwatch;
pub use stopwatch::Timings;

use crate::cloth::collide::Objects;
use crate::cloth::contact::Outside;
use crate::cloth::energy::Energy;
use crate::cloth::forces::Forces;
use crate::cloth::grid::{self, Grid, Pins};
use crate::cloth::guard::{Allowance, Budget};
use crate::cloth::ledger::{Ledger, Recorder};
use crate::cloth::measure::Extremes;
use crate::cloth::neighbors::Neighbors;
use crate::cloth::self_collision::SelfCollision;
use crate::cloth::springs::Springs;
use crate::cloth::stretch_limit::StretchLimit;
use crate::cloth::{Constants, Counters, Points, verlet};
use crate::error::{Error, Kind, Result};
use crate::math::StateHash;
use crate::scene::{Scene, Start};

/// A scene in motion. Without a cloth it has zero points, and only its clock moves.
#[derive(Clone, Debug)]
pub struct Simulation {
    steps_per_frame: u64,
    steps_per_second: f64,
    steps: u64,
    cloth: Option<State>,
    counters: Counters,
    stopwatch: Stopwatch,
    no_points: Points,
    guarded: bool,
}

/// The state of a cloth and what its step needs; phases that the scene does without are absent.
#[derive(Clone, Debug)]
struct State {
    constants: Constants,
    grid: Grid,
    pins: Pins,
    springs: Springs,
    x: Points,
    last: Points,
    forces: Forces,
    self_collision: Option<SelfCollision>,
    neighbors: Option<Neighbors>,
    objects: Option<Objects>,
    stretch_limit: Option<StretchLimit>,
    outside: Option<Outside>,
    recorder: Option<Recorder>,
    allowance: Allowance,
    budget: Budget,
    /// Positions and last positions where the frame began.
    frame_start: [Points; 2],
}

/// A position that a step is too short for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unresolved {
    /// Column and row of the point.
    pub point: (usize, usize),
    /// The coordinate: 0, 1 or 2.
    pub axis: usize,
    /// What gravity adds to the displacement in a step, in metres.
    pub fall: f64,
    /// Distance of two neighbouring numbers at the position, in metres.
    pub rounding: f64,
}

impl Simulation {
    /// The simulation of `scene` at its start.
    ///
    /// # Errors
    /// [`Kind::Scene`] when the cloth does not fit in memory, has fewer than 2 x 2 points, or a pin
    /// lies outside it.
    pub fn new(scene: &Scene) -> Result<Self> {
        Ok(Self {
            steps_per_frame: u64::from(scene.sim.steps_per_frame),
            steps_per_second: scene.sim.fps * f64::from(scene.sim.steps_per_frame),
            steps: 0,
            cloth: State::new(scene)?,
            counters: Counters::default(),
            stopwatch: Stopwatch::default(),
            no_points: Points::default(),
            guarded: true,
        })
    }

    /// Puts the points at `x`, coming from `last` one step ago, in metres: another start, or a
    /// state kept from an earlier run. The springs keep their rest lengths, the clock its time.
    ///
    /// # Errors
    /// [`Kind::Scene`] when there is not one position for each point of the cloth.
    pub fn set_state(&mut self, x: Points, last: Points) -> Result<()> {
        let points = self.positions().len();
        if [&x, &last].iter().any(|state| [&state.x, &state.y, &state.z].iter().any(|c| c.len() != points)) {
            return Err(Error::new(Kind::Scene, format!("the state is not one of {points} points")));
        }
        if let Some(cloth) = &mut self.cloth {
            (cloth.x, cloth.last) = (x, last);
            cloth.set_budget();
        }
        Ok(())
    }

    /// Makes one step.
    pub fn step(&mut self) {
        if let Some(cloth) = &mut self.cloth {
            cloth.step(&mut self.counters, &mut self.stopwatch);
        }
        self.counters.steps += 1;
        self.steps += 1;
    }

    /// Makes the steps of one frame, then checks that every position is a number within ±1e15 m
    /// and, unless [`Simulation::allow_unstable`] was called, that the cloth holds no more energy
    /// than its forces can give it (`src/cloth/guard.rs` says how much that is).
    ///
    /// # Errors
    /// [`Kind::Unstable`] when it is not so: with the step, the point, the spring and the phase.
    pub fn advance_frame(&mut self) -> Result<()> {
        let before = self.steps;
        if let Some(cloth) = &mut self.cloth {
            cloth.note_frame_start();
        }
        (0..self.steps_per_frame).for_each(|_| self.step());
        match &self.cloth {
            Some(cloth) if !cloth.is_sound(self.guarded) => {
                Err(locate::error(cloth.at_frame_start(), before, self.steps_per_frame, self.guarded))
            }
            _ => Ok(()),
        }
    }

    /// The first free point whose position rounds away more than a hundredth of what gravity adds
    /// to its displacement in a step, where `time` seconds of it would show.
    pub fn unresolved(&self, time: f64) -> Option<Unresolved> {
        let cloth = self.cloth.as_ref()?;
        let Constants { weight, mass, dt, .. } = cloth.constants;
        for p in cloth.pins.free.iter().cloned().flatten() {
            let point = cloth.grid.column_row(p);
            for (axis, x) in cloth.x.get(p).iter().enumerate() {
                let (g, rounding) = ((weight[axis] / mass).abs(), f64::EPSILON * x.abs());
                let fall = g * dt * dt;
                if g > 0.0 && 0.5 * rounding > 0.01 * fall && 0.5 * g * time * time > rounding {
                    return Some(Unresolved { point, axis, fall, rounding });
                }
            }
        }
        None
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

    /// Where the points were one step ago but for collisions and the stretch limit, in metres.
    pub fn last_positions(&self) -> &Points {
        self.cloth.as_ref().map_or(&self.no_points, |cloth| &cloth.last)
    }

    /// The energies of the cloth, in J; zero without a cloth.
    pub fn energy(&self) -> Energy {
        let Some(cloth) = &self.cloth else { return Energy::default() };
        Energy::new(&cloth.x, &cloth.last, &cloth.springs, &cloth.constants)
    }

    /// The extremes of the cloth; zero without a cloth.
    pub fn extremes(&self) -> Extremes {
        let Some(cloth) = &self.cloth else { return Extremes::default() };
        Extremes::new(&cloth.x, &cloth.last, &cloth.springs, cloth.constants.dt)
    }

    /// Keeps an energy ledger from now on. The cloth moves as without one, to the last bit.
    ///
    /// # Errors
    /// [`Kind::Scene`] when the ledger does not fit in memory.
    pub fn record_ledger(&mut self) -> Result<()> {
        if let Some(cloth) = &mut self.cloth {
            cloth.recorder = Some(Recorder::new(cloth.x.len())?);
        }
        Ok(())
    }

    /// The ledger since [`Simulation::record_ledger`], if it was called and there is a cloth.
    pub fn ledger(&self) -> Option<Ledger> {
        Some(self.cloth.as_ref()?.recorder.as_ref()?.ledger)
    }

    /// A hash over the bits of the whole state: the arrays x, y and z of the positions, then those
    /// of the last positions.
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
        self.counters
    }

    /// Measures from now on how long each phase takes.
    pub fn record_timings(&mut self) {
        self.stopwatch.timings = Some(Timings::default());
    }

    /// How long each phase took since [`Simulation::record_timings`], if it was called.
    pub fn timings(&self) -> Option<Timings> {
        self.stopwatch.timings
    }
}

impl State {
    /// The cloth of `scene` at its start, if there is one.
    fn new(scene: &Scene) -> Result<Option<Self>> {
        let Some(cloth) = &scene.cloth else { return Ok(None) };
        let grid = Grid::new(cloth)?;
        let x = grid::start(cloth, grid)?;
        let springs = Springs::new(cloth, grid, &x)?;
        let constants = Constants::new(cloth, &scene.sim);
        let mut state = Self {
            constants,
            grid,
            pins: Pins::new(cloth, grid)?,
            last: grid::start(cloth, grid)?,
            forces: Forces::new(&springs)?,
            self_collision: SelfCollision::new(cloth, &scene.sim, grid, &x)?,
            neighbors: Neighbors::new(cloth, &scene.sim, &x)?,
            objects: Objects::new(scene),
            outside: Outside::new(scene, &x)?,
            stretch_limit: StretchLimit::new(&scene.sim, &springs)?,
            recorder: None,
            budget: Budget::default(),
            frame_start: [Points::zeros(grid.len())?, Points::zeros(grid.len())?],
            allowance: Allowance::new(scene, cloth, &springs, &constants),
            springs,
            x,
        };
        if scene.sim.start == Start::HalfStep {
            state.start_half_step();
        }
        state.set_budget();
        Ok(Some(state))
    }

    /// Puts the last positions where points at rest would have been one step ago under the forces at
    /// the start: `last = x + f dt² / (2 m)`.
    fn start_half_step(&mut self) {
        let Self { constants, pins, springs, x, last, forces, .. } = self;
        forces.compute(x, springs, constants.weight, &mut Counters::default());
        let half = 0.5 * constants.dt * constants.dt / constants.mass;
        for p in pins.free.iter().cloned().flatten() {
            last.set(p, x.get(p) + forces.sum.get(p) * half);
        }
    }

    /// One step of the method. The phases after Verlet's change positions and never `last`.
    fn step(&mut self, counters: &mut Counters, stopwatch: &mut Stopwatch) {
        let Self { constants, pins, springs, x, last, forces, recorder, .. } = self;
        stopwatch.start();
        if let Some(recorder) = recorder {
            recorder.begin(x, last, springs);
        }

        // 1. Forces: the weight of every point and the pull of every spring.
        forces.compute(x, springs, constants.weight, counters);
        stopwatch.lap(|timings| &mut timings.forces);

        // 2. Verlet: every free point moves on.
        verlet::advance(x, last, &forces.sum, pins, constants, counters);
        stopwatch.lap(|timings| &mut timings.verlet);
        if let Some(recorder) = recorder {
            recorder.advanced(x, last, &forces.sum, springs, pins, constants);
        }
        let mut book = |x: &Points, last: &Points, entry: fn(&mut Ledger) -> &mut f64| {
            if let Some(recorder) = recorder {
                recorder.corrected(x, last, springs, constants, entry);
            }
        };

        // 3. Self-collision: close points of one box move apart.
        if let Some(self_collision) = &mut self.self_collision {
            self_collision.apply(x, pins, counters);
            stopwatch.lap(|timings| &mut timings.self_collision);
            book(x, last, |ledger| &mut ledger.self_collision);
        }
        if let Some(neighbors) = &mut self.neighbors {
            neighbors.apply(x, pins, counters);
            stopwatch.lap(|timings| &mut timings.self_collision);
            book(x, last, |ledger| &mut ledger.self_collision);
        }

        // 4. Objects: points that went through a plane or into a sphere are put back.
        if let Some(objects) = &self.objects {
            objects.collide_planes(x, last, pins, counters);
            book(x, last, |ledger| &mut ledger.planes);
            objects.collide_spheres(x, last, pins, counters);
            stopwatch.lap(|timings| &mut timings.objects);
            book(x, last, |ledger| &mut ledger.spheres);
        }

        // 5. Stretch limit: springs that are too long are shortened.
        if let Some(stretch_limit) = &self.stretch_limit {
            stretch_limit.apply(x, springs, pins, counters);
            stopwatch.lap(|timings| &mut timings.stretch_limit);
            book(x, last, |ledger| &mut ledger.stretch_limit);
        }

        // Where the scene asks for it: points that the phases left inside an object leave it.
        if let Some(outside) = &self.outside {
            outside.leave_planes(x, pins, counters);
            book(x, last, |ledger| &mut ledger.planes);
            outside.leave_spheres(x, pins, counters);
            stopwatch.lap(|timings| &mut timings.objects);
            book(x, last, |ledger| &mut ledger.spheres);
        }
    }
}
