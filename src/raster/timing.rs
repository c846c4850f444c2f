//! What drawing a picture took, in time: measured where it is asked for, and nowhere else.

use std::time::{Duration, Instant};

use super::stats::TileStats;

/// Wall time per stage of a picture. Rasterising and shading alternate within a tile; their shares of
/// the tiles' wall time are those of their summed processor time.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Stages {
    /// Vertex programs.
    pub vertex: Duration,
    /// Clipping, set-up and binning.
    pub setup: Duration,
    /// Clearing, coverage and depth.
    pub raster: Duration,
    /// Interpolation, fragment programs and resolve.
    pub shading: Duration,
}

/// Tells the time since some moment.
pub(super) trait Clock: Sync {
    /// The time.
    fn now(&self) -> Duration;
}

/// No clock: it is always the same moment.
pub(super) struct NoClock;

/// The time since the clock was made.
pub(super) struct WallClock(pub(super) Instant);

impl Clock for NoClock {
    fn now(&self) -> Duration {
        Duration::ZERO
    }
}

impl Clock for WallClock {
    fn now(&self) -> Duration {
        self.0.elapsed()
    }
}

impl Stages {
    /// The stages between four moments, the last of them shared out by what the tiles took.
    pub(super) fn between([started, shaded, binned, ended]: [Duration; 4], tiles: &[TileStats]) -> Self {
        let raster: Duration = tiles.iter().map(|tile| tile.raster).sum();
        let shading: Duration = tiles.iter().map(|tile| tile.shading).sum();
        let share = (ended - binned).div_duration_f64((raster + shading).max(Duration::from_nanos(1)));
        Self {
            vertex: shaded - started,
            setup: binned - shaded,
            raster: raster.mul_f64(share),
            shading: shading.mul_f64(share),
        }
    }
}
