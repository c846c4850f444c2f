//! What leaves the program: files that are whole or absent, pictures and animations, meshes, raw
//! numbers and the comparison of pictures.

pub mod animation;
pub mod apng;
pub mod atomic;
pub mod axis;
pub mod compare;
pub mod csv;
pub mod gif;
pub mod html;
pub mod mp4;
pub mod obj;
pub mod page;
pub mod plot;
pub mod png;
pub mod raw;
pub mod sequence;
pub mod staged;
