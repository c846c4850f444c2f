//! `phong`: Blinn-Phong, ka + kd·c·(I/r²)·max(0, n·l) + ks·(I/r²)·max(0, n·h)^p (Blinn 1977).

use super::{Uniforms, default::Lit};
use crate::{
    glsl::{Vec3, dot, float, max, normalize, pow, vec3},
    lanes::Lane,
};

pub use super::default::position_normal as vertex;

/// `blinn_phong` of `phong.frag`: the colour at `v_position` for the unit normal `n`.
#[inline(always)]
pub(super) fn blinn_phong<L: Lane>(u: &Uniforms<L, Vec3<L>>, v_position: Vec3<L>, n: Vec3<L>) -> Vec3<L> {
    let to_light = u.u_light_pos - v_position;
    let r2 = dot(to_light, to_light);
    let l = normalize(to_light);
    let v = normalize(u.u_cam_pos - v_position);
    let h = normalize(l + v);
    let irradiance = u.u_light_intensity * (float(1.0) / r2);
    let diffuse = u.u_color * irradiance * (u.u_kd * max(0.0, dot(n, l)));
    let specular = irradiance * (u.u_ks * pow(max(0.0, dot(n, h)), u.u_shininess));
    vec3(u.u_ka, u.u_ka, u.u_ka) + diffuse + specular
}

/// `facing` of the GLSL files: the normal `n`, turned round where the surface faces away from the camera and both
/// sides are lit.
#[inline(always)]
pub(super) fn facing<L: Lane>(
    u: &Uniforms<L, Vec3<L>>,
    n: Vec3<L>,
    v_normal: Vec3<L>,
    v_position: Vec3<L>,
) -> Vec3<L> {
    // The same for all fragments: where it is off, nothing is computed.
    if u.u_two_sided == 0.0 {
        return n;
    }
    let side = dot(v_normal, u.u_cam_pos - v_position) * u.u_two_sided;
    let zero = side.all(0.0);
    let turned = |x: L| side.select_less(zero, -x, x);
    vec3(turned(n.x), turned(n.y), turned(n.z))
}

crate::fragment_program! {
    /// `phong.frag`
    pub struct Fragment { u: Uniforms }
    |Lit { v_position, v_normal }| {
        let n = facing(&u, normalize(v_normal), v_normal, v_position);
        blinn_phong(&u, v_position, n)
    }
}
