//! Numbers of simulated frames, and ranges of them.

use std::ops::Range;
use std::str::FromStr;

/// The largest number of a frame; one more is the end of a range.
const LAST: u64 = u64::MAX - 1;

/// The number of a frame, or how many frames.
pub(crate) fn frame(text: &str) -> Result<u64, String> {
    let number = text.parse().ok().filter(|&number| number <= LAST);
    number.ok_or_else(|| format!("allowed: a whole number from 0 to {LAST}"))
}

/// Frames from A to B, without B: `A..B`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Frames(pub(crate) Range<u64>);

impl FromStr for Frames {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let ends = text.split_once("..").and_then(|(a, b)| Some((frame(a).ok()?, b.parse().ok()?)));
        match ends {
            Some((first, end)) if first < end => Ok(Self(first..end)),
            _ => Err(format!(
                "expected A..B with A below B, such as 0..180; B is not included, and at most {}",
                u64::MAX
            )),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_have_two_ends_in_order() {
        assert_eq!("3..10".parse(), Ok(Frames(3..10)));
        assert_eq!("0..18446744073709551615".parse(), Ok(Frames(0..u64::MAX)));
        let wrong = ["", "..", "3", "3..", "..3", "3..3", "4..3", "-1..3", "3..=4", "a..b", "0..1e3"];
        for text in wrong.into_iter().chain(["0..18446744073709551616"]) {
            assert!(
                text.parse::<Frames>().is_err_and(|why| why.contains("at most 18446744073709551615")),
                "{text}"
            );
        }
    }

    #[test]
    fn the_limit_of_a_number_is_named() {
        assert_eq!([frame("0"), frame("18446744073709551614")], [Ok(0), Ok(LAST)]);
        for text in ["18446744073709551615", "99999999999999999999999", "-1", "1.5", ""] {
            assert!(frame(text).is_err_and(|why| why.contains("from 0 to 18446744073709551614")), "{text}");
        }
    }
}
