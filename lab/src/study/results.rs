//! The results as numbers: one JSON object, and a table with a row for each cell.

use serde::Serialize;

use super::findings::{Cost, PanelStudy, Study};
use super::method::{METHODS, Method};
use super::pareto::{Advice, advice, front};
use super::pictures::{Drawn, Pictures};
use super::reference::Difference;
use super::runs::Measured;
use crate::csv::Csv;
use crate::page::short;
use drape::version::VERSION;

/// `results.json`
#[derive(Serialize)]
pub struct Results<'a> {
    version: &'static str,
    scene: &'a str,
    threads: usize,
    runs_made: u64,
    runs_kept: u64,
    /// The moments at which positions are compared, in seconds.
    times: Vec<f64>,
    /// The changes that turn the scene into the model.
    model: Vec<&'static str>,
    /// Keys of `sim` that the model keeps although they have no limit as the step shrinks.
    without_limit: &'a [&'static str],
    methods: &'static [Method],
    panels: Vec<PanelResults<'a>>,
    /// Stiffnesses over mass, in 1/s², whose reference would take too long.
    left_out: &'a [f64],
    pictures: Option<PictureResults<'a>>,
}

#[derive(Serialize)]
struct PanelResults<'a> {
    density: f64,
    /// The cloth compared with the scene's.
    cloth: String,
    k_over_m: f64,
    stable_rate: f64,
    reference_rates: [u32; 2],
    /// The difference of the last two runs of the reference.
    floor: &'a [Difference],
    /// The moment of the front and the advice, in seconds.
    time: f64,
    cells: Vec<CellResults<'a>>,
    /// The Pareto front by wall time.
    hull: Vec<String>,
    /// The Pareto front by springs visited, which is the same on every machine.
    hull_counted: Vec<String>,
    advice: Vec<Choice>,
}

#[derive(Serialize)]
struct CellResults<'a> {
    name: String,
    wall: f64,
    /// For each moment, whether the error can be distinguished from that of the reference.
    compared: Vec<bool>,
    #[serde(flatten)]
    measured: &'a Measured,
}

#[derive(Serialize)]
struct PictureResults<'a> {
    width: u32,
    height: u32,
    floor: f64,
    ways: Vec<WayResults<'a>>,
    /// The Pareto front.
    hull: Vec<String>,
    advice: Vec<Choice>,
}

#[derive(Serialize)]
struct WayResults<'a> {
    name: String,
    ms: f64,
    #[serde(flatten)]
    drawn: &'a Drawn,
}

/// The best choice within a budget.
#[derive(Serialize)]
struct Choice {
    budget: f64,
    #[serde(rename = "use")]
    choice: String,
    cost: f64,
    error: f64,
    /// Whether `error` is only a bound, since it cannot be distinguished from that of the reference.
    at_most: bool,
}

impl<'a> Results<'a> {
    /// The results of `study` of the scene called `scene`; the counts are those of [`crate::store::Store::counts`].
    pub fn new(study: &'a Study, scene: &'a str, [runs_made, runs_kept]: [u64; 2]) -> Self {
        Self {
            version: VERSION,
            scene,
            threads: rayon::current_num_threads(),
            runs_made,
            runs_kept,
            times: study.extent.tenths.iter().map(|&tenth| f64::from(tenth) / 10.0).collect(),
            model: study.extent.model(),
            without_limit: &study.extent.kept,
            methods: &METHODS,
            panels: study.panels.iter().map(PanelResults::new).collect(),
            left_out: &study.left_out,
            pictures: study.pictures.as_ref().map(PictureResults::new),
        }
    }

    /// The advice as lines of text.
    pub fn text(&self) -> String {
        let mut text = kept(self.without_limit).map_or_else(String::new, |note| note + "\n");
        for panel in &self.panels {
            text += &format!(
                "k/m {:.2e} /s² ({}: {} kg/m²), wall time per simulated second and error at {} s:\n",
                panel.k_over_m,
                panel.cloth,
                short(panel.density),
                panel.time
            );
            text += &lines(&panel.advice, "s", "m");
        }
        if let Some(pictures) = &self.pictures {
            text +=
                &format!("pictures of {} x {}, time to draw and error:\n", pictures.width, pictures.height);
            text += &lines(&pictures.advice, "ms", "of 255");
        }
        text
    }
}

/// What an error means under a model that keeps these keys of `sim`, if it does.
pub(super) fn kept(keys: &[&str]) -> Option<String> {
    let keys: Vec<String> = keys.iter().map(|key| format!("sim.{key}")).collect();
    (!keys.is_empty()).then(|| {
        format!(
            "the model keeps {}, which acts once a step and may have no limit: an error is the distance from the finest run, and \
             the floor says how far that can be trusted",
            keys.join(" and ")
        )
    })
}

fn lines(choices: &[Choice], cost: &str, error: &str) -> String {
    let line = |choice: &Choice| {
        let Choice { budget, choice, cost: paid, error: wrong, at_most } = choice;
        let at_most = if *at_most { "at most " } else { "" };
        format!("  for {budget} {cost}: {choice}: {at_most}{wrong:.2e} {error} ({paid:.3} {cost})\n")
    };
    choices.iter().map(line).collect()
}

fn choices(advice: &[Advice], points: &[[f64; 2]], of: impl Fn(usize) -> (String, bool)) -> Vec<Choice> {
    let choice = |&Advice { budget, use_point }: &Advice| {
        let [cost, error] = points[use_point];
        let (choice, at_most) = of(use_point);
        Choice { budget, choice, cost, error, at_most }
    };
    advice.iter().map(choice).collect()
}

impl<'a> PanelResults<'a> {
    fn new(study: &'a PanelStudy) -> Self {
        let PanelStudy { panel, reference, cells } = study;
        let named = |cells: Vec<usize>| cells.into_iter().map(|i| study.name(i)).collect();
        Self {
            density: panel.density,
            cloth: panel.cloth(),
            k_over_m: panel.k_over_m,
            stable_rate: panel.stable_rate,
            reference_rates: reference.rates,
            floor: &reference.floor,
            time: reference.floor.get(study.moment()).map_or(0.0, |floor| floor.time),
            cells: cells.iter().enumerate().map(|(i, cell)| CellResults::new(study, i, cell)).collect(),
            hull: named(study.front(Cost::Wall)),
            hull_counted: named(study.front(Cost::Springs)),
            advice: choices(&study.advice(), &study.points(Cost::Wall), |i| {
                (study.name(i), !study.is_distinct(i))
            }),
        }
    }
}

impl<'a> CellResults<'a> {
    fn new(study: &PanelStudy, number: usize, measured: &'a Measured) -> Self {
        let compared = (0..measured.errors.len()).map(|moment| study.is_compared(measured, moment)).collect();
        Self { name: study.name(number), wall: measured.wall(), compared, measured }
    }
}

impl<'a> PictureResults<'a> {
    fn new(pictures: &'a Pictures) -> Self {
        let points = pictures.points();
        let name = |i: usize| pictures.drawn[i].way.text();
        let [width, height] = pictures.size();
        Self {
            width,
            height,
            floor: pictures.floor,
            ways: pictures.drawn.iter().map(WayResults::new).collect(),
            hull: front(&points).into_iter().map(name).collect(),
            advice: choices(&advice(&points), &points, |i| (name(i), false)),
        }
    }
}

impl<'a> WayResults<'a> {
    fn new(drawn: &'a Drawn) -> Self {
        Self { name: drawn.way.text(), ms: drawn.ms(), drawn }
    }
}

/// `results.csv`: a row for each cell; errors in metres, empty where a cell was lost.
pub fn csv(study: &Study) -> String {
    let times: Vec<f64> = study.extent.tenths.iter().map(|&tenth| f64::from(tenth) / 10.0).collect();
    let mut names: Vec<String> =
        ["method", "outcome", "k_over_m", "steps_per_second", "wall", "springs", "drift", "stretch"]
            .map(str::to_owned)
            .into();
    names.extend(times.iter().flat_map(|time| ["rms", "max", "floor"].map(|what| format!("{what}_{time}"))));
    let mut csv = Csv::new(&names.iter().map(String::as_str).collect::<Vec<_>>());
    for panel in &study.panels {
        for cell in &panel.cells {
            let drift = cell.drift.unwrap_or(f64::NAN);
            let first =
                [panel.panel.k_over_m, f64::from(cell.rate), cell.wall(), cell.springs, drift, cell.stretch];
            let errors = panel.reference.floor.iter().enumerate().flat_map(|(moment, floor)| {
                let error = cell.errors.get(moment);
                [error.map_or(f64::NAN, |e| e.rms), error.map_or(f64::NAN, |e| e.max), floor.rms]
            });
            let method = METHODS.get(cell.method).map_or("", |method| method.name);
            csv.labelled_row(&[method, cell.outcome.text()], first.into_iter().chain(errors));
        }
    }
    csv.text().to_owned()
}
