//! A reference cloth simulator and the software rasteriser that shows it.

pub mod error;
pub mod math;
pub mod scene;

pub mod output;

pub mod cli;
