//! `normal`: the normal as a colour, (n + 1)/2.

use super::{
    Uniforms,
    glsl::{Vec3, normalize, uniform, vec3},
};
use crate::lanes::Lane;

pub use super::default::normal as vertex;

/// `normal.frag`
pub fn fragment<L: Lane>(_u: &Uniforms) -> impl Fn(&[L; 3]) -> Vec3<L> + use<L> {
    #[inline(always)]
    move |&[x, y, z]| {
        let v_normal = vec3(x, y, z);
        let n = normalize(v_normal);
        (n + uniform([1.0; 3])) * L::splat(0.5)
    }
}
