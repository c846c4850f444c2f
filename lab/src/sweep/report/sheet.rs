//! The contact sheet: the picture of each case where its values meet.

use std::collections::BTreeMap;

use serde_json::Value;

use super::Shown;
use crate::page::{escape, image};
use drape::scene::sweep::{Axis, Spec};

/// The sheet: a table over the last two parameters for each combination of the others, or all pictures in a row.
pub(super) fn html(spec: &Spec, shown: &[Shown]) -> String {
    match spec.set.as_slice() {
        [others @ .., down, across] if !spec.zip => {
            let mut groups: BTreeMap<Vec<usize>, Vec<(&Shown, [usize; 2])>> = BTreeMap::new();
            for one in shown {
                let mut places = spec.places(one.case.number);
                let [across, down] = [places.pop(), places.pop()].map(Option::unwrap_or_default);
                groups.entry(places).or_default().push((one, [down, across]));
            }
            let group = |(places, cases): (&Vec<usize>, &Vec<_>)| {
                heading(others, places) + &grid(down, across, cases)
            };
            groups.iter().map(group).collect()
        }
        _ => flow(shown),
    }
}

/// The values of the parameters that are the same in a table.
fn heading(axes: &[Axis], places: &[usize]) -> String {
    let value = |(axis, &place): (&Axis, &usize)| {
        axis.values
            .get(place)
            .map_or_else(String::new, |value| format!("{} = {}", escape(&axis.path), text(value)))
    };
    let values: Vec<String> = axes.iter().zip(places).map(value).collect();
    if values.is_empty() { String::new() } else { format!("<h3>{}</h3>\n", values.join(", ")) }
}

fn grid(down: &Axis, across: &Axis, cases: &[(&Shown, [usize; 2])]) -> String {
    let corner = format!("{} ↓ {} →", escape(&down.path), escape(&across.path));
    let columns: Vec<usize> = present(cases.iter().map(|(_, [_, across])| *across));
    let heads: String =
        columns.iter().map(|&place| format!("<th scope=\"col\">{}</th>", at(across, place))).collect();
    let row = |place: usize| {
        let cell = |column: &usize| {
            let found = cases.iter().find(|(_, at)| *at == [place, *column]);
            format!("<td>{}</td>", found.map_or_else(String::new, |(shown, _)| tile(shown)))
        };
        let cells: String = columns.iter().map(cell).collect();
        format!("<tr><th scope=\"row\">{}</th>{cells}</tr>\n", at(down, place))
    };
    let rows: String = present(cases.iter().map(|(_, [down, _])| *down)).into_iter().map(row).collect();
    format!(
        "<div class=\"wide\"><table class=\"sheet\">\n<tr><th>{corner}</th>{heads}</tr>\n{rows}</table></div>\n"
    )
}

/// The places that occur, in order.
fn present(places: impl Iterator<Item = usize>) -> Vec<usize> {
    places.collect::<std::collections::BTreeSet<_>>().into_iter().collect()
}

fn flow(shown: &[Shown]) -> String {
    let figure = |one: &Shown| {
        let values: Vec<String> = one.case.changes.iter().map(|(_, value)| text(value)).collect();
        format!("<figure>{}<figcaption>{}</figcaption></figure>\n", tile(one), values.join(", "))
    };
    format!("<div class=\"flow\">\n{}</div>\n", shown.iter().map(figure).collect::<String>())
}

/// The picture of a case, or why there is none.
fn tile(shown: &Shown) -> String {
    let number = shown.case.number + 1;
    let inside = match (&shown.picture, &shown.record) {
        (Some(png), _) => image(&format!("case {number}: {}", shown.case.sets().join(", ")), png),
        (None, Some(record)) => format!("<span class=\"none\">exit {}</span>", record.exit_code),
        (None, None) => "<span class=\"none\">no result</span>".to_owned(),
    };
    format!("<a class=\"tile\" data-case=\"{number}\" href=\"#case-{number}\">{inside}</a>")
}

fn at(axis: &Axis, place: usize) -> String {
    axis.values.get(place).map(text).unwrap_or_default()
}

fn text(value: &Value) -> String {
    escape(value.to_string().trim_matches('"'))
}
