//! What a result depends on, as a number of 128 bits that names it.

use std::fmt;
use std::str::FromStr;

/// A hash of all that a result depends on: FNV-1a, 128 bits. Among a million results the chance that two have the same
/// is 1e-27.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Address(u128);

/// The start and the factor of FNV-1a.
const OFFSET: u128 = 0x6c62_272e_07bb_0142_62b8_2175_6295_c58d;
const PRIME: u128 = 0x0000_0000_0100_0000_0000_0000_0000_013b;

impl Address {
    /// The address of a result of `kind` that depends on `inputs` and on the version of the program.
    pub fn of(kind: &str, inputs: &str) -> Self {
        let text = format!("{} {kind} {inputs}", env!("CARGO_PKG_VERSION"));
        Self(text.bytes().fold(OFFSET, |hash, byte| (hash ^ u128::from(byte)).wrapping_mul(PRIME)))
    }
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
    fn addresses_differ_and_read_back() {
        let all = [("run", "a"), ("run", "b"), ("ru", "na"), ("rung", "a")].map(|(k, i)| Address::of(k, i));
        assert!(all.iter().enumerate().all(|(i, a)| !all[..i].contains(a)), "{all:?}");
        assert_eq!(all.map(|address| address.to_string().parse()), all.map(Ok));
        for text in ["", "0", "-1", "0123456789ABCDEF0123456789abcdef", "0123456789abcdef0123456789abcdef0"] {
            assert!(text.parse::<Address>().is_err(), "{text}");
        }
    }
}
