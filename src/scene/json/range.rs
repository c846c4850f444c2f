//! Numbers in a range, with their unit.

use serde_json::{Value, json};

use super::node::Json;
use super::number::number;
use super::rule::{At, Rule};

/// Largest magnitude of any number: squares and sums of such numbers stay finite.
const LARGEST: f64 = 1e15;
/// Smallest number that counts as above 0: quotients by such numbers stay finite.
pub(crate) const SMALLEST: f64 = 1e-15;

/// Any number.
pub(crate) const ANY: Range = Range { min: -LARGEST, max: LARGEST, unit: "" };
/// Numbers above 0.
pub(crate) const POSITIVE: Range = Range { min: SMALLEST, max: LARGEST, unit: "" };
/// 0 and above.
pub(crate) const NOT_NEGATIVE: Range = Range { min: 0.0, max: LARGEST, unit: "" };

/// The numbers `min..=max`, in `unit`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Range {
    min: f64,
    max: f64,
    unit: &'static str,
}

/// The numbers `min..=max`.
pub(crate) const fn from_to(min: f64, max: f64) -> Range {
    Range { min, max, unit: "" }
}

impl Range {
    /// The same range with a unit.
    pub(crate) const fn unit(self, unit: &'static str) -> Self {
        Self { unit, ..self }
    }

    /// Whether `value` lies in the range; NaN and infinities never do.
    fn contains(&self, value: f64) -> bool {
        (self.min..=self.max).contains(&value)
    }

    /// The range in words: "from 0 to 100 %".
    pub(crate) fn bounds(&self) -> String {
        let space = if self.unit.is_empty() { "" } else { " " };
        let lower = if self.min == SMALLEST { "above 0, from" } else { "from" };
        format!("{lower} {} to {}{space}{}", short(self.min), short(self.max), self.unit)
    }
}

impl Rule for Range {
    type Value = f64;

    fn words(&self) -> String {
        format!("a number {}", self.bounds())
    }

    fn read(&self, at: &mut At) -> Option<f64> {
        match at.node.json {
            Json::Number(value) if self.contains(value) => Some(value),
            Json::Number(_) => at.not_allowed("scene::out_of_range", &self.bounds(), ""),
            _ => at.wrong_type(&self.words()),
        }
    }

    fn schema(&self) -> Value {
        json!({ "type": "number", "minimum": self.min, "maximum": self.max })
    }

    fn json(&self, value: &f64) -> Value {
        number(*value)
    }

    fn placeholder(&self) -> f64 {
        self.min
    }
}

/// The shorter of the plain and the scientific form.
fn short(value: f64) -> String {
    let (plain, scientific) = (format!("{value}"), format!("{value:e}"));
    if scientific.len() < plain.len() { scientific } else { plain }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_name_ends_and_unit() {
        assert_eq!(from_to(0.0, 100.0).unit("%").bounds(), "from 0 to 100 %");
        assert_eq!(POSITIVE.unit("m").bounds(), "above 0, from 1e-15 to 1e15 m");
        assert_eq!(ANY.bounds(), "from -1e15 to 1e15");
    }

    #[test]
    fn ends_are_inside_and_nothing_beyond() {
        let range = from_to(0.0, 1.0);
        assert!(range.contains(0.0) && range.contains(-0.0) && range.contains(1.0));
        for out in [-1e-300, 1.0 + f64::EPSILON, f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            assert!(!range.contains(out), "{out}");
        }
    }
}
