//! The contact sheet: the picture of each case where its values meet.

use std::collections::BTreeMap;

use serde_json::Value;

use super::shown::Shown;
use crate::page::{escape, image, short};
use drape::scene::sweep::{Axis, Spec};

/// The sheet: a table over the two longest parameters for each combination of the others, or all pictures in a row.
pub(super) fn html(spec: &Spec, shown: &[Shown]) -> String {
    let Some([down, across]) = longest(spec) else { return flow(shown) };
    let mut groups: BTreeMap<Vec<usize>, Vec<Placed<'_>>> = BTreeMap::new();
    for one in shown {
        let mut places = spec.places(one.case.number);
        let at = [places[down], places[across]];
        (places[down], places[across]) = (0, 0);
        groups.entry(places).or_default().push((one, at));
    }
    let group = |(places, cases): (&Vec<usize>, &Vec<Placed<'_>>)| {
        let heading = heading(spec, places, [down, across]);
        format!("<div>{heading}{}</div>\n", grid(&spec.set[down], &spec.set[across], cases))
    };
    format!("<div class=\"groups\">\n{}</div>\n", groups.iter().map(group).collect::<String>())
}

/// A case with its row and column.
type Placed<'a> = (&'a Shown, [usize; 2]);

/// The two parameters with most values, the one with more of them last; nothing if there are not two.
fn longest(spec: &Spec) -> Option<[usize; 2]> {
    let mut order: Vec<usize> = (0..spec.set.len()).filter(|_| !spec.zip).collect();
    order.sort_by_key(|&axis| spec.set[axis].values.len());
    match order.as_slice() {
        [.., down, across] => Some([*down, *across]),
        _ => None,
    }
}

/// The values of the parameters that are the same in a table.
fn heading(spec: &Spec, places: &[usize], without: [usize; 2]) -> String {
    let axes = spec.set.iter().zip(places).enumerate().filter(|(i, _)| !without.contains(i));
    let value = |(_, (axis, place)): (usize, (&Axis, &usize))| {
        format!("{} = {}", escape(&axis.path), at(axis, *place))
    };
    let values: Vec<String> = axes.map(value).collect();
    if values.is_empty() { String::new() } else { format!("<h3>{}</h3>\n", values.join(", ")) }
}

fn grid(down: &Axis, across: &Axis, cases: &[Placed<'_>]) -> String {
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
        (None, Some(record)) => format!("<span class=\"none\">{}</span>", record.outcome()),
        (None, None) => "<span class=\"none\">no result</span>".to_owned(),
    };
    format!("<a class=\"tile\" data-case=\"{number}\" href=\"#case-{number}\">{inside}</a>")
}

fn at(axis: &Axis, place: usize) -> String {
    axis.values.get(place).map(text).unwrap_or_default()
}

/// A value with at most four digits.
fn text(value: &Value) -> String {
    escape(&value.as_f64().map_or_else(|| value.to_string().trim_matches('"').to_owned(), short))
}
