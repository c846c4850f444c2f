//! What a reader of an animation sees, as one number.

use drape::math::StateHash;

/// A hash over all pictures of an animation and how long each is shown.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Seen(StateHash);

impl Seen {
    /// Takes in a picture, three bytes a pixel from the top row on, and its time, a fraction of milliseconds.
    pub(crate) fn add(&mut self, rgb: &[u8], [numerator, denominator]: [u32; 2]) {
        let common = divisor(numerator, denominator).max(1);
        self.0.write(rgb);
        [numerator, denominator].iter().for_each(|part| self.0.write(&(part / common).to_le_bytes()));
    }

    /// The hash.
    pub(crate) fn hash(self) -> u64 {
        self.0.finish()
    }
}

/// The greatest common divisor.
fn divisor(a: u32, b: u32) -> u32 {
    if b == 0 { a } else { divisor(b, a % b) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_order_and_times_count() {
        let hash = |pictures: &[(u8, [u32; 2])]| {
            let mut seen = Seen::default();
            pictures.iter().for_each(|(grey, time)| seen.add(&[*grey; 3], *time));
            seen.hash()
        };
        assert_eq!(hash(&[(1, [1000, 90])]), hash(&[(1, [100, 9])]));
        let all = [
            hash(&[(1, [100, 9]), (2, [20, 1])]),
            hash(&[(2, [100, 9]), (1, [20, 1])]),
            hash(&[(1, [20, 1]), (2, [100, 9])]),
            hash(&[(1, [100, 9])]),
            hash(&[(1, [0, 0])]),
        ];
        assert!(all.iter().enumerate().all(|(i, a)| !all[..i].contains(a)), "{all:?}");
    }
}
