//! The map as a web page: a panel a density, the thresholds, the extremes.

use super::extremes::{Promise, Row};
use super::{Column, Map};
use crate::output::page::{self, escape};

/// The page of `map` and the extremes `rows`, called `title`.
pub fn page(title: &str, map: &Map, rows: &[Row]) -> String {
    page::head(title) + &thresholds(map) + &extremes(rows) + page::END
}

/// A table with `head` over `rows` of cells that are HTML already.
fn table(head: &[&str], rows: impl Iterator<Item = Vec<String>>) -> String {
    let head: String = head.iter().map(|name| format!("<th>{name}</th>")).collect();
    let row = |cells: Vec<String>| {
        let cells: String = cells.iter().map(|cell| format!("<td>{cell}</td>")).collect();
        format!("<tr>{cells}</tr>\n")
    };
    let rows: String = rows.map(row).collect();
    format!("<div class=\"wide\"><table>\n<tr>{head}</tr>\n{rows}</table></div>\n")
}

/// What theory asks for against what was found by trying.
fn thresholds(map: &Map) -> String {
    let found = |steps: Option<f64>| steps.map_or_else(|| "–".to_owned(), |steps| format!("{steps:.1}"));
    let row = |column: &Column| {
        let [rest, safe, gershgorin] = column.theory;
        let ratio = column.at_rest.map_or_else(|| "–".to_owned(), |steps| format!("{:.4}", steps / rest));
        vec![
            column.density.to_string(),
            column.ks.to_string(),
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
         rest to 0.1 %, in motion over {} s to 1 %. A dash: not found between half the first bound and \
         twice the safe one.</p>\n{}",
        map.axes.time,
        table(&head, map.columns.iter().map(row)),
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
        let kept = if row.kept { "kept" } else { "<strong>broken</strong>" };
        vec![escape(row.what), sets.join(" "), promise.to_owned(), escape(&row.happened), kept.to_owned()]
    };
    let head = ["extreme", "set", "promise", "what happened", "promise"];
    format!("<h2>Extremes</h2>\n{}", table(&head, rows.iter().map(row)))
}
