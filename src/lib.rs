//! A reference cloth simulator and the software rasteriser that shows it.

pub mod error;
pub mod math;
pub mod scene;
pub mod cloth;
pub mod simulation;
pub mod texture;
pub mod cubemap;
pub mod texture_source;
mod dispatch;
pub mod lanes;
pub mod mesh;
pub mod camera;
pub mod shader;
pub mod raster;
pub mod render;
pub mod output;
pub mod cli;
