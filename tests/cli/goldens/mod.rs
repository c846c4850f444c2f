//! What the golden tests are made of.

pub(crate) mod files;
pub(crate) mod program;
