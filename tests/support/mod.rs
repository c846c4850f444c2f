//! What the golden tests are made of.

pub(crate) mod golden;
pub(crate) mod program;
