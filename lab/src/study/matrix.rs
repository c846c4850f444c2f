//! The matrix of runs: method × steps per second × stiffness.

use std::path::PathBuf;
use std::sync::LazyLock;

use drape::cloth::Params;
use drape::diagnostics::stability::Stability;
use drape::error::{Error, Kind, Result};
use drape::scene::{self, Cloth, Integrator, Overrides, Scene};

/// How a cloth can be moved: a name, and what it changes in the model.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Method {
    /// Short name.
    pub name: &'static str,
    /// The changes, as `--set` takes them, after those of [`MODEL`].
    pub sets: Vec<String>,
    #[serde(skip)]
    rates: Rates,
}

/// The steps per second that a method is run at, in whole tens.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Rates {
    /// Multiples of the rate that is stable under Verlet's scheme.
    OfVerlet,
    /// Multiples of the rate that is stable under the integrator of the method; [`LARGE_STEPS`] if all are.
    OfIntegrator,
    /// These.
    Given(&'static [u32]),
}

/// The differential equation that every method approaches: what else a scene asks for has no limit
/// as the step shrinks (the stretch limit moves springs a little further in every step, damping
/// per step grows with the number of steps, and cells of self-collision depend on rounding).
pub const MODEL: [&str; 6] = [
    "sim.integrator=verlet",
    "sim.precision=f64",
    "sim.start=half_step",
    "sim.damping=per_second",
    "sim.stretch_limit=null",
    "sim.self_collision=off",
];

/// The methods; the first is also the reference's. An integrator that none of these has is run with its
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

/// Every method.
pub static METHODS: LazyLock<Vec<Method>> = LazyLock::new(|| {
    let owned = |sets: &[&str]| sets.iter().map(ToString::to_string).collect();
    let chosen = CHOSEN.iter().map(|&(name, sets, rates)| Method { name, sets: owned(sets), rates });
    let set_of = |(name, _): &(&str, Integrator)| format!("sim.integrator={name}");
    let is_left = |row: &&(&'static str, Integrator)| {
        let set = set_of(row);
        !MODEL.iter().chain(CHOSEN.iter().flat_map(|(_, sets, _)| *sets)).any(|chosen| *chosen == set)
    };
    let left = Integrator::NAMES.iter().filter(is_left).map(|row| Method {
        name: row.0,
        sets: vec![set_of(row), "sim.start=report".to_owned()],
        rates: Rates::OfIntegrator,
    });
    chosen.chain(left).collect()
});

/// Steps per second of methods that are stable at every step.
const LARGE_STEPS: &[u32] = &[30, 60, 120, 300, 600];

/// A scene file and changes to it, loaded anew for each cell of the matrix.
#[derive(Clone, Debug)]
pub struct Source {
    /// The scene file.
    pub path: PathBuf,
    /// Changes from outside, before those of the cells.
    pub overrides: Overrides,
}

impl Source {
    /// The scene with `sets` as the last changes.
    ///
    /// # Errors
    /// As [`scene::load`].
    pub fn scene(&self, sets: &[String]) -> Result<Scene> {
        let mut overrides = self.overrides.clone();
        overrides.sets.extend_from_slice(sets);
        Ok(scene::load(&self.path, &overrides)?.scene)
    }
}

/// How much is run.
#[derive(Clone, Debug, PartialEq)]
pub struct Extent {
    /// When positions are compared, in tenths of a second, ascending.
    pub tenths: Vec<u32>,
    /// Parts of the scene's density: each is a panel of another stiffness over mass.
    pub densities: Vec<f64>,
    /// Steps per second as multiples of the stable rate.
    pub rates: Vec<f64>,
    /// Most springs to be visited in one run; cells that are known to need more are left out.
    pub most_springs: f64,
    /// Most springs to be computed in one run of a reference.
    pub most_reference: f64,
    /// How often each run is timed.
    pub repeats: usize,
    /// Wall time after which a run is not repeated, in seconds.
    pub patience: f64,
    /// Width of the pictures in pixels.
    pub picture_width: u32,
    /// Latitude counts of drawn spheres; longitudes are as many.
    pub resolutions: Vec<u32>,
    /// Parts of the names of the runs to make, as [`Panel::name`] has them, or their integrators, and no pictures;
    /// if none, all.
    pub only: Vec<String>,
}

impl Extent {
    /// The full study: under 20 minutes for a cloth of 50 × 50 points on two cores.
    pub fn full() -> Self {
        Self {
            tenths: vec![1, 2, 5],
            densities: vec![1.0, 1e-3, 1e-5],
            rates: vec![0.5, 0.9, 1.02, 1.5, 2.0, 4.0, 8.0],
            most_springs: 3e9,
            most_reference: 5e10,
            repeats: 3,
            patience: 6.0,
            picture_width: 512,
            resolutions: vec![16, 40, 128],
            only: Vec::new(),
        }
    }

    /// A small one: under two minutes for the same.
    pub fn quick() -> Self {
        Self {
            tenths: vec![1, 2],
            densities: vec![1.0, 1e-3],
            rates: vec![0.5, 1.02, 2.0],
            most_springs: 2e8,
            most_reference: 1e10,
            repeats: 3,
            patience: 1.5,
            picture_width: 256,
            resolutions: vec![16, 128],
            only: Vec::new(),
        }
    }

    /// The last moment, in tenths of a second.
    pub fn last(&self) -> u32 {
        self.tenths.last().copied().unwrap_or(0)
    }
}

/// The cells of one stiffness.
#[derive(Clone, Debug)]
pub struct Panel {
    /// Mass per area, in kg/m².
    pub density: f64,
    /// The same as a part of the scene's.
    pub part: f64,
    /// Stiffness of a structural spring over the mass of a point, in 1/s².
    pub k_over_m: f64,
    /// Steps per second that are stable at worst, in every shape of the cloth.
    pub stable_rate: f64,
    /// The cells, method by method, in order of their steps.
    pub cells: Vec<Cell>,
    /// Steps per second of the reference's first run: the most of any cell, also of those not asked for.
    pub finest: u32,
    /// Changes that make the reference of the scene, but for its steps.
    pub sets: Vec<String>,
}

/// One run of the matrix.
#[derive(Clone, Debug)]
pub struct Cell {
    /// Number of the method in [`METHODS`].
    pub method: usize,
    /// Steps per second.
    pub rate: u32,
    /// The scene to run.
    pub scene: Scene,
}

impl Panel {
    /// What a cell is called, such as `k/m 8.33e4: BDF2 at 600 steps/s`.
    pub fn name(&self, cell: &Cell) -> String {
        format!("k/m {:.2e}: {}", self.k_over_m, run_name(cell.method, cell.rate))
    }

    /// Which cloth it is, against the scene's: `the scene's cloth`, or `1/1000 of the scene's density`.
    pub fn cloth(&self) -> String {
        if self.part == 1.0 {
            return "the scene's cloth".to_owned();
        }
        format!("1/{:.0} of the scene's density", 1.0 / self.part)
    }

    /// Whether a cell is asked for by `text`: a part of its name, however written, or its integrator.
    fn is_called(&self, cell: &Cell, text: &str) -> bool {
        let text = text.to_lowercase();
        self.name(cell).to_lowercase().contains(&text) || cell.scene.sim.integrator.name() == text
    }
}

/// A run in words, such as `BDF2 at 600 steps/s`.
pub(super) fn run_name(method: usize, rate: u32) -> String {
    let method = METHODS.get(method).map_or("", |method| method.name);
    format!("{method} at {rate} steps/s")
}

/// The panels of `source`; those whose reference would take too long have no cells. Where only some
/// runs are asked for, panels without any of them are absent.
///
/// # Errors
/// [`Kind::Nothing`] when the scene has no cloth, [`Kind::Usage`] when no run is called as asked;
/// otherwise as [`Source::scene`].
pub fn panels(source: &Source, extent: &Extent) -> Result<Vec<Panel>> {
    let scene = source.scene(&[])?;
    let Some(cloth) = &scene.cloth else {
        return Err(Error::new(Kind::Nothing, "the scene has no cloth to be studied"));
    };
    let panels =
        extent.densities.iter().map(|part| panel(source, &scene, [cloth.density * part, *part], extent));
    let mut panels = panels.collect::<Result<Vec<_>>>()?;
    if extent.only.is_empty() {
        return Ok(panels);
    }
    let names = known(&panels);
    for panel in &mut panels {
        let is_asked = |cell: &Cell| extent.only.iter().any(|text| panel.is_called(cell, text));
        panel.cells = panel.cells.iter().filter(|cell| is_asked(cell)).cloned().collect();
    }
    panels.retain(|panel| !panel.cells.is_empty());
    if panels.is_empty() {
        let error = Error::new(Kind::Usage, format!("no run is called `{}`", extent.only.join("` or `")));
        return Err(error.with_help(names));
    }
    Ok(panels)
}

/// What the runs of `panels` can be asked for by.
fn known(panels: &[Panel]) -> String {
    let stiffness = panels.iter().map(|panel| format!("`k/m {:.2e}`", panel.k_over_m));
    let methods: Vec<_> = METHODS.iter().map(|method| format!("`{}`", method.name)).collect();
    let integrators: Vec<_> = Integrator::NAMES.iter().map(|(name, _)| format!("`{name}`")).collect();
    let example = panels.iter().find_map(|panel| Some(panel.name(panel.cells.last()?)));
    format!(
        "the stiffnesses of this scene are {}; the methods are {}; a whole name is such as `{}`; the integrators are {}",
        stiffness.collect::<Vec<_>>().join(", "),
        methods.join(", "),
        example.unwrap_or_default(),
        integrators.join(", "),
    )
}

/// The panel of the density that is this `part` of the scene's.
fn panel(source: &Source, stock: &Scene, [density, part]: [f64; 2], extent: &Extent) -> Result<Panel> {
    let mut sets: Vec<String> = MODEL.iter().map(ToString::to_string).collect();
    sets.push(format!("cloth.density={density:?}"));
    let scene = source.scene(&sets)?;
    let Some(cloth) = &scene.cloth else {
        return Err(Error::new(Kind::Internal, "the cloth is gone"));
    };
    let mass = Params::new(cloth, &scene.sim).mass;
    let Stability { omega_safe, limit_worst, .. } = Stability::new(cloth, &scene.sim)?;
    let stable_rate = (omega_safe / limit_worst).max(50.0);
    let rates = rates_around(stock, stable_rate, cloth, extent);
    let mut panel = Panel {
        density,
        part,
        k_over_m: cloth.ks / mass,
        stable_rate,
        cells: Vec::new(),
        finest: rates.last().copied().unwrap_or(0),
        sets,
    };
    if f64::from(panel.finest) < stable_rate
        || springs_in(cloth, panel.finest, extent) * 16.0 > extent.most_reference
    {
        return Ok(panel);
    }
    for (number, method) in METHODS.iter().enumerate() {
        let changed =
            |more: &[String]| source.scene(&[panel.sets.as_slice(), method.sets.as_slice(), more].concat());
        let own = match method.rates {
            Rates::OfVerlet => rates.clone(),
            Rates::Given(rates) => rates.to_vec(),
            Rates::OfIntegrator => match Stability::of_bounded(cloth, &changed(&[])?.sim)? {
                Some(own) => rates_around(stock, own.omega_safe / own.limit_worst, cloth, extent),
                None => LARGE_STEPS.to_vec(),
            },
        };
        for rate in own {
            let scene = changed(&clock(stock.sim.fps, rate))?;
            panel.cells.push(Cell { method: number, rate, scene });
        }
    }
    Ok(panel)
}

/// Springs that a run of `rate` steps per second computes: about six for each point and step.
fn springs_in(cloth: &Cloth, rate: u32, extent: &Extent) -> f64 {
    let points = (cloth.num_width_points * cloth.num_height_points) as f64;
    6.0 * points * f64::from(rate) * 0.1 * f64::from(extent.last())
}

/// Steps per second around the stable rate and the scene's own, ascending; all are whole tens, and
/// multiples of the scene's frames where those are.
fn rates_around(stock: &Scene, stable: f64, cloth: &Cloth, extent: &Extent) -> Vec<u32> {
    let quantum = quantum(stock.sim.fps);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "above 0; saturates")]
    let rounded = |rate: f64| ((rate / f64::from(quantum)).ceil() as u32).saturating_mul(quantum);
    let own = stock.sim.fps * f64::from(stock.sim.steps_per_frame);
    let mut rates: Vec<u32> = extent.rates.iter().map(|part| rounded(part * stable)).collect();
    rates.extend(Some(rounded(own)).filter(|&rate| f64::from(rate) == own));
    rates.retain(|&rate| springs_in(cloth, rate, extent) <= extent.most_springs);
    rates.sort_unstable();
    rates.dedup();
    rates
}

/// What steps per second are a multiple of: the frames per second if those are whole tens, else 10.
fn quantum(fps: f64) -> u32 {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at most 1000")]
    if (10.0..=1000.0).contains(&fps) && fps % 10.0 == 0.0 { fps as u32 } else { 10 }
}

/// The changes that make a scene of `fps` frames per second run at `rate` steps per second.
pub(super) fn clock(fps: f64, rate: u32) -> [String; 2] {
    let frames = Some(quantum(fps)).filter(|frames| rate.is_multiple_of(*frames)).unwrap_or(10);
    [format!("sim.fps={frames}"), format!("sim.steps_per_frame={}", rate / frames)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rates_are_whole_tens_and_keep_the_frames_of_the_scene() {
        assert_eq!(clock(90.0, 2700), ["sim.fps=90", "sim.steps_per_frame=30"]);
        assert_eq!(clock(90.0, 60), ["sim.fps=10", "sim.steps_per_frame=6"]);
        assert_eq!(clock(24.0, 240), ["sim.fps=10", "sim.steps_per_frame=24"]);
    }
}
