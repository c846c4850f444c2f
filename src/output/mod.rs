//! What leaves the program, as bytes: pictures, meshes, raw numbers, and the comparison of pictures.

pub mod provenance;
pub mod png;
pub mod compare;
pub mod part;
pub mod obj;
pub mod ply;
pub mod gltf;
pub mod raw;
