//! `wireframe`: the flat colour.

use super::Uniforms;
use crate::raster::NoVaryings;

pub use super::default::position_only as vertex;

crate::fragment_program! {
    /// `wireframe.frag`
    pub struct Fragment { u: Uniforms }
    |NoVaryings {}| u.u_color
}
