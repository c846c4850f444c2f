//! The map as a web page: a panel a density, the thresholds, the extremes.

use super::extremes::{FRAMES, Promise, Row};
use super::outcome::Outcome;
use super::{Cell, Column, Map};
use crate::math::{exp, ln};
use crate::output::axis::{Axis, Scale};
use crate::output::page::{self, Cells, escape};
use crate::output::plot::{Marker, Plot, Style};

/// The page of `map` and the extremes `rows`, called `title`.
pub fn page(title: &str, map: &Map, rows: &[Row]) -> String {
    page::head(title) + &panels(map) + &thresholds(map) + &extremes(rows) + page::END
}

/// A heat map for each density, with the theory's lines.
fn panels(map: &Map) -> String {
    let columns = map.axes.density.iter().enumerate();
    let plots: String = columns.map(|(i, &density)| panel(map, density, &format!("panel{i}"))).collect();
    format!(
        "<p>Each rectangle is a run of {} s with the values in its middle, and shows what happened in it: a cloth that \
         only falls breaks nothing. \
         The lines are the steps per frame that theory asks for: at rest \
         (ω² = 8 ks/m for the stock lattice), in any configuration (12 ks/m), and by Gershgorin's circles \
         (17.6 ks/m). Between the first two it depends on how the cloth is deformed.</p>\n\
         <p>The stretch limit takes out in every step what the springs of a cloth that blows up put in: strains, \
         and often the energy that the cloth holds, stay small. What shows then is the ledger, which counts \
         what the springs put in; it judges only below the bound of any configuration, for above it they \
         cannot blow up.</p>\n<div class=\"row\">\n{plots}</div>\n",
        map.axes.time
    )
}

fn panel(map: &Map, density: f64, id: &str) -> String {
    let steps: Vec<f64> = map.axes.steps.iter().map(|&steps| f64::from(steps)).collect();
    let [columns, rows] = [edges(&map.axes.ks), edges(&steps)];
    let axis = |label, edges: &[f64]| Axis::new(label, Scale::Log, edges[0], edges[edges.len() - 1]);
    let title = format!("density {} kg/m²", short(density));
    let mut plot = Plot::new(&title, axis("ks (N/m)", &columns), axis("steps per frame", &rows));
    for (k, cell) in map.panel(density).enumerate() {
        let [i, j] = [k / steps.len(), k % steps.len()];
        let corners = [[columns[i], rows[j]], [columns[i + 1], rows[j + 1]]];
        plot.area(corners, color(cell.run.outcome), 0.65, &hint(cell));
    }
    for (line, name) in ["at rest", "any shape", "Gershgorin"].into_iter().enumerate() {
        let of_density = map.columns.iter().filter(|column| column.density == density);
        let points: Vec<_> = of_density.map(|c| [c.ks, c.theory[line] / map.fps]).collect();
        let style =
            Style { color: "--ink", dashed: line > 0, stroke: 2.0 - 0.5 * line as f64, ..Style::GUIDE };
        plot.line(&points, style);
        plot.entry(style, name);
    }
    for (marker, name) in [(Marker::Disc, "tried at rest"), (Marker::Diamond, "tried in motion")] {
        let style = solid(marker, "--ink");
        for column in map.columns.iter().filter(|column| column.density == density) {
            let tried = if marker == Marker::Disc { column.at_rest } else { column.in_motion };
            let hint = |steps: f64| format!("{name}: {steps:.1} steps a second");
            let [bottom, top] = [rows[0], rows[rows.len() - 1]];
            let shown =
                tried.map(|steps| (steps, steps / map.fps)).filter(|(_, y)| (bottom..=top).contains(y));
            shown.into_iter().for_each(|(steps, y)| plot.marker([column.ks, y], style, &hint(steps)));
        }
        plot.entry(style, name);
    }
    for outcome in Outcome::ALL {
        plot.entry(solid(Marker::Square, color(outcome)), outcome.name());
    }
    format!("<figure>{}</figure>\n", plot.finish(id))
}

fn solid(marker: Marker, color: &'static str) -> Style {
    Style { color, marker, hollow: false, dashed: false, stroke: 0.0 }
}

/// The borders of cells around `values`, which rise: half way, by ratio, to the next.
fn edges(values: &[f64]) -> Vec<f64> {
    let between = |a: f64, b: f64| exp(0.5 * (ln(a) + ln(b)));
    let inner: Vec<f64> = values.windows(2).map(|pair| between(pair[0], pair[1])).collect();
    let [first, last] = [values[0], values[values.len() - 1]];
    let below = inner.first().map_or(first / 2.0, |edge| first * (first / edge));
    let above = inner.last().map_or(last * 2.0, |edge| last * (last / edge));
    std::iter::once(below).chain(inner).chain([above]).collect()
}

fn color(outcome: Outcome) -> &'static str {
    match outcome {
        Outcome::Ok => "--c",
        Outcome::Stretch => "--a",
        Outcome::Energy => "--b",
        Outcome::Lost => "--f",
    }
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

/// A number for people: four digits.
pub fn short(value: f64) -> String {
    let rounded: f64 = format!("{value:.3e}").parse().unwrap_or(value);
    if (1e-3..1e6).contains(&rounded) { rounded.to_string() } else { format!("{rounded:e}") }
}

/// What theory asks for against what was found by trying.
fn thresholds(map: &Map) -> String {
    let found = |steps: Option<f64>| steps.map_or_else(|| "–".to_owned(), |steps| format!("{steps:.1}"));
    let row = |column: &Column| {
        let [rest, safe, gershgorin] = column.theory;
        let ratio = column.at_rest.map_or_else(|| "–".to_owned(), |steps| format!("{:.4}", steps / rest));
        vec![
            short(column.density),
            short(column.ks),
            format!("{rest:.1}"),
            found(column.at_rest),
            ratio,
            found(column.in_motion),
            format!("{safe:.1}"),
            format!("{gershgorin:.1}"),
        ]
    };
    let head =
        ["density", "ks", "at rest, theory", "at rest, tried", "ratio", "in motion", "safe", "Gershgorin"];
    format!(
        "<h2>Thresholds</h2>\n<p>The fewest steps a second at which the cloth is stable. Tried: by bisection, at \
         rest to 0.1 %, in motion over {} s, or 600 steps if those are longer, to 1 %. In motion there is no edge \
         to be found behind a stretch limit: the fewer the steps, the more the springs put in, and the figure is \
         where that passes what the cloth is allowed, at most the safe bound, above which the ledger does not \
         judge. A dash: not found between half the first bound and \
         twice the safe one.</p>\n{}",
        map.axes.time,
        page::table(&head, Cells::Numbers, map.columns.iter().map(row)),
    )
}

/// What was promised at the extremes, and what happened.
fn extremes(rows: &[Row]) -> String {
    let row = |row: &Row| {
        let promise = match row.promise {
            Promise::Runs => "runs",
            Promise::Refused => "is refused",
        };
        let sets: Vec<String> = row.sets.iter().map(|set| format!("<code>{}</code>", escape(set))).collect();
        let kept = if row.kept { "yes" } else { "<strong>no</strong>" };
        vec![escape(row.what), sets.join(" "), promise.to_owned(), escape(&row.happened), kept.to_owned()]
    };
    let head = ["extreme", "set", "promise", "what happened", "kept"];
    format!(
        "<h2>Extremes</h2>\n<p>What runs ran for {FRAMES} frames.</p>\n{}",
        page::table(&head, Cells::Text, rows.iter().map(row))
    )
}
