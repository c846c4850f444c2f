//! `texture`: the colour texture alone.

use super::{
    default::Textured,
    sampler::{Sampler2d, texture},
};

pub use super::default::uv as vertex;

crate::fragment_program! {
    /// `texture.frag`
    pub struct Fragment<'a> { u_texture_1: Sampler2d<'a> }
    |Textured { v_uv }| texture(u_texture_1, v_uv)
}
