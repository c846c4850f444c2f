//! A simulation as the commands run it: checked at its start, stopped by signals, shown by progress, and
//! what is measured on the way.

pub(crate) mod start;
pub(crate) mod advance;
pub(crate) mod summary;
pub(crate) mod bench;
