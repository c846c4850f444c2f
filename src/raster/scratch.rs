//! Memory that a thread uses for one tile after the other.

use super::{fragments::FragmentList, handle::Handle, resolve::Pixels, stats::TileStats};

/// Memory that a thread uses for one tile after the other, and what the tiles took.
#[derive(Clone, Debug, Default)]
pub(super) struct Scratch {
    pub(super) visible: Vec<Handle>,
    /// Of pixels that see one primitive.
    pub(super) list: FragmentList,
    /// Of pixels that may see several.
    pub(super) shared: FragmentList,
    pub(super) pixels: Pixels,
    pub(super) stats: TileStats,
}
