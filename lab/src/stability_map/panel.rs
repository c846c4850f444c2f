//! The map of one density as a plot: rectangles for runs, lines for theory, marks for thresholds found by
//! bisection.

use super::legend::{LINES, OPACITY, TRIED, color};
use super::map::{Cell, Column, Map};
use crate::page::axis::{Axis, Scale};
use crate::page::plot::{Marker, Plot, Style};
use crate::page::short;
use drape::math::{exp, ln};

/// The plot of `density`, as a figure; `id` is one that no other plot of the page has.
pub(super) fn panel(map: &Map, density: f64, id: &str) -> String {
    let steps: Vec<f64> = map.axes.steps.iter().map(|&steps| f64::from(steps)).collect();
    let [columns, rows] = [edges(&map.axes.ks), edges(&steps)];
    let x = axis("ks (N/m)", &map.axes.ks, &columns);
    let y = axis("steps per frame", &steps, &rows);
    let range = y.range();
    let mut plot = Plot::new(&format!("density {} kg/m²", short(density)), x, y);
    for (k, cell) in map.panel(density).enumerate() {
        let [i, j] = [k / steps.len(), k % steps.len()];
        let corners = [[columns[i], rows[j]], [columns[i + 1], rows[j + 1]]];
        plot.area(corners, color(cell.run.outcome), OPACITY, &hint(cell));
    }
    let of_density: Vec<&Column> = map.columns.iter().filter(|column| column.density == density).collect();
    theory(&mut plot, &of_density, map.fps, &columns);
    for column in of_density {
        tried(&mut plot, column, map.fps, range);
    }
    format!("<figure>{}</figure>\n", plot.finish(id))
}

/// The axis of `values`, whose cells have the borders `edges`.
fn axis(label: &str, values: &[f64], edges: &[f64]) -> Axis {
    match values {
        [value] => Axis::around(label, *value, &short(*value)),
        _ => Axis::new(label, Scale::Log, edges[0], edges[edges.len() - 1]),
    }
}

/// The borders of cells around the ascending `values`: at the geometric means of neighbours.
fn edges(values: &[f64]) -> Vec<f64> {
    let between = |a: f64, b: f64| exp(0.5 * (ln(a) + ln(b)));
    let inner: Vec<f64> = values.windows(2).map(|pair| between(pair[0], pair[1])).collect();
    let [first, last] = [values[0], values[values.len() - 1]];
    let below = inner.first().map_or(first / 2.0, |edge| first * (first / edge));
    let above = inner.last().map_or(last * 2.0, |edge| last * (last / edge));
    std::iter::once(below).chain(inner).chain([above]).collect()
}

/// The bounds by theory from column to column; strokes across the column if there is only one.
fn theory(plot: &mut Plot, columns: &[&Column], fps: f64, edges: &[f64]) {
    for (number, line) in LINES.iter().enumerate() {
        let points: Vec<[f64; 2]> = match columns {
            [column] => edges.iter().map(|&ks| [ks, column.theory[number] / fps]).collect(),
            _ => columns.iter().map(|column| [column.ks, column.theory[number] / fps]).collect(),
        };
        plot.line(&points, line.style());
    }
}

/// Marks the thresholds of `column` that lie in the `range` of the plot.
fn tried(plot: &mut Plot, column: &Column, fps: f64, [bottom, top]: [f64; 2]) {
    for ((marker, name, _), found) in TRIED.into_iter().zip([column.at_rest, column.in_motion]) {
        let Some(steps) = found.filter(|steps| (bottom..=top).contains(&(steps / fps))) else { continue };
        let hint = format!("{name}: {steps:.1} steps a second");
        plot.marker([column.ks, steps / fps], solid(marker), &hint);
    }
}

fn solid(marker: Marker) -> Style {
    Style { color: "--ink", marker, hollow: false, dashed: false, stroke: 0.0 }
}

fn hint(cell: &Cell) -> String {
    let Cell { ks, steps, run, .. } = cell;
    format!(
        "ks {} N/m, {steps} steps per frame: {}; {} frames, longest spring {:.3} of its rest length",
        short(*ks),
        run.outcome.name(),
        run.frames,
        run.stretch
    )
}
