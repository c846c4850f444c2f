//! What a report shows and counts.

use crate::sweep::case::Case;
use crate::sweep::record::Record;

/// Most cases that the page shows one by one: as many as a browser scrolls and sorts at once. Plots are over all.
pub(super) const MOST_SHOWN: u64 = 1000;

/// What a report counted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Cases of the plan.
    pub cases: u64,
    /// Cases that ended in an error.
    pub failed: u64,
    /// Cases without a result.
    pub missing: u64,
}

/// A case with what the page shows of it.
pub(super) struct Shown {
    pub(super) case: Case,
    pub(super) record: Option<Record>,
    /// The bytes of its picture.
    pub(super) picture: Option<Vec<u8>>,
}
