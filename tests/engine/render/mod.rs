//! From a scene to a picture.

mod camera;
mod mesh;
mod renderer;
mod range;
