//! `displacement`: bump, and the surface itself moved by the height map along its normal.

use super::{
    Uniforms,
    default::{self, Relief},
    sampler::{Sampler2d, texture},
};
use crate::{mesh::Attributes, raster::VertexOutput};

pub use super::bump::Fragment;

/// `displacement.vert`: the position moves, normal and tangent stay.
pub fn vertex<'a>(
    u: &Uniforms,
    u_texture_2: Sampler2d<'a>,
) -> impl Fn(&Attributes) -> VertexOutput<Relief<f32>> + use<'a> {
    let u = *u;
    move |a| {
        let height = texture(u_texture_2, a.in_uv).x;
        let lift = height * u.u_height_scaling;
        let displaced = std::array::from_fn(|i| a.in_position[i] + a.in_normal[i] * lift);
        default::all_at(&u, a, displaced)
    }
}
