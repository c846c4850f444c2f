//! A reference cloth simulator and the software rasteriser that shows it.

pub mod error;
pub mod math;
pub mod scene;

pub mod texture;

pub mod cubemap;

pub mod texture_source;

pub mod output;

pub mod cli;
