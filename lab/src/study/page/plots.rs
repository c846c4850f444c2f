//! Work-precision plots: error over cost, both logarithmic.

use crate::page::axis::Axis;
use crate::page::plot::{Marker, Plot, Style};
use crate::study::findings::{Cost, PanelStudy, Study};
use crate::study::method::{METHODS, Method};
use crate::study::pareto::front;
use crate::study::pictures::Pictures;
use crate::study::runs::{Measured, Outcome};

/// The Pareto front: a broad line under the points.
const FRONT: Style = Style { color: "--ink", marker: Marker::None, hollow: true, dashed: false, stroke: 4.0 };

/// The floor in the legend.
const FLOOR: Style =
    Style { color: "--line", marker: Marker::None, hollow: false, dashed: false, stroke: 10.0 };

/// Cost and error of the cells of a panel at its moment.
pub(super) fn work_precision(study: &Study, panel: &PanelStudy, cost: Cost, number: usize) -> String {
    let moment = panel.moment();
    let time = f64::from(study.extent.tenths.get(moment).copied().unwrap_or(0)) / 10.0;
    let floor = panel.reference.floor.get(moment).map_or(0.0, |floor| floor.rms);
    let reached = panel.cells.iter().filter_map(|cell| Some(cell.errors.get(moment)?.rms));
    let x = Axis::decades(cost_label(cost), panel.cells.iter().map(|cell| panel.cost(cell, cost)));
    // A cloth that flew kilometres away is drawn at the top edge.
    let y = Axis::decades("RMS error (m)", reached.map(|error| error.min(9.0)).chain([floor]));
    let mut plot =
        Plot::new(&format!("k/m = {:.2e} /s², at {time} s", panel.panel.k_over_m), x.clone(), y.clone());
    let [bottom, top] = y.range();
    let [left, right] = x.range();
    plot.area(
        [[left, bottom], [right, floor.max(bottom)]],
        "--line",
        0.8,
        "self-difference of the reference",
    );
    guides(&mut plot, &x, &y);
    let points = panel.points(cost);
    // A run that holds too much energy is not on the front, but it belongs to the line of its method.
    let is_drawn = |cell: &Measured| {
        let error = cell.errors.get(moment).filter(|_| panel.is_compared(cell, moment));
        cell.outcome <= Outcome::EnergyAboveBound && error.is_some_and(|error| error.rms < top)
    };
    let along: Vec<_> = panel.front(cost).into_iter().map(|i| points[i]).collect();
    plot.line(&along, FRONT);
    for (method, Method { name, .. }) in METHODS.iter().enumerate() {
        let style = Style::of_series(method);
        let cells = panel.cells.iter().enumerate().filter(|(_, cell)| cell.method == method);
        let sound = cells.clone().filter(|(_, cell)| is_drawn(cell));
        let line: Vec<_> = sound.map(|(_, cell)| [panel.cost(cell, cost), cell.errors[moment].rms]).collect();
        plot.line(&line, style);
        for (i, cell) in cells {
            let error = cell.errors.get(moment).map_or(top, |error| error.rms.min(top));
            plot.marker(
                [panel.cost(cell, cost), error],
                marker(panel, cell, moment, style),
                &hint(panel, i, moment),
            );
        }
        plot.entry(style, name);
    }
    plot.entry(FRONT, "Pareto front");
    plot.entry(Style::GUIDE, "slopes 1 and 2");
    plot.entry(FLOOR, "floor of the reference");
    plot.finish(&format!("p{number}{}", if cost == Cost::Wall { "wall" } else { "springs" }))
}

fn cost_label(cost: Cost) -> &'static str {
    match cost {
        Cost::Wall => "wall time per simulated second (s/s)",
        Cost::Springs => "springs visited per simulated second (1/s)",
    }
}

/// The marker of a cell.
fn marker(panel: &PanelStudy, cell: &Measured, moment: usize, style: Style) -> Style {
    match cell.outcome {
        Outcome::Lost => Style { marker: Marker::Cross, ..style },
        _ if moment >= cell.errors.len() => Style { marker: Marker::None, ..style },
        Outcome::TooDear => Style { marker: Marker::None, ..style },
        Outcome::EnergyAboveReference | Outcome::EnergyAboveBound => Style { hollow: true, ..style },
        Outcome::Ok if panel.is_compared(cell, moment) => style,
        Outcome::Ok => Style { color: "--soft", ..style },
    }
}

fn hint(panel: &PanelStudy, number: usize, moment: usize) -> String {
    let cell = &panel.cells[number];
    let error = cell.errors.get(moment).map_or_else(|| "no error".to_owned(), |e| format!("{:.2e} m", e.rms));
    format!(
        "{}: {error}, {:.3e} s/s, {}",
        panel.name(number),
        cell.wall(),
        cell.fate(panel.reference.floor.len())
    )
}

/// Lines along which doubling the cost halves or quarters the error.
fn guides(plot: &mut Plot, x: &Axis, y: &Axis) {
    let ([left, right], [bottom, top]) = (x.range(), y.range());
    for (slope, name) in [(1.0, "slope 1"), (2.0, "slope 2")] {
        // From the top, a third of the way across, down to where it leaves the frame.
        let from = left * drape::math::pow(right / left, 1.0 / 3.0);
        let to = (from * drape::math::pow(top / bottom, 1.0 / slope)).min(right);
        let end = [to, top * drape::math::pow(from / to, slope)];
        plot.line(&[[from, top], end], Style::GUIDE);
        // Three quarters of the way down, where the two texts do not overlap.
        let part = |a: f64, b: f64| a * drape::math::pow(b / a, 0.75);
        plot.note([part(from, to), part(top, end[1])], name);
    }
}

/// Time and error of the ways of drawing.
pub(super) fn pictures(pictures: &Pictures) -> String {
    let points = pictures.points();
    let x = Axis::decades("time to draw (ms)", points.iter().map(|point| point[0]));
    let y = Axis::decades(
        "RMS error (levels of 255)",
        points.iter().map(|point| point[1]).chain([pictures.floor]),
    );
    let mut plot = Plot::new("pictures", x.clone(), y.clone());
    let [[left, right], [bottom, _]] = [x.range(), y.range()];
    plot.area(
        [[left, bottom], [right, pictures.floor.max(bottom)]],
        "--line",
        0.8,
        "self-difference of the converged picture",
    );
    let along: Vec<_> = front(&points).into_iter().map(|i| points[i]).collect();
    plot.line(&along, FRONT);
    // A series for each group of ways that differ in the samples alone.
    for (series, ways) in pictures.drawn.chunks(4).enumerate() {
        let style = Style::of_series(series);
        let line: Vec<_> = ways.iter().map(|drawn| [drawn.ms(), drawn.rmse]).collect();
        plot.line(&line, style);
        for drawn in ways {
            let hint = format!("{}: {:.3} of 255, {:.2} ms", drawn.way.text(), drawn.rmse, drawn.ms());
            plot.marker([drawn.ms(), drawn.rmse], style, &hint);
        }
        if let Some(first) = ways.first() {
            plot.entry(style, first.way.text().trim_start_matches("1 sample, "));
        }
    }
    plot.entry(FRONT, "Pareto front");
    plot.entry(FLOOR, "floor of the reference");
    plot.finish("pictures")
}
