//! The methods that a study compares, and the model that all of them approach.

use std::sync::LazyLock;

use drape::scene::Integrator;

/// A way to move the cloth: a name, and what it changes in the model.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Method {
    /// Short name.
    pub name: &'static str,
    /// The changes, as `--set` takes them, after those of [`MODEL`].
    pub sets: Vec<String>,
    #[serde(skip)]
    pub(super) rates: Rates,
}

/// The steps per second that a method is run at, multiples of 10.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Rates {
    /// Multiples of the rate that is stable under Verlet's scheme.
    OfVerlet,
    /// Multiples of the rate that is stable under the integrator of the method; [`LARGE_STEPS`] if all are.
    OfIntegrator,
    /// These.
    Given(&'static [u32]),
}

/// The changes that turn a scene into the differential equation that every method approaches. What they
/// switch off has no limit as the step shrinks: the stretch limit moves springs a little further in every
/// step, damping per step grows with the number of steps, and the cells of self-collision depend on
/// rounding.
pub const MODEL: [&str; 6] = [
    "sim.integrator=verlet",
    "sim.precision=f64",
    "sim.start=half_step",
    "sim.damping=per_second",
    "sim.stretch_limit=null",
    "sim.self_collision=off",
];

/// The chosen methods; the first is also the reference's. An integrator that none of them has is run with its
/// defaults, under its own name.
const CHOSEN: &[(&str, &[&str], Rates)] = &[
    ("Verlet, half-step start", &[], Rates::OfVerlet),
    ("Verlet, report start", &["sim.start=report"], Rates::OfVerlet),
    ("Verlet, damping per step", &["sim.damping=per_step"], Rates::OfVerlet),
    ("Verlet, stretch limit", &["sim.stretch_limit=0.1"], Rates::OfVerlet),
    (
        "as published",
        &["sim.start=report", "sim.damping=per_step", "sim.stretch_limit=0.1", "sim.self_collision=same_box"],
        Rates::OfVerlet,
    ),
    ("Verlet, f32", &["sim.precision=f32"], Rates::OfVerlet),
    (
        "XPBD, 1 pass",
        &["sim.integrator=xpbd", "sim.start=report", "sim.iterations=1"],
        Rates::Given(&[60, 120, 300, 600, 1200, 2700, 8100]),
    ),
    (
        "XPBD, 10 passes",
        &["sim.integrator=xpbd", "sim.start=report", "sim.iterations=10"],
        Rates::Given(&[60, 120, 300, 600]),
    ),
    ("implicit Euler", &["sim.integrator=implicit_euler", "sim.start=report"], Rates::Given(LARGE_STEPS)),
    (
        "implicit Euler, loose",
        &["sim.integrator=implicit_euler", "sim.start=report", "sim.tolerance=0.01"],
        Rates::Given(LARGE_STEPS),
    ),
    ("BDF2", &["sim.integrator=bdf2", "sim.start=report"], Rates::Given(LARGE_STEPS)),
    (
        "BDF2, loose",
        &["sim.integrator=bdf2", "sim.start=report", "sim.tolerance=0.01"],
        Rates::Given(LARGE_STEPS),
    ),
];

/// All methods: the chosen ones, then the integrators that none of them has.
pub static METHODS: LazyLock<Vec<Method>> = LazyLock::new(|| {
    let owned = |sets: &[&str]| sets.iter().map(ToString::to_string).collect();
    let chosen = CHOSEN.iter().map(|&(name, sets, rates)| Method { name, sets: owned(sets), rates });
    let set_of = |(name, _): &(&str, Integrator)| format!("sim.integrator={name}");
    let is_other = |row: &&(&'static str, Integrator)| {
        let set = set_of(row);
        !MODEL.iter().chain(CHOSEN.iter().flat_map(|(_, sets, _)| *sets)).any(|chosen| *chosen == set)
    };
    let others = Integrator::NAMES.iter().filter(is_other).map(|row| Method {
        name: row.0,
        sets: vec![set_of(row), "sim.start=report".to_owned()],
        rates: Rates::OfIntegrator,
    });
    chosen.chain(others).collect()
});

/// Steps per second of methods that are stable at every step.
pub(super) const LARGE_STEPS: &[u32] = &[30, 60, 120, 300, 600];

/// A run in words, such as `BDF2 at 600 steps/s`.
pub(super) fn run_name(method: usize, rate: u32) -> String {
    let method = METHODS.get(method).map_or("", |method| method.name);
    format!("{method} at {rate} steps/s")
}
