//! What leaves the program, as bytes: pictures, meshes, raw numbers, and the comparison of pictures.

pub mod compare;
pub mod obj;
pub mod png;
pub mod raw;
