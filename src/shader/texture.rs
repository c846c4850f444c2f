//! `texture`: the colour texture alone.

use super::{
    Uniforms,
    glsl::Vec3,
    sampler::{Sampler2d, texture},
};
use crate::lanes::Lane;

pub use super::default::uv as vertex;

/// `texture.frag`
pub fn fragment<'a, L: Lane>(
    _u: &Uniforms,
    u_texture_1: Sampler2d<'a>,
) -> impl Fn(&[L; 2]) -> Vec3<L> + use<'a, L> {
    #[inline(always)]
    move |v_uv| texture(u_texture_1, v_uv[0], v_uv[1])
}
