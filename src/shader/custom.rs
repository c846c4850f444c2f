//! `custom`: a glossy ceramic. A displaced, textured base under a tinted highlight and a mirror:
//! a·(ka·q + kd·(I/r²)·max(0, n'·l)) + ks·q·(I/r²)·max(0, n'·h)^p + km·env(reflect(-v, n')).

use super::{
    Uniforms,
    bump::bumped_normal,
    default::Relief,
    phong::facing,
    sampler::{Sampler2d, SamplerCube, texture, texture_cube},
};
use crate::glsl::{dot, float, max, normalize, pow, reflect};

pub use super::displacement::vertex;

crate::fragment_program! {
    /// `custom.frag`
    pub struct Fragment<'a> {
        u: Uniforms,
        u_texture_1: Sampler2d<'a>,
        u_texture_2: Sampler2d<'a>,
        u_texture_cubemap: SamplerCube<'a>,
    }
    |Relief { v_position, v_normal, v_tangent, v_uv }| {
        let n = bumped_normal(&u, u_texture_2, v_normal, v_tangent, v_uv);
        let n = facing(&u, n, v_normal, v_position);
        let a = texture(u_texture_1, v_uv);
        let q = normalize(u.u_light_color);
        let to_light = u.u_light_pos - v_position;
        let r2 = dot(to_light, to_light);
        let l = normalize(to_light);
        let v = normalize(u.u_cam_pos - v_position);
        let h = normalize(l + v);
        let irradiance = u.u_light_intensity * (float(1.0) / r2);
        let ambient = q * u.u_ka;
        let diffuse = irradiance * (u.u_kd * max(0.0, dot(n, l)));
        let specular = q * irradiance * (u.u_ks * pow(max(0.0, dot(n, h)), u.u_shininess));
        let mirror = texture_cube(u_texture_cubemap, reflect(-v, n)) * u.u_km;
        a * (ambient + diffuse) + specular + mirror
    }
}
