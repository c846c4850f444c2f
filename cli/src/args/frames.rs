//! A range of simulated frames.

use std::ops::Range;
use std::str::FromStr;

/// Frames from A to B, without B: `A..B`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Frames(pub(crate) Range<u64>);

impl FromStr for Frames {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let ends = text.split_once("..").and_then(|(a, b)| Some((a.parse().ok()?, b.parse().ok()?)));
        match ends {
            Some((first, end)) if first < end => Ok(Self(first..end)),
            _ => Err("expected A..B with A below B, such as 0..180; B is not included".to_owned()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_have_two_ends_in_order() {
        assert_eq!("3..10".parse(), Ok(Frames(3..10)));
        for text in ["", "..", "3", "3..", "..3", "3..3", "4..3", "-1..3", "3..=4", "a..b", "0..1e3"] {
            assert!(text.parse::<Frames>().is_err(), "{text}");
        }
    }
}
