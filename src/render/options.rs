//! What is asked of a picture besides the scene, and the rounding of its numbers.

use crate::{mesh::SpringKinds, scene::Vec3};

/// What is asked of a picture besides the scene.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Options {
    /// Spring kinds that a wireframe shows; absent: those that the cloth has.
    pub springs: Option<SpringKinds>,
    /// Keep object and triangle ids.
    pub ids: bool,
    /// The arithmetic of the fragment stage.
    pub shading: Shading,
}

/// The arithmetic in which fragment programs run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Shading {
    /// binary32, as on a graphics card.
    #[default]
    F32,
    /// binary64, for measuring what binary32 loses: the same programs, uniforms and vertices.
    F64,
}

/// A vector of the scene as a uniform.
pub(super) fn round(v: Vec3) -> [f32; 3] {
    [v.x, v.y, v.z].map(to_f32)
}

/// A number of the scene as a uniform.
#[expect(clippy::cast_possible_truncation, reason = "uniforms are f32")]
pub(super) fn to_f32(value: f64) -> f32 {
    value as f32
}
