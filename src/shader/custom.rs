//! `custom`: a glossy ceramic. A displaced, textured base under a tinted highlight and a mirror:
//! a·(ka·q + kd·(I/r²)·max(0, n'·l)) + ks·q·(I/r²)·max(0, n'·h)^p + km·env(reflect(-v, n')).

use super::{
    Uniforms,
    bump::bumped_normal,
    glsl::{Vec3, dot, max, normalize, pow, reflect, uniform, vec3},
    sampler::{Sampler2d, SamplerCube, texture, texture_cube},
};
use crate::lanes::Lane;

pub use super::displacement::vertex;

/// `custom.frag`
pub fn fragment<'a, L: Lane>(
    u: &Uniforms,
    u_texture_1: Sampler2d<'a>,
    u_texture_2: Sampler2d<'a>,
    u_texture_cubemap: SamplerCube<'a>,
) -> impl Fn(&[L; 11]) -> Vec3<L> + use<'a, L> {
    let u = *u;
    #[inline(always)]
    move |&[x, y, z, nx, ny, nz, tx, ty, tz, s, t]| {
        let (v_position, v_normal, v_tangent) = (vec3(x, y, z), vec3(nx, ny, nz), vec3(tx, ty, tz));
        let v_uv = [s, t];
        let n = bumped_normal(&u, u_texture_2, v_normal, v_tangent, v_uv);
        let a = texture(u_texture_1, s, t);
        let q = normalize(uniform::<L>(u.u_light_color));
        let to_light = uniform(u.u_light_pos) - v_position;
        let r2 = dot(to_light, to_light);
        let l = normalize(to_light);
        let v = normalize(uniform(u.u_cam_pos) - v_position);
        let h = normalize(l + v);
        let irradiance = uniform(u.u_light_intensity) * (L::splat(1.0) / r2);
        let ambient = q * L::splat(u.u_ka);
        let diffuse = irradiance * (L::splat(u.u_kd) * max(L::splat(0.0), dot(n, l)));
        let specular =
            q * irradiance * (L::splat(u.u_ks) * pow(max(L::splat(0.0), dot(n, h)), u.u_shininess));
        let mirror = texture_cube(u_texture_cubemap, reflect(-v, n)) * L::splat(u.u_km);
        a * (ambient + diffuse) + specular + mirror
    }
}
