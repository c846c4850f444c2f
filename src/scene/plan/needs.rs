//! What each shader reads.

use crate::scene::material::Shader;

/// What a shader reads besides the position.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Needs {
    /// Vertex normals.
    pub normal: bool,
    /// Vertex tangents.
    pub tangent: bool,
    /// Texture coordinates.
    pub uv: bool,
    /// The colour texture.
    pub texture: bool,
    /// The height map.
    pub height_map: bool,
    /// The cube map.
    pub environment: bool,
}

impl Needs {
    /// What `shader` reads.
    pub fn of(shader: Shader) -> Self {
        let nothing = Self::default();
        let normal = Self { normal: true, ..nothing };
        let relief = Self { normal: true, tangent: true, uv: true, height_map: true, ..nothing };
        match shader {
            Shader::Wireframe => nothing,
            Shader::Normal | Shader::Diffuse | Shader::Phong => normal,
            Shader::Texture => Self { uv: true, texture: true, ..nothing },
            Shader::Bump | Shader::Displacement => relief,
            Shader::Mirror => Self { environment: true, ..normal },
            Shader::Custom => Self { texture: true, environment: true, ..relief },
        }
    }

    /// Each thing a shader can read, with its name and whether it is read.
    pub(super) fn named(self) -> [(&'static str, bool); 6] {
        [
            ("normals", self.normal),
            ("tangents", self.tangent),
            ("texture coordinates", self.uv),
            ("texture", self.texture),
            ("height map", self.height_map),
            ("environment", self.environment),
        ]
    }
}
