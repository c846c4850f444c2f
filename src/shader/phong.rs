//! `phong`: Blinn-Phong, ka + kd·c·(I/r²)·max(0, n·l) + ks·(I/r²)·max(0, n·h)^p (Blinn 1977).

use super::{
    Uniforms,
    glsl::{Vec3, dot, max, normalize, pow, uniform, vec3},
};
use crate::lanes::Lane;

pub use super::default::position_normal as vertex;

/// `blinn_phong` of `phong.frag`: the colour at `v_position` for the unit normal `n`.
#[inline(always)]
pub(super) fn blinn_phong<L: Lane>(u: &Uniforms, v_position: Vec3<L>, n: Vec3<L>) -> Vec3<L> {
    let Uniforms {
        u_cam_pos, u_color, u_light_pos, u_light_intensity, u_ka, u_kd, u_ks, u_shininess, ..
    } = *u;
    let to_light = uniform(u_light_pos) - v_position;
    let r2 = dot(to_light, to_light);
    let l = normalize(to_light);
    let v = normalize(uniform(u_cam_pos) - v_position);
    let h = normalize(l + v);
    let irradiance = uniform(u_light_intensity) * (L::splat(1.0) / r2);
    let diffuse = uniform(u_color) * irradiance * (L::splat(u_kd) * max(L::splat(0.0), dot(n, l)));
    let specular = irradiance * (L::splat(u_ks) * pow(max(L::splat(0.0), dot(n, h)), u_shininess));
    uniform([u_ka; 3]) + diffuse + specular
}

/// `phong.frag`
pub fn fragment<L: Lane>(u: &Uniforms) -> impl Fn(&[L; 6]) -> Vec3<L> + use<L> {
    let u = *u;
    #[inline(always)]
    move |&[x, y, z, nx, ny, nz]| {
        let (v_position, v_normal) = (vec3(x, y, z), vec3(nx, ny, nz));
        let n = normalize(v_normal);
        blinn_phong(&u, v_position, n)
    }
}
