//! The frame schedule of an animation.

use std::ops::Range;

use drape::output::provenance::Arguments;

/// Which simulated frame each picture shows.
///
/// An animation plays in real time: picture k shows the simulated frame nearest to k / fps seconds after
/// the first frame, and there are as many pictures as fit into the simulated time.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct FrameSchedule {
    frames: Range<u64>,
    fps: u16,
    /// Simulated frames per picture.
    stride: f64,
    count: u64,
}

impl FrameSchedule {
    /// The schedule of `frames`, simulated at `simulated` frames per second and shown at `fps` pictures
    /// per second.
    pub(crate) fn new(frames: Range<u64>, simulated: f64, fps: u16) -> Self {
        let stride = simulated / f64::from(fps);
        let length = frames.end.saturating_sub(frames.start);
        #[expect(clippy::cast_precision_loss, reason = "that many frames are never simulated")]
        let count = whole((length as f64 / stride).ceil());
        Self { frames, fps, stride, count }
    }

    /// How many pictures there are.
    pub(crate) fn count(&self) -> u64 {
        self.count
    }

    /// What makes this schedule of the same scene again.
    pub(crate) fn arguments(&self) -> Arguments {
        let frames = [self.frames.start, self.frames.end];
        Arguments { frames: Some(frames), fps: Some(self.fps), ..Arguments::default() }
    }

    /// The simulated frame that picture `k` shows.
    pub(crate) fn frame(&self, k: u64) -> u64 {
        #[expect(clippy::cast_precision_loss, reason = "that many pictures are never drawn")]
        let ahead = whole((k as f64 * self.stride).round());
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
        let schedule = FrameSchedule::new(frames, simulated, fps);
        (0..schedule.count()).map(|k| schedule.frame(k)).collect()
    }

    #[test]
    fn pictures_show_the_nearest_frame_in_real_time() {
        assert_eq!(shown(0..6, 90.0, 90), [0, 1, 2, 3, 4, 5]);
        assert_eq!(shown(10..20, 90.0, 30), [10, 13, 16, 19]);
        assert_eq!(shown(0..9, 90.0, 50), [0, 2, 4, 5, 7], "0, 1.8, 3.6, 5.4, 7.2");
        assert_eq!(shown(0..2, 30.0, 90), [0, 0, 1, 1, 1, 1], "the last frame is shown to its end");
        assert_eq!(shown(4..5, 90.0, 1), [4]);
        assert_eq!(FrameSchedule::new(0..180, 90.0, 30).count(), 60, "two seconds");
    }
}
