//! The shader programs. Each is a GLSL pair and, beside it under the same stem, its Rust counterpart
//! with the same names and the same order of statements.
//!
//! A program is two stages: the closure that `vertex(&Uniforms, …)` returns, from attributes to
//! `gl_Position` and varyings, and `Fragment`, from varyings to a linear colour. Varyings are structs
//! with the names of the GLSL; only those that a program reads exist. Fragment programs are generic over
//! [`crate::lanes::Lane`].

#![allow(clippy::similar_names, reason = "statements keep the names of their GLSL counterparts")]

pub mod bump;
pub mod custom;
pub mod default;
pub mod diffuse;
pub mod displacement;
#[cfg(test)]
mod levels;
pub mod mirror;
pub mod normal;
pub mod phong;
pub mod sampler;
pub mod texture;
mod uniforms;
pub mod wireframe;

pub use uniforms::Uniforms;
