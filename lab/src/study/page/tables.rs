//! The tables of the page.

use crate::page::{Cells, escape, live::Live, table};
use crate::study::findings::{Cost, PanelStudy, Study};
use crate::study::method::METHODS;
use crate::study::pareto::{self, front};
use crate::study::pictures::Pictures;
use crate::study::rates::clock;

/// The best choice within each budget of time per simulated second.
pub(super) fn advice(panel: &PanelStudy) -> String {
    let points = panel.points(Cost::Wall);
    let rows = panel.advice().into_iter().map(|advice| {
        let [cost, error] = points[advice.use_point];
        let springs = panel.cells[advice.use_point].springs;
        let name = escape(&panel.name(advice.use_point));
        vec![
            format!("{} s", advice.budget),
            name,
            format!("{}{error:.2e}", if panel.is_distinct(advice.use_point) { "" } else { "≤ " }),
            format!("{cost:.3}"),
            format!("{springs:.2e}"),
        ]
    });
    let time = panel.reference.floor.get(panel.moment()).map_or(0.0, |floor| floor.time);
    let error = format!("error at {time:.1} s (m)");
    table(&["pay", "use", &error, "takes (s/s)", "springs visited (1/s)"], Cells::Numbers, rows)
}

/// The best way to draw within each budget of time.
pub(super) fn picture_advice(pictures: &Pictures) -> String {
    let points = pictures.points();
    let rows = pareto::advice(&points).into_iter().map(|advice| {
        let drawn = &pictures.drawn[advice.use_point];
        vec![
            format!("{} ms", advice.budget),
            escape(&drawn.way.text()),
            format!("{:.3}", drawn.rmse),
            format!("{:.2}", drawn.ms()),
            drawn.fragments.to_string(),
        ]
    });
    table(&["pay", "use", "error (of 255)", "takes (ms)", "fragments"], Cells::Numbers, rows)
}

/// The name of a run, linked to the run on the live page if there is one.
fn run_name(panel: &PanelStudy, cell: usize, live: Option<&Live>) -> String {
    let name = escape(&panel.name(cell));
    let (Some(live), Some(found)) = (live, panel.cells.get(cell)) else { return name };
    let clock = clock(FPS, found.rate);
    let sets = panel.panel.sets.iter().chain(&METHODS[found.method].sets).chain(&clock);
    live.with(sets.map(|set| ("set", set.as_str()))).link(&name)
}

/// Frames a second on the live page, where the rate of a run allows it.
const FPS: f64 = 90.0;

/// All cells of a panel.
pub(super) fn cells(study: &Study, panel: &PanelStudy, live: Option<&Live>) -> String {
    let times: Vec<String> = study
        .extent
        .tenths
        .iter()
        .map(|tenth| format!("RMS, max at {} s (m)", f64::from(*tenth) / 10.0))
        .collect();
    let mut head = vec!["run", "outcome", "s/s", "springs (1/s)", "energy drift", "stretch"];
    head.extend(times.iter().map(String::as_str));
    let rows = panel.cells.iter().enumerate().map(|(i, cell)| {
        let mut row = vec![
            run_name(panel, i, live),
            cell.fate(times.len()),
            format!("{:.4}", cell.wall()),
            format!("{:.2e}", cell.springs),
            cell.drift.map_or_else(|| "–".to_owned(), |drift| format!("{drift:+.2e}")),
            if cell.errors.is_empty() { "–".to_owned() } else { format!("{:.3}", cell.stretch) },
        ];
        row.extend((0..times.len()).map(|moment| match cell.errors.get(moment) {
            None => "–".to_owned(),
            Some(error) if panel.is_compared(cell, moment) => format!("{:.2e}, {:.2e}", error.rms, error.max),
            Some(_) => "below the reference".to_owned(),
        }));
        row
    });
    table(&head, Cells::Numbers, rows)
}

/// All ways to draw.
pub(super) fn ways(pictures: &Pictures) -> String {
    let rows = pictures.drawn.iter().map(|drawn| {
        vec![
            escape(&drawn.way.text()),
            format!("{:.2}", drawn.ms()),
            format!("{:.4}", drawn.rmse),
            drawn.max.to_string(),
            drawn.off.to_string(),
            drawn.fragments.to_string(),
            drawn.vertices.to_string(),
        ]
    });
    table(
        &["way", "ms", "RMS error", "largest error", "pixels off by > 1", "fragments", "vertices"],
        Cells::Numbers,
        rows,
    )
}

/// The ways whose pictures are shown: the Pareto front, and the worst.
pub(super) fn shown(pictures: &Pictures) -> Vec<usize> {
    let points = pictures.points();
    let mut shown = front(&points);
    shown.extend((0..points.len()).max_by(|&a, &b| points[a][1].total_cmp(&points[b][1])));
    shown.sort_unstable();
    shown.dedup();
    shown
}
