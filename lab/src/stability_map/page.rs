//! The map as a web page: a panel for each density, the thresholds, the extremes.

use super::extremes::{FRAMES, Promise, Row, headline};
use super::legend::{self, LINES, TRIED, legend};
use super::map::{Column, Map};
use super::panel::panel;
use crate::page::{self, Cells, escape, live::Live, short};

/// What the page adds to the style of every page: maps two by two, or one by one on a narrow screen.
const STYLE: &str = "\
.maps{display:grid;grid-template-columns:repeat(2,minmax(0,1fr));gap:1rem}.maps>figure{margin:0}\
@media(max-width:700px){.maps{grid-template-columns:minmax(0,1fr)}}th{white-space:normal}";

/// The page of `map` and the extremes `rows`, called `title`; with links to the scene on a live page, if there is one.
pub fn page(title: &str, map: &Map, rows: &[Row], live: Option<&Live>) -> String {
    let style = format!("<style>{STYLE}{}</style>\n", legend::STYLE);
    page::head(title) + &style + &panels(map) + &thresholds(map, live) + &extremes(rows) + page::END
}

/// A heat map for each density, with the bounds by theory.
fn panels(map: &Map) -> String {
    let densities = map.axes.density.iter().enumerate();
    let plots: String = densities.map(|(i, &density)| panel(map, density, &format!("panel{i}"))).collect();
    format!(
        "<p>Each rectangle is a run of {} s with the values in its middle; its colour is the outcome. The lines are the \
         fewest stable steps per frame by theory. A good colour below the line <em>at rest</em> only means that the \
         blow-up has not come yet, as in a cloth that has only fallen so far.</p>\n\
         {}<div class=\"maps\">\n{plots}</div>\n\
         <p class=\"soft\">In a cloth that blows up, the stretch limit takes out in every step the energy that the \
         springs put in: the strains, and often the energy that the cloth holds, stay small. Such a blow-up is found \
         by the energy ledger, which counts what the springs put in. The ledger is judged only below the bound at \
         worst, because no blow-up was found above it.</p>\n",
        map.axes.time,
        legend(),
    )
}

/// Steps a second and, in brackets, the fewest whole steps per frame above them at `fps` frames a second.
pub fn rate(steps: f64, fps: f64) -> String {
    format!("{steps:.1} ({})", (steps / fps).floor() + 1.0)
}

/// The bounds by theory and the thresholds found by bisection.
fn thresholds(map: &Map, live: Option<&Live>) -> String {
    let found = |steps: Option<f64>| steps.map_or_else(|| "–".to_owned(), |steps| rate(steps, map.fps));
    let row = |column: &Column| {
        let [rest, worst, gershgorin] = column.theory;
        let ratio = column.at_rest.map_or_else(|| "–".to_owned(), |steps| format!("{:.4}", steps / rest));
        let density = live.map_or_else(|| short(column.density), |live| link(column, map.fps, live));
        vec![
            density,
            short(column.ks),
            rate(rest, map.fps),
            found(column.at_rest),
            ratio,
            found(column.in_motion),
            rate(worst, map.fps),
            rate(gershgorin, map.fps),
        ]
    };
    let ([rest, worst, gershgorin], [tried_rest, tried_motion]) =
        (LINES.map(|line| line.name), TRIED.map(|(_, name, _)| name));
    let head = ["density (kg/m²)", "ks (N/m)", rest, tried_rest, "ratio", tried_motion, worst, gershgorin];
    format!(
        "<h2>Thresholds</h2>\n<p>The fewest steps a second at which the cloth is stable, and in brackets the fewest \
         whole steps per frame, at {} frames a second. Tried means found by bisection: at \
         rest to 0.1 %, in motion to 1 % over {} s, or over 600 steps if those take longer. With a stretch limit \
         there is no sharp edge in motion: the fewer the steps, the more energy the springs put in. The figure is the \
         number of steps at which that exceeds the allowance of the cloth, or the bound at worst if that is reached \
         first, since the ledger is not judged above it. A dash means: not found between half the bound at rest and \
         twice the bound at worst.</p>\n{}",
        map.fps,
        map.axes.time,
        page::table(&head, Cells::Numbers, map.columns.iter().map(row)),
    )
}

/// The density of a column, linked to its cloth on the live page with the fewest steps that are stable at rest.
fn link(column: &Column, fps: f64, live: &Live) -> String {
    let sets = [
        format!("cloth.density={}", column.density),
        format!("cloth.ks={}", column.ks),
        format!("sim.steps_per_frame={}", (column.theory[0] / fps).floor() + 1.0),
    ];
    live.with(sets.iter().map(|set| ("set", set.as_str()))).link(&short(column.density))
}

/// The extremes: what is promised, and what happened.
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
        "<h2>Extremes</h2>\n<p><strong>{}.</strong></p>\n<p>A check of the program, separate from the map: this scene with \
         one value at the end of its range, or just beyond. A row that <em>runs</em> must run for {FRAMES} frames \
         without a blow-up. A row that <em>is refused</em> must be refused before the first step: it is not a valid \
         scene, it is certain to blow up, or its steps are too short for floating-point numbers. \
         <code>docs/extremes.md</code> lists the promises.</p>\n{}",
        escape(&headline(rows)),
        page::table(&head, Cells::Text, rows.iter().map(row))
    )
}
