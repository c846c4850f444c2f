//! The page of a sweep: one file, nothing fetched.

use super::plots::Plots;
use super::script::{SCRIPT, STYLE};
use super::shown::{Counts, MOST_SHOWN, Shown};
use super::{sheet, table};
use crate::page::{END, escape, head, short};
use crate::sweep::plan::Plan;
use drape::scene::sweep::{Axis, Spec};

/// The whole page.
pub(super) fn page(plan: &Plan, shown: &[Shown], plots: &Plots, counts: Counts) -> String {
    let spec = &plan.spec;
    let mut page = head(&format!("Sweep of {}", plan.scene().name)) + STYLE;
    page += &summary(spec, counts);
    if counts.cases > MOST_SHOWN {
        page += &format!(
            "<p>Pictures and table show {} of the {} cases, evenly spaced in the order of the plan; the plots, \
             results.csv and results.json have all.</p>\n",
            shown.len(),
            counts.cases
        );
    }
    if spec.render.is_some() {
        page += "<h2>Contact sheet</h2>\n<p class=\"soft\">Each picture is the end of a case. A click opens it with its \
                 numbers and its command.</p>\n";
        page += &sheet::html(spec, shown);
    }
    let plots = plots.html(spec);
    if !plots.is_empty() {
        page += "<h2>Measures</h2>\n<p class=\"soft\">A mark is the mean over all cases with these values; where other \
                 keys change too, a thin line shows their range. A mark or a cell tells its number when the pointer \
                 rests on it.</p>\n";
        page += &plots;
    }
    page += "<h2>Cases</h2>\n<p class=\"soft\">A click on a heading sorts, a click on a number opens the case.</p>\n";
    page + &table::html(plan, shown) + SCRIPT + END
}

/// What was changed and how the cases ended.
fn summary(spec: &Spec, counts: Counts) -> String {
    let Counts { cases, failed, missing } = counts;
    let how = if spec.zip { "in step" } else { "each value with each" };
    let axes: String = spec.set.iter().map(|axis| format!("<li>{}</li>\n", values(axis))).collect();
    let tallies = [
        ("cases", cases),
        ("ended well", cases - failed - missing),
        ("ended in an error", failed),
        ("without a result", missing),
    ];
    let tallies = tallies.iter().filter(|(what, count)| *count > 0 || *what == "ended well");
    let tallies: String = tallies.map(|(what, count)| format!("<li><b>{count}</b> {what}</li>\n")).collect();
    format!("<ul class=\"tally\">\n{tallies}</ul>\n<p>Changed, {how}:</p>\n<ul>\n{axes}</ul>\n")
}

/// A key with its values, or with the first and last where there are many.
fn values(axis: &Axis) -> String {
    const MOST_TOLD: usize = 12;
    let word = |value: &serde_json::Value| value.to_string().trim_matches('"').to_owned();
    let text = |value: &serde_json::Value| escape(&value.as_f64().map_or_else(|| word(value), short));
    let told = match axis.values.as_slice() {
        [first, .., last] if axis.values.len() > MOST_TOLD => {
            format!("{} values from {} to {}", axis.values.len(), text(first), text(last))
        }
        all => all.iter().map(text).collect::<Vec<_>>().join(", "),
    };
    format!("<code>{}</code>: {told}", escape(&axis.path))
}
