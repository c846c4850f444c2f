//! A reference cloth simulator and the software rasteriser that shows it.

pub mod camera;
pub mod cloth;
pub mod cubemap;
mod dispatch;
pub mod error;
pub mod lanes;
pub mod math;
pub mod mesh;
pub mod raster;
pub mod render;
pub mod scene;
pub mod shader;
pub mod texture;
pub mod texture_source;
