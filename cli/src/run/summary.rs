//! The summary of a simulation: what was run, where the cloth is, and how far that can be trusted.

use serde::Serialize;
use serde_json::{Map, Value};

use super::advance::Rest;
use drape::cloth::{Counters, springs};
use drape::diagnostics::energy::Energy;
use drape::diagnostics::ledger::Ledger;
use drape::diagnostics::rest::QUIET;
use drape::scene::{Scene, Sim};
use drape::simulation::Simulation;
use drape_lab::choose::OwnError;

/// The summary.
#[derive(Serialize)]
pub(crate) struct Summary {
    frames: u64,
    time: f64,
    points: usize,
    springs: usize,
    state_hash: String,
    /// The keys of `sim` of the scene that was run.
    settings: Map<String, Value>,
    /// The same in words.
    #[serde(skip)]
    in_words: String,
    counters: Counters,
    /// The energies at the end, in J.
    energy: Energy,
    /// The energy that each phase added over the run, in J, if a ledger was recorded.
    #[serde(skip_serializing_if = "Option::is_none")]
    ledger: Option<Ledger>,
    /// Where the points are, if there are any.
    #[serde(skip_serializing_if = "Option::is_none")]
    heights: Option<Heights>,
    /// Largest length of a spring over its rest length; 0 without springs.
    largest_stretch: f64,
    /// What the stretch limit left, if the scene has one.
    #[serde(skip_serializing_if = "Option::is_none")]
    stretch: Option<Stretch>,
    /// Whether the cloth was seen at rest; a run from a state does not know what was before it.
    at_rest: bool,
    /// The figures of the rest, if it is.
    #[serde(skip_serializing_if = "Option::is_none")]
    rest: Option<Rest>,
    /// How wrong the positions are, if asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    error: Option<OwnError>,
    /// The state hash of each frame from 0, if asked for.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    hashes: Vec<String>,
}

/// What was seen while the simulation ran, and after it.
pub(crate) struct Seen {
    pub(crate) rest: Option<Rest>,
    pub(crate) hashes: Vec<String>,
    /// The heights of the points at the start of the scene, in metres.
    pub(crate) heights: Vec<f64>,
    /// Springs that the stretch limit shortened in the last frame.
    pub(crate) limited: u64,
    pub(crate) error: Option<OwnError>,
}

/// Heights of the points, in metres.
#[derive(Clone, Copy, Serialize)]
struct Heights {
    lowest: f64,
    mean: f64,
    highest: f64,
    /// The most that a point is below its height at the start of the scene.
    sag: f64,
}

/// What the stretch limit left at the end.
#[derive(Clone, Copy, Serialize)]
struct Stretch {
    /// Largest length of a spring over its rest length.
    largest: f64,
    /// The same at the limit.
    limit: f64,
    /// Springs that the limit shortened in each step of the last frame.
    shortened_per_step: f64,
}

impl Heights {
    /// Of points that are at `now` and were at `before`.
    fn of(now: &[f64], before: &[f64]) -> Option<Self> {
        let most = |values: &mut dyn Iterator<Item = f64>| values.fold(f64::NEG_INFINITY, f64::max);
        (!now.is_empty()).then(|| Self {
            lowest: now.iter().copied().fold(f64::INFINITY, f64::min),
            mean: now.iter().sum::<f64>() / now.len() as f64,
            highest: most(&mut now.iter().copied()),
            sag: most(&mut before.iter().zip(now).map(|(before, now)| before - now)).max(0.0),
        })
    }

    /// A line of the summary.
    fn text(self) -> String {
        let Self { lowest, mean, highest, sag } = self;
        format!(
            "heights      lowest {lowest:.6} m, mean {mean:.6} m, highest {highest:.6} m; a point sagged by {sag:.6} m\n"
        )
    }
}

impl Stretch {
    /// Of a scene with a stretch limit, which shortened so many springs in the last frame.
    fn of(simulation: &Simulation, scene: &Scene, limited: u64) -> Option<Self> {
        let limit = 1.0 + scene.needed_stretch_limit()?;
        #[expect(clippy::cast_precision_loss, reason = "a number of springs is far below 2^53")]
        let shortened_per_step = limited as f64 / f64::from(scene.sim.steps_per_frame);
        Some(Self { largest: simulation.largest_stretch(), limit, shortened_per_step })
    }

    /// Lines of the summary: nothing where the limit holds and has nothing to do.
    fn text(&self) -> String {
        let Self { largest, limit, shortened_per_step } = *self;
        let beyond = if largest > limit + 1e-3 {
            format!(
                "stretch      {:.1} % at most: the limit of {:.1} % did not hold; more sim.stretch_passes or steps do\n",
                100.0 * (largest - 1.0),
                100.0 * (limit - 1.0)
            )
        } else {
            String::new()
        };
        let carried = if shortened_per_step >= 1.0 {
            format!(
                "stretch      {shortened_per_step:.1} springs a step were at the limit at the end: there the sag is the \
                 limit's, not ks's\n"
            )
        } else {
            String::new()
        };
        beyond + &carried
    }
}

impl Summary {
    /// Of `simulation` at its end.
    pub(crate) fn new(simulation: &Simulation, scene: &Scene, seen: Seen) -> Self {
        Self {
            frames: simulation.frame(),
            time: simulation.time(),
            points: simulation.positions().len(),
            springs: springs_of(scene),
            state_hash: hex(simulation.state_hash()),
            settings: settings(scene),
            in_words: in_words(&scene.sim),
            counters: simulation.counters(),
            energy: simulation.energy(),
            ledger: simulation.ledger(),
            heights: Heights::of(&simulation.positions().y, &seen.heights),
            largest_stretch: simulation.largest_stretch(),
            stretch: Stretch::of(simulation, scene, seen.limited),
            at_rest: seen.rest.is_some() || scene.cloth.is_none(),
            rest: seen.rest,
            error: seen.error,
            hashes: seen.hashes,
        }
    }

    /// Lines of the summary.
    pub(crate) fn text(&self) -> String {
        let Self { frames, time, points, springs, state_hash, counters, energy, .. } = self;
        let Energy { kinetic, spring, gravitational } = energy;
        let entries = self.ledger.map(Ledger::entries).into_iter().flatten();
        let ledger: String =
            entries.map(|(name, joule)| format!("  by {name:15} {joule:+.6e} J\n")).collect();
        let mut text = format!("settings     {}\n", self.in_words);
        text += &format!(
            "frames       {frames}\nsteps        {}\ntime         {time} s\npoints       {points}\n\
             springs      {springs}\ncollisions   {} with objects, {} of the cloth with itself\n\
             shortened    {} springs\nenergy       {:.6e} J = kinetic {kinetic:.6e}, spring {spring:.6e}, \
             gravitational {gravitational:.6e}\n{ledger}",
            counters.steps,
            counters.object_moves,
            counters.self_collision_moves,
            counters.springs_limited,
            energy.total(),
        );
        if let Some(heights) = self.heights {
            text += &heights.text();
            text += &format!("longest      spring {:.6} of its rest length\n", self.largest_stretch);
            text.extend(self.stretch.map(|stretch| stretch.text()));
            text += &self
                .rest
                .map_or_else(|| format!("rest         not seen for {QUIET} s\n"), |rest| rest.text());
        }
        text.extend(self.error.map(|error| format!("error        {}\n", error.text())));
        text + &format!("state hash   {state_hash}\n")
    }
}

/// The number of springs of a scene's cloth.
pub(crate) fn springs_of(scene: &Scene) -> usize {
    scene.cloth.as_ref().map_or(0, |cloth| springs::counts(cloth).iter().sum())
}

/// The keys of `sim` with their values.
fn settings(scene: &Scene) -> Map<String, Value> {
    let of_sim = |(path, value): (String, Value)| Some((path.strip_prefix("sim.")?.to_owned(), value));
    scene.motion().into_iter().filter_map(of_sim).collect()
}

/// The keys of `sim` in words.
fn in_words(sim: &Sim) -> String {
    let limit = sim
        .stretch_limit
        .map_or_else(|| "no stretch limit".to_owned(), |limit| format!("stretch limit {} %", 100.0 * limit));
    format!(
        "{}, {} steps in each of {} frames a second, {}; start {}, damping {}, contact {}, self-collision {}, {limit}",
        sim.integrator.name(),
        sim.steps_per_frame,
        sim.fps,
        sim.precision.name(),
        sim.start.name(),
        sim.damping.name(),
        sim.contact.name(),
        sim.self_collision.name(),
    )
}

/// A hash as it is printed.
pub(crate) fn hex(hash: u64) -> String {
    format!("{hash:016x}")
}
