//! Six square pictures that surround the scene.

use crate::error::{Error, Kind, Result};
use crate::texture::Texture;

/// Names of the faces, in the order in which they are kept: +x, -x, +y, -y, +z, -z.
pub const FACES: [&str; 6] = ["posx", "negx", "posy", "negy", "posz", "negz"];

/// An environment: one square texture for each side of a cube seen from its middle.
///
/// Faces are laid out by table 8.19 of the OpenGL 4.6 specification (section 8.13); the first row
/// of a face is t = 0.
#[derive(Clone, Debug, PartialEq)]
pub struct Cubemap {
    faces: [Texture; 6],
    size: usize,
}

impl Cubemap {
    /// A cube map called `name` of `faces` in the order of [`FACES`].
    ///
    /// # Errors
    /// [`Kind::Scene`] if a face is not square or differs in size from the first.
    pub fn new(name: &str, faces: [Texture; 6]) -> Result<Self> {
        let size = faces[0].width();
        for (face, texture) in FACES.iter().zip(&faces) {
            let (width, height) = (texture.width(), texture.height());
            if width != height {
                return Err(invalid(name, face, width, height, "not square"));
            }
            if width != size {
                let why = format!("differs from {}, which is {size} x {size}", FACES[0]);
                return Err(invalid(name, face, width, height, &why));
            }
        }
        Ok(Self { faces, size })
    }

    /// The faces, in the order of [`FACES`].
    pub fn faces(&self) -> &[Texture; 6] {
        &self.faces
    }

    /// Texels along each side of each face, at least 1.
    pub fn size(&self) -> usize {
        self.size
    }
}

fn invalid(name: &str, face: &str, width: usize, height: usize, why: &str) -> Error {
    let message = format!("cube map {name}: face {face} is {width} x {height}: {why}");
    Error::new(Kind::Scene, message).with_help("all six faces must be square and of one size")
}
