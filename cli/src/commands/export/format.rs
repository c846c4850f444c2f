//! The formats of meshes.

use std::path::Path;

use drape::error::{Error, Kind, Result};

/// A format, by the ending of the file's name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Format {
    /// Wavefront OBJ; also what has no ending.
    Obj,
    /// PLY.
    Ply,
    /// Binary glTF 2.0.
    Glb,
}

impl Format {
    /// The format of a path.
    ///
    /// # Errors
    /// [`Kind::Usage`] when no format has its ending.
    pub(super) fn of(path: &Path) -> Result<Self> {
        match path.extension().map(|ending| ending.to_string_lossy().to_lowercase()).as_deref() {
            None | Some("obj") => Ok(Self::Obj),
            Some("ply") => Ok(Self::Ply),
            Some("glb") => Ok(Self::Glb),
            Some(_) => {
                let message = format!("`{}` does not end in .obj, .ply or .glb", path.display());
                Err(Error::new(Kind::Usage, message).with_help("name a file with one of these endings"))
            }
        }
    }
}
