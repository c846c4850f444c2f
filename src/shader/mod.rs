//! The shader programs. Each is a GLSL pair and, beside it under the same stem, a Rust closure
//! with the same names and the same order of statements.
//!
//! A program is two functions: `vertex(&Uniforms)` and `fragment(&Uniforms)`. Each returns a
//! closure over its uniforms: the vertex stage from attributes to `gl_Position` and varyings, the
//! fragment stage from varyings to a linear colour. Varyings are plain arrays, so that the
//! rasteriser interpolates them without knowing what they mean; only those that a program reads
//! exist. Fragment programs are generic over [`crate::lanes::Lane`].

#![allow(clippy::similar_names, reason = "statements keep the names of their GLSL counterparts")]

pub mod bump;
pub mod custom;
pub mod default;
pub mod diffuse;
pub mod displacement;
pub mod glsl;
pub mod mirror;
pub mod normal;
pub mod phong;
pub mod sampler;
pub mod texture;
pub mod wireframe;

use crate::camera::Columns;
use glsl::Exponent;

/// The uniforms of all programs but the samplers, named as in the GLSL files. A program that
/// reads a texture takes its sampler as an argument, so none can be missing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Uniforms {
    /// Model space to world space.
    pub u_model: Columns,
    /// World space to clip space.
    pub u_view_projection: Columns,
    /// Eye, world space, metres.
    pub u_cam_pos: [f32; 3],
    /// Surface colour c.
    pub u_color: [f32; 3],
    /// Light position, world space, metres.
    pub u_light_pos: [f32; 3],
    /// Light intensity I per channel.
    pub u_light_intensity: [f32; 3],
    /// Colour of the light, for the glossy ceramic.
    pub u_light_color: [f32; 3],
    /// Ambient weight.
    pub u_ka: f32,
    /// Diffuse weight.
    pub u_kd: f32,
    /// Specular weight.
    pub u_ks: f32,
    /// Specular exponent p.
    pub u_shininess: Exponent,
    /// Mirror weight.
    pub u_km: f32,
    /// kn: scales the slope of the height map.
    pub u_normal_scaling: f32,
    /// kh: height of a white texel, model units.
    pub u_height_scaling: f32,
}
