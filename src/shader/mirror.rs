//! `mirror`: the environment in the direction reflect(-v, n).

use super::{
    Uniforms,
    glsl::{Vec3, normalize, reflect, uniform, vec3},
    sampler::{SamplerCube, texture_cube},
};
use crate::lanes::Lane;

pub use super::default::position_normal as vertex;

/// `mirror.frag`
pub fn fragment<'a, L: Lane>(
    u: &Uniforms,
    u_texture_cubemap: SamplerCube<'a>,
) -> impl Fn(&[L; 6]) -> Vec3<L> + use<'a, L> {
    let u_cam_pos = u.u_cam_pos;
    #[inline(always)]
    move |&[x, y, z, nx, ny, nz]| {
        let (v_position, v_normal) = (vec3(x, y, z), vec3(nx, ny, nz));
        let n = normalize(v_normal);
        let v = normalize(uniform(u_cam_pos) - v_position);
        texture_cube(u_texture_cubemap, reflect(-v, n))
    }
}
