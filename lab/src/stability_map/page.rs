//! The map as a web page: a panel a density, the thresholds, the extremes.

use super::extremes::{FRAMES, Promise, Row, headline};
use super::legend::{self, LINES, TRIED, legend};
use super::panel::panel;
use super::{Column, Map};
use crate::page::{self, Cells, escape, short};

/// What the page adds to the style of every page: maps two by two, or one by one on a narrow screen.
const STYLE: &str = "\
.maps{display:grid;grid-template-columns:repeat(2,minmax(0,1fr));gap:1rem}.maps>figure{margin:0}\
@media(max-width:700px){.maps{grid-template-columns:minmax(0,1fr)}}th{white-space:normal}";

/// The page of `map` and the extremes `rows`, called `title`.
pub fn page(title: &str, map: &Map, rows: &[Row]) -> String {
    let style = format!("<style>{STYLE}{}</style>\n", legend::STYLE);
    page::head(title) + &style + &panels(map) + &thresholds(map) + &extremes(rows) + page::END
}

/// A heat map for each density, with the theory's lines.
fn panels(map: &Map) -> String {
    let densities = map.axes.density.iter().enumerate();
    let plots: String = densities.map(|(i, &density)| panel(map, density, &format!("panel{i}"))).collect();
    format!(
        "<p>Each rectangle is a run of {} s with the values in its middle; its colour says how the cloth fared. The \
         lines are the steps per frame that theory asks for. A good colour below the line <em>at rest</em> only says \
         that the blow-up has not come yet, as in a cloth that has not done more than fall so far.</p>\n\
         {}<div class=\"maps\">\n{plots}</div>\n\
         <p class=\"soft\">The stretch limit takes out in every step what the springs of a cloth that blows up put \
         in: strains, and often the energy that the cloth holds, stay small. What shows then is the ledger, which \
         counts what the springs put in; it judges only below the bound at worst, for from there on no blow-up was \
         found.</p>\n",
        map.axes.time,
        legend(),
    )
}

/// Steps a second, with the whole steps per frame that they take at `fps` frames a second in brackets.
pub fn rate(steps: f64, fps: f64) -> String {
    format!("{steps:.1} ({})", (steps / fps).floor() + 1.0)
}

/// What theory asks for against what was found by trying.
fn thresholds(map: &Map) -> String {
    let found = |steps: Option<f64>| steps.map_or_else(|| "–".to_owned(), |steps| rate(steps, map.fps));
    let row = |column: &Column| {
        let [rest, worst, gershgorin] = column.theory;
        let ratio = column.at_rest.map_or_else(|| "–".to_owned(), |steps| format!("{:.4}", steps / rest));
        vec![
            short(column.density),
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
         whole steps per frame, at {} frames a second. Tried: by bisection, at \
         rest to 0.1 %, in motion over {} s, or 600 steps if those are longer, to 1 %. In motion there is no edge \
         to be found behind a stretch limit: the fewer the steps, the more the springs put in, and the figure is \
         where that passes what the cloth is allowed, or the bound at worst where it would pass it only there or \
         above, since the ledger does not judge from there on. A dash: not found between half the bound at rest and \
         twice the one at worst.</p>\n{}",
        map.fps,
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
        "<h2>Extremes</h2>\n<p><strong>{}.</strong></p>\n<p>A check of the program, apart from the map: this scene with \
         one value at the end of its range, or just beyond. What <em>runs</em> has to run for {FRAMES} frames \
         without a blow-up; what <em>is refused</em> has to be refused before the first step, because it is no scene, \
         is certain to blow up, or has a step that numbers cannot resolve. <code>docs/extremes.md</code> has the \
         promises.</p>\n{}",
        escape(&headline(rows)),
        page::table(&head, Cells::Text, rows.iter().map(row))
    )
}
