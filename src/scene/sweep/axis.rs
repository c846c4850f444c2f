//! A key of the scene with its values: a list, or a range.

use serde_json::{Value, json};

use super::super::json::choice::{choice, choices};
use super::super::json::finding::Finding;
use super::super::json::node::{Json, Member};
use super::super::json::number::number;
use super::super::json::range::{ANY, SMALLEST};
use super::super::json::rule::{At, Rule};
use super::super::json::scalar::Count;
use crate::math::{exp, ln};

/// Most values of a range.
const MOST: u32 = 1_000_000;

/// Most values of all ranges of a sweep together: a short file can ask for more than fit into memory.
pub(super) const MOST_IN_ALL: u32 = 4 * MOST;

/// A key of the scene and the values that it takes.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// Dotted path of the key, such as `cloth.ks`.
    pub path: String,
    /// Its values, at least one.
    pub values: Vec<Value>,
    /// How the values are spaced; lists are linear.
    pub scale: Scale,
}

choices! {
    /// How the values of a range are spaced (`scale`).
    pub enum Scale {
        /// By equal differences.
        Linear = "linear",
        /// By equal ratios.
        Log = "log",
    }
}

/// What the values of a key are, in words.
pub(super) const WORDS: &str = "a list of values, or a range {\"from\", \"to\", \"count\", \"scale\"}";

impl Axis {
    /// Reads the values of the key at `path`. A range takes from the values that are `left` for all ranges.
    pub(super) fn read(path: &str, at: &mut At, left: &mut u32) -> Option<Self> {
        let path = path.to_owned();
        match &at.node.json {
            Json::List(items) if items.is_empty() => {
                at.not_allowed("sweep::no_values", WORDS, "give a value")
            }
            Json::List(items) => {
                let values = items.iter().map(|item| item.plain()).collect();
                Some(Self { path, values, scale: Scale::Linear })
            }
            Json::Object(_) => {
                let (values, scale) = read_range(at, left)?;
                Some(Self { path, values, scale })
            }
            _ => at.wrong_type(WORDS),
        }
    }
}

/// The values of a range and its scale.
fn read_range(at: &mut At, left: &mut u32) -> Option<(Vec<Value>, Scale)> {
    let members = at.node.members()?;
    for member in members {
        if !["from", "to", "count", "scale"].contains(&member.key.as_str()) {
            let message = format!("unknown key `{}.{}`", at.key, member.key);
            let finding = Finding::new("scene::unknown_key", message)
                .at(member.key_span, "not a key of a range")
                .key(at.key)
                .help("the keys here are from, to, count, scale");
            at.diagnostics.error(finding);
            return None;
        }
    }
    let from = value(at, members, "from", ANY)?;
    let to = value(at, members, "to", ANY)?;
    let count = value(at, members, "count", Count(1, MOST))?;
    let scale = match members.iter().any(|member| member.key == "scale") {
        true => value(at, members, "scale", choice::<Scale>())?,
        false => Scale::Linear,
    };
    if scale == Scale::Log && (from < SMALLEST || to < SMALLEST) {
        return at.not_allowed("sweep::log_of_zero", "a range above 0 where `scale` is \"log\"", "");
    }
    let Some(rest) = left.checked_sub(count) else {
        let words = format!("shorter: all ranges together have at most {MOST_IN_ALL} values");
        return at.not_allowed("sweep::too_many_values", &words, "give fewer values");
    };
    *left = rest;
    Some((spaced([from, to], count, scale).into_iter().map(number).collect(), scale))
}

/// The value of a key of a range.
fn value<R: Rule>(at: &mut At, members: &[Member], name: &str, rule: R) -> Option<R::Value> {
    let key = format!("{}.{name}", at.key);
    let Some(member) = members.iter().find(|member| member.key == name) else {
        let finding = Finding::new("scene::missing_key", format!("`{}` is missing `{name}`", at.key))
            .at(at.node.span.first(), "in the object that starts here")
            .key(key)
            .help(format!("`{name}` is {}", rule.words()));
        at.diagnostics.error(finding);
        return None;
    };
    rule.read(&mut At { diagnostics: at.diagnostics, key: &key, node: &member.value })
}

/// So many numbers from one to another, both included, each rounded to 12 digits but for the ends.
fn spaced([from, to]: [f64; 2], count: u32, scale: Scale) -> Vec<f64> {
    let last = count - 1;
    let place = |i: u32| {
        let part = f64::from(i) / f64::from(last.max(1));
        match scale {
            _ if i == 0 => from,
            _ if i == last => to,
            Scale::Linear => rounded(from + (to - from) * part),
            Scale::Log => rounded(from * exp(ln(to / from) * part)),
        }
    };
    (0..count).map(place).collect()
}

/// `value` with 12 digits.
fn rounded(value: f64) -> f64 {
    format!("{value:.11e}").parse().unwrap_or(value)
}

/// A range as a JSON schema.
pub(super) fn schema() -> Value {
    let range = json!({ "type": "object", "required": ["from", "to", "count"], "additionalProperties": false,
        "properties": { "from": ANY.schema(), "to": ANY.schema(), "count": Count(1, MOST).schema(),
            "scale": choice::<Scale>().schema() } });
    json!({ "anyOf": [{ "type": "array", "minItems": 1 }, range] })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_have_both_ends_and_round_numbers_between() {
        assert_eq!(spaced([0.0, 1.0], 11, Scale::Linear)[3], 0.3);
        assert_eq!(spaced([500.0, 50_000.0], 3, Scale::Log), [500.0, 5000.0, 50_000.0]);
        assert_eq!(spaced([1e-3, 1e3], 7, Scale::Log), [1e-3, 1e-2, 0.1, 1.0, 10.0, 100.0, 1000.0]);
        assert_eq!(spaced([3.0, 3.0], 1, Scale::Log), [3.0]);
        assert_eq!(
            spaced([1.0 / 3.0, -1.0], 2, Scale::Linear),
            [1.0 / 3.0, -1.0],
            "the ends stay as they are"
        );
    }
}
