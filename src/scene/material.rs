//! What an object looks like.

use super::json::choice::{choice, choices};
use super::json::keys::keys;
use super::json::list::Vector;
use super::json::object::{Object, defaults};
use super::json::range::{ANY, NOT_NEGATIVE};
use super::json::scalar::{Flag, Name};
use super::shader::Shader;
use crate::math::Vec3;

keys! {
    /// What an object looks like: a shader and the constants of its formula.
    pub struct Material {
        /// The program that colours the object.
        shader: Shader => [Shader::Phong] choice::<Shader>();
        /// Surface colour of `wireframe`, and of the diffuse light of `diffuse`, `phong`, `bump` and `displacement`.
        /// Planes are light grey, 0.7, if it is left out.
        ///
        /// Linear, per channel.
        color: Vec3 => [Vec3::repeat(1.0)] Vector(NOT_NEGATIVE);
        /// Weight of the ambient light, which is the same everywhere.
        ka: f64 => [0.1] NOT_NEGATIVE;
        /// Weight of the diffuse light, which is strongest where the surface faces the light.
        kd: f64 => [0.7] NOT_NEGATIVE;
        /// Weight of the highlight. Not the stiffness, which is `cloth.ks`.
        ks: f64 => [1.0] NOT_NEGATIVE;
        /// Exponent of the highlight: the larger it is, the smaller and sharper the highlight.
        shininess: f64 => [64.0] NOT_NEGATIVE;
        /// Weight of the mirror image in `custom`.
        km: f64 => [0.25] NOT_NEGATIVE;
        /// How much steeper than the height map says `bump`, `displacement` and `custom` shade a slope; it
        /// is multiplied by `height_scaling`. The default is that of the course and hardly shows in `bump`; the figures
        /// of the report have 100.
        ///
        /// `kn` of the formulas.
        normal_scaling: f64 => [2.0] ANY;
        /// How far a white pixel of the height map lifts the surface in `displacement` and `custom`, in metres
        /// on the cloth and in drawn radii on a ball; a factor of the slopes in `bump` too. The default is that of the
        /// course and makes lumps of 10 cm; the figures of the report have 0.02 or 0.03.
        ///
        /// `kh` of the formulas.
        height_scaling: f64 => [0.1] ANY;
        /// The colour picture of `texture` and `custom`, as its file name without extension. Built in are
        /// `texture_1` (a sunset), `texture_2` (the heights of a stone wall), `texture_3` (a plaid) and
        /// `texture_4` (a grid of coordinates); `--textures DIR` reads others.
        texture: String => ["texture_1".into()] Name;
        /// The height map of `bump`, `displacement` and `custom`, named as `texture` is; its red channel is
        /// the height.
        height_map: String => ["texture_2".into()] Name;
        /// The six pictures around the scene that `mirror` and `custom` show: the name of a folder in
        /// `--textures DIR` with `posx.png`, `negx.png` and so on; `cube` is built in.
        environment: String => ["cube".into()] Name;
        /// Which way the relief of `bump`, `displacement` and `custom` is lit along v.
        bitangent: Bitangent => [Bitangent::NormalCrossTangent] choice::<Bitangent>();
        /// Whether the side that faces the camera is lit, whichever that is: the normal is turned round where it
        /// faces away. By default only the side of the normal is lit, and the other shows what that would.
        two_sided: bool => [false] Flag;
    }
}

choices! {
    /// The direction in which a relief is taken to rise with v (`material.bitangent`).
    pub enum Bitangent {
        /// `cross(normal, tangent)`, the formula of the course. On every mesh v runs the other way, so slopes along v
        /// are lit from the wrong side: a light from above shades what it should light.
        NormalCrossTangent = "normal_cross_tangent",
        /// The direction in which v grows: a relief is lit from the right side everywhere.
        Uv = "uv",
    }
}

impl Material {
    /// Reads the material of a plane: light grey unless a colour is given.
    pub(super) fn read_grey(at: &mut Object) -> Self {
        let grey = (!at.has("color")).then_some(Vec3::repeat(0.7));
        let material = Self::read(at);
        Self { color: grey.unwrap_or(material.color), ..material }
    }
}

impl Default for Material {
    /// The material of an object about which a scene file says nothing.
    fn default() -> Self {
        defaults(Self::read)
    }
}
