//! What several commands do: a simulation that is watched, its table, its timings.

pub(crate) mod advance;
pub(crate) mod bench;
pub(crate) mod table;
