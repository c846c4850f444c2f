//! How many digits the other program wrote, found from its numbers alone.

use super::states::State;

/// Significant digits and decimals from which on numbers count as whole: a binary64 has 15 to 17.
const WHOLE: usize = 15;

/// Part of a number that rounding to binary32, and writing that with as few digits as tell it from others, changes
/// at most.
const SINGLE: f64 = 1.0 / 8_388_608.0;

/// To how many digits numbers are rounded.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Precision {
    /// Most significant digits of a number, if fewer than [`WHOLE`].
    digits: Option<usize>,
    /// Most digits after the point, if fewer than [`WHOLE`].
    decimals: Option<usize>,
    /// Whether all are numbers of binary32, or those to nine digits.
    single: bool,
}

impl Precision {
    /// Numbers that are not rounded.
    pub(super) const WHOLE: Self = Self { digits: None, decimals: None, single: false };

    /// The precision of all finite numbers of `states`.
    pub(super) fn of(states: &[State]) -> Self {
        let numbers =
            || states.iter().flat_map(|state| state.as_flattened()).copied().filter(|x| x.is_finite());
        let digits = fewest(numbers(), |digits, x| format!("{x:.*e}", digits.saturating_sub(1)));
        let decimals = fewest(numbers(), |decimals, x| format!("{x:.decimals$}"));
        #[expect(clippy::cast_possible_truncation, reason = "what binary32 makes of it is the question")]
        let is_single = |x: f64| {
            let single = x as f32;
            single.to_string().parse() == Ok(x) || format!("{x:.8e}") == format!("{:.8e}", f64::from(single))
        };
        // Few digits fit any number of binary32, too.
        let single = digits.is_none_or(|digits| digits >= 8) && numbers().all(is_single);
        Self { digits, decimals, single }
    }

    /// How far a number `x` may be from what was rounded to it.
    pub(super) fn slack(&self, x: f64) -> f64 {
        let single = if self.single { SINGLE * x.abs() } else { 0.0 };
        let half = |exponent: i32| format!("0.5e{exponent}").parse().unwrap_or(0.0);
        // A part more than half of the last digit, for what the reading of both numbers rounds.
        let by_digits = self.digits.map_or(0.0, |digits| half(exponent(x) + 1 - whole(digits)));
        let by_decimals = self.decimals.map_or(0.0, |decimals| half(-whole(decimals)));
        1.001 * single.max(by_digits).max(by_decimals)
    }

    /// What the file has, if it is less than whole numbers: "6 digits".
    pub(super) fn words(&self) -> Option<String> {
        let plural = |count: usize, of: &str| format!("{count} {of}{}", if count == 1 { "" } else { "s" });
        match (self.single, self.digits, self.decimals) {
            (true, ..) => Some("32 bits (f32, about 7 digits)".to_owned()),
            (_, Some(digits), Some(decimals)) if decimals < digits => Some(plural(decimals, "decimal")),
            (_, Some(digits), _) => Some(plural(digits, "digit")),
            (_, None, Some(decimals)) => Some(plural(decimals, "decimal")),
            (_, None, None) => None,
        }
    }
}

/// The fewest digits with which `text` writes every number so that it reads back the same; none from
/// [`WHOLE`] on.
fn fewest(numbers: impl Iterator<Item = f64>, text: impl Fn(usize, f64) -> String) -> Option<usize> {
    let mut digits = 1;
    for x in numbers {
        while text(digits, x).parse() != Ok(x) {
            digits += 1;
            if digits == WHOLE {
                return None;
            }
        }
    }
    Some(digits)
}

/// The power of ten of the first digit of `x`; that of 1 for 0.
fn exponent(x: f64) -> i32 {
    let text = format!("{x:e}");
    text.split_once('e').filter(|_| x != 0.0).and_then(|(_, exponent)| exponent.parse().ok()).unwrap_or(0)
}

/// A number of digits, which is below [`WHOLE`].
fn whole(digits: usize) -> i32 {
    i32::try_from(digits).unwrap_or(i32::MAX)
}

#[cfg(test)]
mod tests {
    #![expect(clippy::cast_possible_truncation, reason = "what binary32 makes of a number is the question")]

    use super::*;
    use proptest::prelude::*;

    fn precision(numbers: &[f64]) -> Precision {
        Precision::of(&[numbers.chunks(3).map(|p| [p[0], p[1 % p.len()], p[2 % p.len()]]).collect()])
    }

    fn written(numbers: &[f64], text: impl Fn(f64) -> String) -> Vec<f64> {
        numbers.iter().map(|&x| text(x).parse().unwrap()).collect()
    }

    proptest! {
        #[test]
        fn what_was_rounded_lies_within_the_slack(
            numbers in prop::collection::vec(-3.0..3.0_f64, 30), digits in 3_usize..9,
        ) {
            let single = |x: f64| f64::from(x as f32);
            for rounded in [
                written(&numbers, |x| format!("{x:.*e}", digits - 1)),
                written(&numbers, |x| format!("{x:.digits$}")),
                numbers.iter().map(|&x| single(x)).collect(),
                written(&numbers, |x| format!("{:.8e}", single(x))),
            ] {
                let precision = precision(&rounded);
                prop_assert!(precision.words().is_some());
                for (x, rounded) in numbers.iter().zip(&rounded) {
                    let off = (x - rounded).abs();
                    prop_assert!(off <= precision.slack(*rounded), "{off} of {rounded}: {precision:?}");
                    prop_assert!(precision.slack(*rounded) < 0.02, "{precision:?}");
                }
            }
            let whole = precision(&numbers);
            prop_assert_eq!((whole.words(), whole.slack(numbers[0])), (None, 0.0));
        }
    }

    #[test]
    fn the_precision_is_named_as_it_was_written() {
        let numbers = [1.0, 0.123_456_789, -2.512_345_678, 3.333_333_333e-4, 0.5, 0.0];
        let words = |text: &dyn Fn(f64) -> String| precision(&written(&numbers, text)).words();
        assert_eq!(words(&|x| format!("{x:.5e}")).as_deref(), Some("6 digits"));
        assert_eq!(words(&|x| format!("{x:.4}")).as_deref(), Some("4 decimals"));
        assert_eq!(words(&|x| (x as f32).to_string()).as_deref(), Some("32 bits (f32, about 7 digits)"));
        assert_eq!(words(&|x| x.to_string()).as_deref(), Some("10 digits"), "as many as there are");
    }
}
