//! The results as numbers: one JSON object, and a table with a row for each cell.

use serde::Serialize;

use super::hull::{Advice, advice, hull};
use super::matrix::{METHODS, MODEL, Method};
use super::pictures::Drawn;
use super::reference::Difference;
use super::runs::Measured;
use super::{Cost, PanelStudy, Study};
use crate::csv::Csv;
use crate::page::short;

/// `results.json`
#[derive(Serialize)]
pub struct Results<'a> {
    version: &'static str,
    scene: &'a str,
    threads: usize,
    runs_made: u64,
    runs_kept: u64,
    /// When positions are compared, in seconds.
    times: Vec<f64>,
    /// The changes that make the model of a scene.
    model: [&'static str; 6],
    methods: &'static [Method],
    panels: Vec<PanelResults<'a>>,
    /// Stiffnesses over mass, in 1/s², that would have taken too long.
    left_out: &'a [f64],
    pictures: Option<PictureResults<'a>>,
}

#[derive(Serialize)]
struct PanelResults<'a> {
    density: f64,
    /// Which cloth that is, against the scene's.
    cloth: String,
    k_over_m: f64,
    stable_rate: f64,
    reference_rates: [u32; 2],
    /// How far the last two runs of the reference differ.
    floor: &'a [Difference],
    /// The time at which costs and errors are weighed, in seconds.
    time: f64,
    cells: Vec<CellResults<'a>>,
    hull: Vec<String>,
    /// The hull with counted cost instead of wall time: the same on every machine.
    hull_counted: Vec<String>,
    advice: Vec<Choice>,
}

#[derive(Serialize)]
struct CellResults<'a> {
    name: String,
    wall: f64,
    /// For each time, whether the error can be told from that of the reference.
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

/// What to use if so much can be paid.
#[derive(Serialize)]
struct Choice {
    budget: f64,
    #[serde(rename = "use")]
    choice: String,
    cost: f64,
    error: f64,
    /// Whether the error may be smaller: it cannot be told from that of the reference.
    at_most: bool,
}

impl<'a> Results<'a> {
    /// The results of `study` of the scene called `scene`, with how many runs were made and kept.
    pub fn new(study: &'a Study, scene: &'a str, [runs_made, runs_kept]: [u64; 2]) -> Self {
        Self {
            version: env!("CARGO_PKG_VERSION"),
            scene,
            threads: rayon::current_num_threads(),
            runs_made,
            runs_kept,
            times: study.extent.tenths.iter().map(|&tenth| f64::from(tenth) / 10.0).collect(),
            model: MODEL,
            methods: &METHODS,
            panels: study.panels.iter().map(PanelStudy::results).collect(),
            left_out: &study.left_out,
            pictures: study.pictures.as_ref().map(|pictures| {
                let points = pictures.points();
                let name = |i: usize| pictures.drawn[i].way.text();
                let [width, height] = pictures.size();
                PictureResults {
                    width,
                    height,
                    floor: pictures.floor,
                    ways: pictures.drawn.iter().map(WayResults::new).collect(),
                    hull: hull(&points).into_iter().map(name).collect(),
                    advice: choices(&advice(&points), &points, |i| (name(i), false)),
                }
            }),
        }
    }

    /// The advice as lines of text.
    pub fn text(&self) -> String {
        let mut text = String::new();
        for panel in &self.panels {
            text += &format!(
                "k/m {:.2e} /s² ({}: {} kg/m²), error at {} s, in s of work per simulated s:\n",
                panel.k_over_m,
                panel.cloth,
                short(panel.density),
                panel.time
            );
            text += &lines(&panel.advice, "s", "m");
        }
        if let Some(pictures) = &self.pictures {
            text += &format!("pictures of {} x {}, in ms:\n", pictures.width, pictures.height);
            text += &lines(&pictures.advice, "ms", "of 255");
        }
        text
    }
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

impl PanelStudy {
    fn results(&self) -> PanelResults<'_> {
        let Self { panel, reference, cells } = self;
        let named = |hull: Vec<usize>| hull.into_iter().map(|i| self.name(i)).collect();
        PanelResults {
            density: panel.density,
            cloth: panel.cloth(),
            k_over_m: panel.k_over_m,
            stable_rate: panel.stable_rate,
            reference_rates: reference.rates,
            floor: &reference.floor,
            time: reference.floor.get(self.moment()).map_or(0.0, |floor| floor.time),
            cells: cells.iter().enumerate().map(|(i, cell)| self.cell_results(i, cell)).collect(),
            hull: named(self.hull(Cost::Wall)),
            hull_counted: named(self.hull(Cost::Springs)),
            advice: choices(&self.advice(), &self.points(Cost::Wall), |i| (self.name(i), !self.is_told(i))),
        }
    }

    fn cell_results<'a>(&'a self, number: usize, measured: &'a Measured) -> CellResults<'a> {
        let compared = (0..measured.errors.len()).map(|moment| self.is_compared(measured, moment)).collect();
        CellResults { name: self.name(number), wall: measured.wall(), compared, measured }
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
