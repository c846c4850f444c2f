//! A reference cloth simulator and the software rasteriser that shows it.

pub mod cloth;
pub mod error;
pub mod math;
pub mod scene;
pub mod simulation;
