//! The table of cases, with the command of each.

use serde_json::Value;

use super::shown::Shown;
use crate::page::{escape, short};
use crate::sweep::measures::needs_ledger;
use crate::sweep::plan::Plan;
use crate::sweep::record::Measured;
use drape::scene::sweep::{Spec, Until};

/// The table, a row for each case.
pub(super) fn html(plan: &Plan, shown: &[Shown]) -> String {
    let spec = &plan.spec;
    let paths = spec.set.iter().map(|axis| axis.path.as_str());
    let names = ["case"].into_iter().chain(paths).chain(spec.measure.iter().map(String::as_str));
    let heads: String = names
        .chain(["exit", "message"])
        .map(|name| format!("<th><button>{}</button></th>", escape(name)))
        .collect();
    let rows: String = shown.iter().map(|shown| row(plan, shown)).collect();
    format!(
        "<div class=\"wide cases\"><table>\n<thead><tr>{heads}</tr></thead>\n<tbody>\n{rows}</tbody>\n</table></div>\n"
    )
}

fn row(plan: &Plan, shown: &Shown) -> String {
    let Shown { case, record, .. } = shown;
    let number = case.number + 1;
    let mut cells = format!("<td><a href=\"#case-{number}\" data-case=\"{number}\">{number}</a></td>");
    cells.extend(case.changes.iter().map(|(_, value)| cell(&value_text(value), &value_text(value))));
    for name in &plan.spec.measure {
        cells += &match record.as_ref().map(|record| record.value(name)) {
            Some(Measured::Number(number)) => cell(&number.to_string(), &short(*number)),
            Some(Measured::Text(text)) => cell(text, text),
            Some(Measured::Nothing) | None => cell("", ""),
        };
    }
    let (code, message) = match record {
        Some(record) => (record.exit_code.to_string(), record.message.as_str()),
        None => (String::new(), "no result"),
    };
    cells += &(cell(&code, &code) + &cell(message, message));
    let class = if code == "0" { "" } else { " class=\"bad\"" };
    let command = escape(&command(plan, &case.sets()));
    format!("<tr id=\"case-{number}\"{class} data-command=\"{command}\">{cells}</tr>\n")
}

/// A cell that shows `text` and sorts by `value`.
fn cell(value: &str, text: &str) -> String {
    if value == text {
        return format!("<td>{}</td>", escape(text));
    }
    format!("<td data-v=\"{}\">{}</td>", escape(value), escape(text))
}

fn value_text(value: &Value) -> String {
    value.as_str().map_or_else(|| value.to_string(), str::to_owned)
}

/// The command that repeats a case.
fn command(plan: &Plan, sets: &[String]) -> String {
    let spec: &Spec = &plan.spec;
    let mut words = vec!["drape".to_owned()];
    let scene = quoted(&plan.scene().name);
    let mut sets: Vec<String> = sets.iter().map(|set| quoted(set)).collect();
    let frames = match spec.until {
        Until::Scene => None,
        Until::Time(time) => Some(("--time", time.to_string())),
        Until::Frames(frames) if spec.render.is_some() => Some(("--frame", frames.to_string())),
        Until::Frames(frames) => Some(("--frames", frames.to_string())),
    };
    match &spec.render {
        Some(picture) => {
            words.extend(["render".to_owned(), scene, "case.png".to_owned()]);
            let [width, height] = picture.size;
            for (key, value) in &picture.material {
                match (key.as_str(), value.as_str()) {
                    ("shader", Some(shader)) => words.extend(["--shader".to_owned(), quoted(shader)]),
                    _ => sets.push(quoted(&format!("material.{key}={value}"))),
                }
            }
            words.extend(["--size".to_owned(), format!("{width}x{height}")]);
        }
        None => words.extend(["simulate".to_owned(), scene]),
    }
    words.extend(sets.into_iter().flat_map(|set| ["--set".to_owned(), set]));
    words.extend(frames.into_iter().flat_map(|(option, value)| [option.to_owned(), value]));
    if spec.render.is_none() && spec.measure.iter().any(|name| needs_ledger(name)) {
        words.push("--ledger".to_owned());
    }
    words.join(" ")
}

/// A word as a shell takes it.
fn quoted(word: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "._-/=,:+".contains(c);
    if !word.is_empty() && word.chars().all(plain) {
        return word.to_owned();
    }
    format!("'{}'", word.replace('\'', "'\\''"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_quoted_where_a_shell_would_change_them() {
        assert_eq!(quoted("cloth.ks=500"), "cloth.ks=500");
        assert_eq!(quoted("sim.gravity=[0,-1,0]"), "'sim.gravity=[0,-1,0]'");
        assert_eq!(quoted("it's"), "'it'\\''s'");
    }
}
