//! The files that a command writes: each is complete or absent, and all are checked before long work.

pub(crate) mod target;
mod temporary;
pub(crate) mod numbered;
pub(crate) mod atomic;
pub(crate) mod staged;
pub(crate) mod outputs;
