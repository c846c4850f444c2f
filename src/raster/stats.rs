//! What drawing a picture took, in counts.

use std::{ops::AddAssign, time::Duration};

use serde::Serialize;

use super::{assemble::Chunk, primitives::Primitives, vertex::VertexBuffer};

/// What drawing a picture took. Counts are the same for any number of threads.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Stats {
    /// Vertices shaded.
    pub vertices: u64,
    /// Triangles submitted.
    pub triangles: u64,
    /// Lines submitted.
    pub lines: u64,
    /// Primitives outside of the view volume.
    pub outside: u64,
    /// Primitives cut by a plane of the view volume.
    pub clipped: u64,
    /// Primitives dropped for a NaN, infinite or far too large coordinate.
    pub non_finite: u64,
    /// Triangles dropped because their snapped corners span no area.
    pub degenerate: u64,
    /// Primitives dropped because they lie between the samples.
    pub no_sample: u64,
    /// Primitives that reached the tiles (those cut may be several).
    pub drawn: u64,
    /// Runs of a fragment program: pixels × primitives seen in them.
    pub fragments: u64,
    /// Pixels in which a primitive is seen.
    pub covered: u64,
}

/// What a tile took, or several.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct TileStats {
    pub(super) fragments: u64,
    pub(super) covered: u64,
    pub(super) raster: Duration,
    pub(super) shading: Duration,
}

impl AddAssign for TileStats {
    fn add_assign(&mut self, other: Self) {
        self.fragments += other.fragments;
        self.covered += other.covered;
        self.raster += other.raster;
        self.shading += other.shading;
    }
}

impl Stats {
    /// The counts of all stages.
    pub(super) fn of(
        calls: &[Primitives<'_>],
        buffers: &[VertexBuffer],
        chunks: &[Chunk],
        tiles: &[TileStats],
    ) -> Self {
        let mut stats = Self::default();
        for (call, buffer) in calls.iter().zip(buffers) {
            stats.vertices += buffer.positions.len() as u64;
            match call {
                Primitives::Triangles(all) => stats.triangles += all.len() as u64,
                Primitives::Lines(all) => stats.lines += all.len() as u64,
            }
        }
        for counts in chunks.iter().map(|chunk| chunk.counts) {
            stats.outside += counts.outside;
            stats.clipped += counts.clipped;
            stats.non_finite += counts.non_finite;
            stats.degenerate += counts.degenerate;
            stats.no_sample += counts.no_sample;
            stats.drawn += counts.drawn;
        }
        stats.fragments = tiles.iter().map(|tile| tile.fragments).sum();
        stats.covered = tiles.iter().map(|tile| tile.covered).sum();
        stats
    }
}
