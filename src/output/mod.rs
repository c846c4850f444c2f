//! What leaves the program: files that are whole or absent, pictures, meshes, raw numbers and
//! the comparison of pictures.

pub mod atomic;
pub mod axis;
pub mod compare;
pub mod csv;
pub mod html;
pub mod obj;
pub mod page;
pub mod plot;
pub mod png;
pub mod raw;
