//! `wireframe`: the flat colour.

use super::{
    Uniforms,
    glsl::{Vec3, uniform},
};
use crate::lanes::Lane;

pub use super::default::position_only as vertex;

/// `wireframe.frag`
pub fn fragment<L: Lane>(u: &Uniforms) -> impl Fn(&[L; 0]) -> Vec3<L> + use<L> {
    let u_color = u.u_color;
    #[inline(always)]
    move |_| uniform(u_color)
}
