//! Which simulated frames an animation shows.

use std::ops::Range;
use std::str::FromStr;

/// Simulated frames from the first up to, but without, the last: `A..B`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Frames(pub(crate) Range<u64>);

impl FromStr for Frames {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let ends = text.split_once("..").and_then(|(a, b)| Some((a.parse().ok()?, b.parse().ok()?)));
        match ends {
            Some((first, end)) if first < end => Ok(Self(first..end)),
            _ => Err("frames are A..B with A below B, such as 0..180; B itself is not shown".to_owned()),
        }
    }
}

/// The moments that the pictures of an animation show.
///
/// It plays in real time: picture k shows the simulated frame nearest to k / fps seconds after the
/// first one, and there are as many pictures as the simulated time fills.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Moments {
    frames: Range<u64>,
    /// Simulated frames from one picture to the next.
    pace: f64,
    count: u64,
}

impl Moments {
    /// The moments of `frames`, simulated at `simulated` frames a second and shown at `fps` pictures a
    /// second.
    pub(crate) fn new(frames: Range<u64>, simulated: f64, fps: u16) -> Self {
        let pace = simulated / f64::from(fps);
        let length = frames.end.saturating_sub(frames.start);
        #[expect(clippy::cast_precision_loss, reason = "that many frames are never simulated")]
        let count = whole((length as f64 / pace).ceil());
        Self { frames, pace, count }
    }

    /// How many pictures there are.
    pub(crate) fn count(&self) -> u64 {
        self.count
    }

    /// The simulated frame that picture `k` shows.
    pub(crate) fn frame(&self, k: u64) -> u64 {
        #[expect(clippy::cast_precision_loss, reason = "that many pictures are never drawn")]
        let ahead = whole((k as f64 * self.pace).round());
        self.frames.start.saturating_add(ahead).min(self.frames.end.saturating_sub(1))
    }
}

/// A number that is not negative as an integer; too large a one as the largest.
fn whole(value: f64) -> u64 {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "saturates")]
    let whole = value as u64;
    whole
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shown(frames: Range<u64>, simulated: f64, fps: u16) -> Vec<u64> {
        let moments = Moments::new(frames, simulated, fps);
        (0..moments.count()).map(|k| moments.frame(k)).collect()
    }

    #[test]
    fn pictures_show_the_nearest_frame_in_real_time() {
        assert_eq!(shown(0..6, 90.0, 90), [0, 1, 2, 3, 4, 5]);
        assert_eq!(shown(10..20, 90.0, 30), [10, 13, 16, 19]);
        assert_eq!(shown(0..9, 90.0, 50), [0, 2, 4, 5, 7], "0, 1.8, 3.6, 5.4, 7.2");
        assert_eq!(shown(0..2, 30.0, 90), [0, 0, 1, 1, 1, 1], "the last frame is shown to its end");
        assert_eq!(shown(4..5, 90.0, 1), [4]);
        assert_eq!(Moments::new(0..180, 90.0, 30).count(), 60, "two seconds");
    }

    #[test]
    fn ranges_have_two_ends_in_order() {
        assert_eq!("3..10".parse(), Ok(Frames(3..10)));
        for text in ["", "..", "3", "3..", "..3", "3..3", "4..3", "-1..3", "3..=4", "a..b", "0..1e3"] {
            assert!(text.parse::<Frames>().is_err(), "{text}");
        }
    }
}
