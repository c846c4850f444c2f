//! `mirror`: the environment in the direction reflect(-v, n).

use super::{
    Uniforms,
    default::Lit,
    sampler::{SamplerCube, texture_cube},
};
use crate::glsl::{normalize, reflect};

pub use super::default::position_normal as vertex;

crate::fragment_program! {
    /// `mirror.frag`
    pub struct Fragment<'a> { u: Uniforms, u_texture_cubemap: SamplerCube<'a> }
    |Lit { v_position, v_normal }| {
        let n = normalize(v_normal);
        let v = normalize(u.u_cam_pos - v_position);
        texture_cube(u_texture_cubemap, reflect(-v, n))
    }
}
