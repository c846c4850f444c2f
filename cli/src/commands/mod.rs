//! The commands, one file each.

mod cells;
pub(crate) mod animate;
pub(crate) mod check;
pub(crate) mod choose;
pub(crate) mod compare;
pub(crate) mod compare_positions;
pub(crate) mod export;
pub(crate) mod gallery;
pub(crate) mod unlit;
pub(crate) mod horizon;
pub(crate) mod info;
pub(crate) mod meta;
mod positions;
pub(crate) mod render;
pub(crate) mod simulate;
pub(crate) mod stability;
pub(crate) mod study;
pub(crate) mod sweep;
pub(crate) mod verify;
