//! `displacement`: bump, and the surface itself moved by the height map along its normal.

use super::{
    Uniforms, default,
    glsl::VertexOutput,
    sampler::{Sampler2d, texture},
};
use crate::mesh::Attributes;

pub use super::bump::fragment;

/// `displacement.vert`: the position moves, normal and tangent stay.
pub fn vertex<'a>(
    u: &Uniforms,
    u_texture_2: Sampler2d<'a>,
) -> impl Fn(&Attributes) -> VertexOutput<11> + use<'a> {
    let u = *u;
    move |a| {
        let [s, t] = a.in_uv;
        let height = texture(u_texture_2, s, t).x;
        let lift = height * u.u_height_scaling;
        let displaced = std::array::from_fn(|i| a.in_position[i] + a.in_normal[i] * lift);
        default::all_at(&u, a, displaced)
    }
}
