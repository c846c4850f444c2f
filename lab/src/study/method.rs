//! The methods that a study compares, and the model that all of them approach.

/// A way to move the cloth: a name, and what it changes in the model.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Method {
    /// Short name.
    pub name: &'static str,
    /// The changes, as `--set` takes them, after those of [`MODEL`].
    pub sets: &'static [&'static str],
    /// Steps per second, multiples of 10. Empty for a method with a largest stable step, which is run at
    /// multiples of its stable rate.
    #[serde(skip)]
    pub(super) rates: &'static [u32],
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

/// The methods; the first is also the reference's.
pub const METHODS: &[Method] = &[
    Method { name: "Verlet, half-step start", sets: &[], rates: &[] },
    Method { name: "Verlet, report start", sets: &["sim.start=report"], rates: &[] },
    Method { name: "Verlet, damping per step", sets: &["sim.damping=per_step"], rates: &[] },
    Method { name: "Verlet, stretch limit", sets: &["sim.stretch_limit=0.1"], rates: &[] },
    Method {
        name: "as published",
        sets: &[
            "sim.start=report",
            "sim.damping=per_step",
            "sim.stretch_limit=0.1",
            "sim.self_collision=same_box",
        ],
        rates: &[],
    },
    Method { name: "Verlet, f32", sets: &["sim.precision=f32"], rates: &[] },
    Method {
        name: "XPBD, 1 pass",
        sets: &["sim.integrator=xpbd", "sim.start=report", "sim.iterations=1"],
        rates: &[60, 120, 300, 600, 1200, 2700, 8100],
    },
    Method {
        name: "XPBD, 10 passes",
        sets: &["sim.integrator=xpbd", "sim.start=report", "sim.iterations=10"],
        rates: &[60, 120, 300, 600],
    },
    Method {
        name: "implicit Euler",
        sets: &["sim.integrator=implicit_euler", "sim.start=report"],
        rates: LARGE_STEPS,
    },
    Method {
        name: "implicit Euler, loose",
        sets: &["sim.integrator=implicit_euler", "sim.start=report", "sim.tolerance=0.01"],
        rates: LARGE_STEPS,
    },
    Method { name: "BDF2", sets: &["sim.integrator=bdf2", "sim.start=report"], rates: LARGE_STEPS },
    Method {
        name: "BDF2, loose",
        sets: &["sim.integrator=bdf2", "sim.start=report", "sim.tolerance=0.01"],
        rates: LARGE_STEPS,
    },
];

/// Steps per second of the implicit methods, which no bound limits from below.
const LARGE_STEPS: &[u32] = &[30, 60, 120, 300, 600];

/// A run in words, such as `BDF2 at 600 steps/s`.
pub(super) fn run_name(method: usize, rate: u32) -> String {
    let method = METHODS.get(method).map_or("", |method| method.name);
    format!("{method} at {rate} steps/s")
}
