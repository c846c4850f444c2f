//! A share of the work, so that several runs can divide it: `K/N`.

use std::ops::Range;
use std::str::FromStr;

/// Part K of N, K from 1 to N.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Part {
    number: u64,
    of: u64,
}

impl Part {
    /// Everything.
    pub(crate) const WHOLE: Self = Self { number: 1, of: 1 };

    /// Whether this part takes piece `index` where the pieces go round.
    pub(crate) fn takes(self, index: u64) -> bool {
        index % self.of == self.number - 1
    }

    /// K from 0, and N.
    pub(crate) fn of(self) -> Option<[usize; 2]> {
        Some([usize::try_from(self.number - 1).ok()?, usize::try_from(self.of).ok()?])
    }

    /// The pieces of this part where each takes consecutive ones of `count`.
    pub(crate) fn range(self, count: u64) -> Range<u64> {
        let end = |number: u64| {
            let end = u128::from(count) * u128::from(number) / u128::from(self.of);
            u64::try_from(end).unwrap_or(count)
        };
        end(self.number - 1)..end(self.number)
    }
}

impl FromStr for Part {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let part = text.split_once('/').and_then(|(k, n)| Some((k.parse().ok()?, n.parse().ok()?)));
        match part {
            Some((number, of)) if (1..=of).contains(&number) => Ok(Self { number, of }),
            _ => Err("expected K/N with K from 1 to N, such as 3/16".to_owned()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_parts_share_all_pieces_and_none_twice() {
        for (of, count) in [(1, 0), (1, 5), (3, 10), (7, 3), (16, 1000), (2, u64::MAX)] {
            let parts: Vec<Part> = (1..=of).map(|number| Part { number, of }).collect();
            let ranges: Vec<_> = parts.iter().map(|part| part.range(count)).collect();
            assert_eq!((ranges[0].start, ranges.last().unwrap().end), (0, count));
            assert!(ranges.windows(2).all(|pair| pair[0].end == pair[1].start), "{ranges:?}");
            let lengths = ranges.iter().map(|range| range.end - range.start);
            assert!(lengths.clone().max().unwrap() - lengths.min().unwrap() <= 1, "{ranges:?}");
            for index in 0..count.min(1000) {
                assert_eq!(parts.iter().filter(|part| part.takes(index)).count(), 1);
            }
        }
    }

    #[test]
    fn a_part_is_one_of_several() {
        assert_eq!("3/16".parse(), Ok(Part { number: 3, of: 16 }));
        assert_eq!("1/1".parse(), Ok(Part::WHOLE));
        for text in ["", "/", "3", "0/3", "4/3", "1/0", "-1/3", "a/b", "1/2/3", "1.0/2"] {
            assert!(text.parse::<Part>().is_err(), "{text}");
        }
    }
}
