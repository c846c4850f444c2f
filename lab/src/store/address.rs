//! What a result depends on, as a number of 128 bits that names it.

use std::fmt;
use std::str::FromStr;

use drape::math::splitmix64;
use drape::version::VERSION;

/// A hash of all that a result depends on: FNV-1a, 128 bits, whose halves are mixed so that similar inputs have unlike
/// first digits. Among a million results the chance that two have the same is 1e-27.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Address(u128);

/// The start and the factor of FNV-1a.
const OFFSET: u128 = 0x6c62_272e_07bb_0142_62b8_2175_6295_c58d;
const PRIME: u128 = 0x0000_0000_0100_0000_0000_0000_0000_013b;

impl Address {
    /// The address of a result of `kind` that depends on `inputs` and on the version of the program, that of its results included.
    pub fn of(kind: &str, inputs: &str) -> Self {
        let text = format!("{} {kind} {inputs}", VERSION);
        Self(mixed(text.bytes().fold(OFFSET, |hash, byte| (hash ^ u128::from(byte)).wrapping_mul(PRIME))))
    }
}

/// Another number for each number (a Feistel network of three rounds).
fn mixed(hash: u128) -> u128 {
    #[expect(clippy::cast_possible_truncation, reason = "the two halves")]
    let (mut high, mut low) = ((hash >> 64) as u64, hash as u64);
    low ^= splitmix64(high);
    high ^= splitmix64(low);
    low ^= splitmix64(high);
    u128::from(high) << 64 | u128::from(low)
}

impl fmt::Display for Address {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:032x}", self.0)
    }
}

impl FromStr for Address {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let number = u128::from_str_radix(text, 16).ok().map(Self).filter(|found| found.to_string() == text);
        number.ok_or_else(|| format!("`{text}` is no address of 32 hexadecimal digits"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn similar_inputs_are_spread_over_the_first_digits() {
        let mut counts = [0_usize; 256];
        for n in 0..25_600 {
            counts[usize::from_str_radix(&Address::of("case", &n.to_string()).to_string()[..2], 16)
                .unwrap()] += 1;
        }
        assert!(counts.iter().all(|count| (50..150).contains(count)), "{counts:?}");
    }

    #[test]
    fn addresses_differ_and_read_back() {
        let all = [("run", "a"), ("run", "b"), ("ru", "na"), ("rung", "a")].map(|(k, i)| Address::of(k, i));
        assert!(all.iter().enumerate().all(|(i, a)| !all[..i].contains(a)), "{all:?}");
        assert_eq!(all.map(|address| address.to_string().parse()), all.map(Ok));
        for text in ["", "0", "-1", "0123456789ABCDEF0123456789abcdef", "0123456789abcdef0123456789abcdef0"] {
            assert!(text.parse::<Address>().is_err(), "{text}");
        }
    }
}
