//! `default.vert`: world-space varyings. One function per set of varyings that a fragment program
//! reads, so that what it does not read is neither computed nor interpolated.

use super::Uniforms;
use crate::{
    glsl::{Vec3, transform, xyz},
    mesh::Attributes,
    raster::{NoVaryings, VertexOutput},
};

crate::varyings! {
    /// Of a picture without light.
    pub struct Textured { v_uv: vec2 }
}

crate::varyings! {
    /// The direction of the surface alone.
    pub struct Oriented { v_normal: vec3 }
}

crate::varyings! {
    /// Of a surface under a light, or in an environment.
    pub struct Lit { v_position: vec3, v_normal: vec3 }
}

crate::varyings! {
    /// Of a surface with a height map: all there are.
    pub struct Relief { v_position: vec3, v_normal: vec3, v_tangent: vec3, v_uv: vec2 }
}

/// `gl_Position` alone.
pub fn position_only(u: &Uniforms) -> impl Fn(&Attributes) -> VertexOutput<NoVaryings<f32>> + use<> {
    let u = *u;
    move |a| (gl_position(&u, world_position(&u, a.in_position)), NoVaryings::default())
}

/// `v_uv`
pub fn uv(u: &Uniforms) -> impl Fn(&Attributes) -> VertexOutput<Textured<f32>> + use<> {
    let u = *u;
    move |a| {
        let v_uv = a.in_uv;
        (gl_position(&u, world_position(&u, a.in_position)), Textured { v_uv })
    }
}

/// `v_normal`
pub fn normal(u: &Uniforms) -> impl Fn(&Attributes) -> VertexOutput<Oriented<f32>> + use<> {
    let u = *u;
    move |a| {
        let v_normal = world_direction(&u, a.in_normal);
        (gl_position(&u, world_position(&u, a.in_position)), Oriented { v_normal })
    }
}

/// `v_position`, `v_normal`
pub fn position_normal(u: &Uniforms) -> impl Fn(&Attributes) -> VertexOutput<Lit<f32>> + use<> {
    let u = *u;
    move |a| {
        let v_position = world_position(&u, a.in_position);
        let v_normal = world_direction(&u, a.in_normal);
        (gl_position(&u, v_position), Lit { v_position, v_normal })
    }
}

/// `v_position`, `v_normal`, `v_tangent`, `v_uv`
pub fn all(u: &Uniforms) -> impl Fn(&Attributes) -> VertexOutput<Relief<f32>> + use<> {
    let u = *u;
    move |a| all_at(&u, a, a.in_position)
}

/// All varyings of a vertex whose model-space position is `position`.
pub(super) fn all_at(u: &Uniforms, a: &Attributes, position: [f32; 3]) -> VertexOutput<Relief<f32>> {
    let v_position = world_position(u, position);
    let v_normal = world_direction(u, a.in_normal);
    let v_tangent = world_direction(u, a.in_tangent);
    let v_uv = a.in_uv;
    (gl_position(u, v_position), Relief { v_position, v_normal, v_tangent, v_uv })
}

/// `(u_model * vec4(p, 1.0)).xyz`
fn world_position(u: &Uniforms, p: [f32; 3]) -> Vec3<f32> {
    Vec3::from(xyz(transform(&u.u_model, p, 1.0)))
}

/// `normalize(mat3(u_model) * d)`
fn world_direction(u: &Uniforms, d: [f32; 3]) -> Vec3<f32> {
    let [x, y, z] = xyz(transform(&u.u_model, d, 0.0));
    let length = (x * x + y * y + z * z).sqrt();
    Vec3 { x: x / length, y: y / length, z: z / length }
}

/// `u_view_projection * vec4(v_position, 1.0)`
fn gl_position(u: &Uniforms, v_position: Vec3<f32>) -> [f32; 4] {
    transform(&u.u_view_projection, v_position.into(), 1.0)
}
