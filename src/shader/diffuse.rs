//! `diffuse`: Lambert's law, kd·c·(I/r²)·max(0, n·l).

use super::{Uniforms, default::Lit, phong::facing};
use crate::glsl::{dot, float, max, normalize};

pub use super::default::position_normal as vertex;

crate::fragment_program! {
    /// `diffuse.frag`
    pub struct Fragment { u: Uniforms }
    |Lit { v_position, v_normal }| {
        let n = facing(&u, normalize(v_normal), v_normal, v_position);
        let to_light = u.u_light_pos - v_position;
        let r2 = dot(to_light, to_light);
        let l = normalize(to_light);
        let irradiance = u.u_light_intensity * (float(1.0) / r2);
        u.u_color * irradiance * (u.u_kd * max(0.0, dot(n, l)))
    }
}
