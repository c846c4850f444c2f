//! `default.vert`: world-space varyings. One function per set of varyings that a fragment program
//! reads, so that what it does not read is neither computed nor interpolated.

use super::{
    Uniforms,
    glsl::{VertexOutput, transform, xyz},
};
use crate::mesh::Attributes;

/// `gl_Position` alone.
pub fn position_only(u: &Uniforms) -> impl Fn(&Attributes) -> VertexOutput<0> + use<> {
    let u = *u;
    move |a| (gl_position(&u, world_position(&u, a.in_position)), [])
}

/// `v_uv`
pub fn uv(u: &Uniforms) -> impl Fn(&Attributes) -> VertexOutput<2> + use<> {
    let u = *u;
    move |a| {
        let v_uv = a.in_uv;
        (gl_position(&u, world_position(&u, a.in_position)), v_uv)
    }
}

/// `v_normal`
pub fn normal(u: &Uniforms) -> impl Fn(&Attributes) -> VertexOutput<3> + use<> {
    let u = *u;
    move |a| {
        let v_normal = world_direction(&u, a.in_normal);
        (gl_position(&u, world_position(&u, a.in_position)), v_normal)
    }
}

/// `v_position`, `v_normal`
pub fn position_normal(u: &Uniforms) -> impl Fn(&Attributes) -> VertexOutput<6> + use<> {
    let u = *u;
    move |a| {
        let v_position = world_position(&u, a.in_position);
        let v_normal = world_direction(&u, a.in_normal);
        let ([x, y, z], [nx, ny, nz]) = (v_position, v_normal);
        (gl_position(&u, v_position), [x, y, z, nx, ny, nz])
    }
}

/// `v_position`, `v_normal`, `v_tangent`, `v_uv`
pub fn all(u: &Uniforms) -> impl Fn(&Attributes) -> VertexOutput<11> + use<> {
    let u = *u;
    move |a| all_at(&u, a, a.in_position)
}

/// All varyings of a vertex whose model-space position is `position`.
pub(super) fn all_at(u: &Uniforms, a: &Attributes, position: [f32; 3]) -> VertexOutput<11> {
    let v_position = world_position(u, position);
    let v_normal = world_direction(u, a.in_normal);
    let v_tangent = world_direction(u, a.in_tangent);
    let v_uv = a.in_uv;
    let ([x, y, z], [nx, ny, nz], [tx, ty, tz], [s, t]) = (v_position, v_normal, v_tangent, v_uv);
    (gl_position(u, v_position), [x, y, z, nx, ny, nz, tx, ty, tz, s, t])
}

/// `(u_model * vec4(p, 1.0)).xyz`
fn world_position(u: &Uniforms, p: [f32; 3]) -> [f32; 3] {
    xyz(transform(&u.u_model, p, 1.0))
}

/// `normalize(mat3(u_model) * d)`
fn world_direction(u: &Uniforms, d: [f32; 3]) -> [f32; 3] {
    let [x, y, z] = xyz(transform(&u.u_model, d, 0.0));
    let length = (x * x + y * y + z * z).sqrt();
    [x / length, y / length, z / length]
}

/// `u_view_projection * vec4(v_position, 1.0)`
fn gl_position(u: &Uniforms, v_position: [f32; 3]) -> [f32; 4] {
    transform(&u.u_view_projection, v_position, 1.0)
}
