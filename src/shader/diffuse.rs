//! `diffuse`: Lambert's law, kd·c·(I/r²)·max(0, n·l).

use super::{
    Uniforms,
    glsl::{Vec3, dot, max, normalize, uniform, vec3},
};
use crate::lanes::Lane;

pub use super::default::position_normal as vertex;

/// `diffuse.frag`
pub fn fragment<L: Lane>(u: &Uniforms) -> impl Fn(&[L; 6]) -> Vec3<L> + use<L> {
    let Uniforms { u_color, u_light_pos, u_light_intensity, u_kd, .. } = *u;
    #[inline(always)]
    move |&[x, y, z, nx, ny, nz]| {
        let (v_position, v_normal) = (vec3(x, y, z), vec3(nx, ny, nz));
        let n = normalize(v_normal);
        let to_light = uniform(u_light_pos) - v_position;
        let r2 = dot(to_light, to_light);
        let l = normalize(to_light);
        let irradiance = uniform(u_light_intensity) * (L::splat(1.0) / r2);
        uniform(u_color) * irradiance * (L::splat(u_kd) * max(L::splat(0.0), dot(n, l)))
    }
}
