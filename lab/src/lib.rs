//! What measures a cloth simulator: the study of speed against accuracy, the map of stability, the
//! figures of the report, and the pages and plots that show them.
//!
//! Everything here stands on the engine, the crate `drape`, and nothing of it knows a terminal.

pub mod csv;
pub mod page;
pub mod stability_map;
pub mod study;
pub mod gallery;
