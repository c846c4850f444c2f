//! From a scene to a picture.

mod camera;
mod mesh;
mod metres;
mod renderer;
mod range;
