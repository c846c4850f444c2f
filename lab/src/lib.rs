//! What measures a cloth simulator: the study of speed against accuracy, the stability map, the
//! figures of the course report, the grader of other programs' positions, and the pages and plots
//! that show results.
//!
//! Everything here stands on the engine, the crate `drape`. Nothing here knows a terminal: long work
//! tells its progress through a callback, which can also end it with an error. A module uses only the
//! modules above it in this list.

#![forbid(unsafe_code)]

pub mod printable;
pub mod csv;
pub mod npy;
pub mod run;
pub mod store;
pub mod page;
pub mod sweep;
pub mod accuracy;
pub mod study;
pub mod horizon;
pub mod choose;
pub mod stability_map;
pub mod gallery;
pub mod grader;
