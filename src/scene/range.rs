//! Ranges of numbers, with their unit, and the words that errors use for them.

/// Largest magnitude of any number of a scene: squares and sums of such numbers stay finite.
const LARGEST: f64 = 1e15;
/// Smallest number that counts as above 0: quotients by such numbers stay finite.
pub(super) const SMALLEST: f64 = 1e-15;

/// Any number.
pub(super) const ANY: Range = Range { min: -LARGEST, max: LARGEST, unit: "" };
/// Numbers above 0.
pub(super) const POSITIVE: Range = Range { min: SMALLEST, max: LARGEST, unit: "" };
/// 0 and above.
pub(super) const NOT_NEGATIVE: Range = Range { min: 0.0, max: LARGEST, unit: "" };

/// The numbers `min..=max`, in `unit`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Range {
    pub(super) min: f64,
    pub(super) max: f64,
    unit: &'static str,
}

/// The numbers `min..=max`.
pub(super) const fn from_to(min: f64, max: f64) -> Range {
    Range { min, max, unit: "" }
}

impl Range {
    /// The same range with a unit.
    pub(super) const fn unit(self, unit: &'static str) -> Self {
        Self { unit, ..self }
    }

    /// Whether `value` lies in the range; NaN and infinities never do.
    pub(super) fn contains(&self, value: f64) -> bool {
        (self.min..=self.max).contains(&value)
    }

    /// The range in words: "from 0 to 100 %".
    pub(super) fn words(&self) -> String {
        let space = if self.unit.is_empty() { "" } else { " " };
        let lower = if self.min == SMALLEST { "above 0, from" } else { "from" };
        format!("{lower} {} to {}{space}{}", short(self.min), short(self.max), self.unit)
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
        assert_eq!(from_to(0.0, 100.0).unit("%").words(), "from 0 to 100 %");
        assert_eq!(POSITIVE.unit("m").words(), "above 0, from 1e-15 to 1e15 m");
        assert_eq!(ANY.words(), "from -1e15 to 1e15");
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
