//! What a shader can read.

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
    /// Nothing.
    pub(super) const NOTHING: Self = Self {
        normal: false,
        tangent: false,
        uv: false,
        texture: false,
        height_map: false,
        environment: false,
    };

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
