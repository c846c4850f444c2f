//! Where textures come from: the set inside the program, or a folder of one's own.

use std::collections::BTreeMap;
use std::path::{Component, Path, PathBuf};

use crate::bounded;
use crate::cubemap::{Cubemap, FACES};
use crate::error::{Error, Kind, Result};
use crate::texture::{Texture, check_all_texels};

/// Endings that are tried in a folder, in this order.
const ENDINGS: [&str; 3] = ["png", "jpg", "jpeg"];

/// Largest texture file, bytes.
const MAX_FILE_BYTES: u64 = 1 << 29;

/// Most names of a folder that an error lists.
const MAX_LISTED: usize = 20;

/// A built-in file: its name and its bytes.
macro_rules! built_in {
    ($($name:literal),*) => {
        [$(($name, include_bytes!(concat!("../textures/", $name, ".png")).as_slice())),*]
    };
}

const TEXTURES: [(&str, &[u8]); 4] = built_in!["texture_1", "texture_2", "texture_3", "texture_4"];

/// The name of the built-in cube map.
const BUILT_IN_CUBE: &str = "cube";

/// Faces of the built-in cube map, in the order of [`FACES`].
const CUBE: [(&str, &[u8]); 6] =
    built_in!["cube/posx", "cube/negx", "cube/posy", "cube/negy", "cube/posz", "cube/negz"];

/// Where textures are looked for. Only what is asked for is opened.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum TextureSource {
    /// The set inside the program: `texture_1` (a sunset), `texture_2` (the height of a stone wall),
    /// `texture_3` (a plaid), `texture_4` (a grid for texture coordinates) and the cube map `cube`.
    BuiltIn,
    /// A folder. `NAME.png`, else `NAME.jpg`, else `NAME.jpeg` is the texture called NAME, and a
    /// folder NAME in it with such files for `posx`, `negx`, `posy`, `negy`, `posz` and `negz` is
    /// the cube map called NAME.
    Folder(PathBuf),
    /// Files in memory, by name, such as `plaid` or `sky/posx`; what is not among them is the built-in one.
    Memory(BTreeMap<String, Vec<u8>>),
}

impl TextureSource {
    /// Every file that may be read for the textures `names`; none where they come from no folder.
    pub fn files<'a>(&self, names: impl Iterator<Item = &'a String>) -> Vec<PathBuf> {
        let Self::Folder(folder) = self else { return Vec::new() };
        let paths = names.flat_map(|name| ENDINGS.map(|ending| folder.join(format!("{name}.{ending}"))));
        paths.filter(|path| path.is_file()).collect()
    }

    /// The texture called `name`.
    ///
    /// # Errors
    /// [`Kind::Scene`] if there is none or it cannot be decoded; [`Kind::Io`] if it cannot be read.
    pub fn texture(&self, name: &str) -> Result<Texture> {
        match self {
            Self::BuiltIn => built_in_texture(name),
            Self::Folder(folder) => {
                check_name(name)?;
                read_texture(folder, name)
            }
            Self::Memory(files) => match files.get(name) {
                Some(bytes) => Texture::decode(name, bytes),
                None => built_in_texture(name),
            },
        }
    }

    /// The cube map called `name`.
    ///
    /// # Errors
    /// As [`texture`](Self::texture) for each face, and [`Kind::Scene`] if the faces do not fit.
    pub fn cubemap(&self, name: &str) -> Result<Cubemap> {
        let read: &dyn Fn(usize) -> Result<Texture> = match self {
            Self::Memory(files) if files.contains_key(&format!("{name}/{}", FACES[0])) => {
                &|face| in_memory(files, &format!("{name}/{}", FACES[face]))
            }
            Self::BuiltIn | Self::Memory(_) if is_built_in_cubemap(name) => {
                &|face| Texture::decode(CUBE[face].0, CUBE[face].1)
            }
            Self::BuiltIn | Self::Memory(_) => return Err(unknown("cube map", name, BUILT_IN_CUBE)),
            Self::Folder(folder) => {
                check_name(name)?;
                &|face| read_texture(&folder.join(name), FACES[face])
            }
        };
        let first = read(0)?;
        // The others must be as large: whether all are too large is known before they are read.
        check_all_texels(first.texels().len() as u64 * FACES.len() as u64)?;
        Cubemap::new(name, [first, read(1)?, read(2)?, read(3)?, read(4)?, read(5)?])
    }
}

fn in_memory(files: &BTreeMap<String, Vec<u8>>, name: &str) -> Result<Texture> {
    match files.get(name) {
        Some(bytes) => Texture::decode(name, bytes),
        None => Err(Error::new(Kind::Scene, format!("there is no texture {name}"))
            .with_help(format!("a cube map has six files: {}", FACES.join(", ")))),
    }
}

fn built_in_texture(name: &str) -> Result<Texture> {
    match TEXTURES.iter().find(|(known, _)| *known == name) {
        Some((_, bytes)) => Texture::decode(name, bytes),
        None => Err(unknown("texture", name, &TEXTURES.map(|(known, _)| known).join(", "))),
    }
}

fn unknown(what: &str, name: &str, known: &str) -> Error {
    Error::new(Kind::Scene, format!("there is no built-in {what} {name:?}"))
        .with_help(format!("built in: {known}; --textures DIR takes all from a folder of your own"))
}

/// Whether a texture of this name is built in.
pub fn is_built_in_texture(name: &str) -> bool {
    TEXTURES.iter().any(|(known, _)| *known == name)
}

/// Whether a cube map of this name is built in.
pub fn is_built_in_cubemap(name: &str) -> bool {
    name == BUILT_IN_CUBE
}

/// A name stands for one entry of the folder and may not lead out of it.
fn check_name(name: &str) -> Result<()> {
    let mut parts = Path::new(name).components();
    match (parts.next(), parts.next()) {
        (Some(Component::Normal(part)), None) if part == name => Ok(()),
        _ => Err(Error::new(Kind::Scene, format!("{name:?} is not the name of a texture"))
            .with_help("a name is a file name without folder and ending, such as texture_1")),
    }
}

fn read_texture(folder: &Path, name: &str) -> Result<Texture> {
    let files = ENDINGS.map(|ending| folder.join(format!("{name}.{ending}")));
    match files.iter().find(|file| file.is_file()) {
        Some(file) => Texture::decode(&file.display().to_string(), &read(file)?),
        None => Err(missing(folder, name)),
    }
}

/// The bytes of a file.
fn read(file: &Path) -> Result<Vec<u8>> {
    let failed = |why| Error::new(Kind::Io, format!("cannot read texture {}: {why}", file.display()));
    bounded::read(file, MAX_FILE_BYTES).map_err(failed)
}

fn missing(folder: &Path, name: &str) -> Error {
    let [png, jpg, jpeg] = ENDINGS.map(|ending| format!("{name}.{ending}"));
    let message =
        format!("there is no texture {name} in {}: looked for {png}, {jpg} and {jpeg}", folder.display());
    let advice = "a folder replaces the whole built-in set: copy what you want to keep of it from textures/ of \
                  the source, or name a texture that is there";
    Error::new(Kind::Scene, message).with_help(format!("{}; {advice}", holdings(folder)))
}

/// One sentence that says what a folder holds.
fn holdings(folder: &Path) -> String {
    let Ok(entries) = std::fs::read_dir(folder) else {
        return "the folder does not exist or cannot be read".to_owned();
    };
    let mut names: Vec<_> = entries.flatten().map(|e| e.file_name().to_string_lossy().into_owned()).collect();
    names.sort_unstable();
    let more = names.len().saturating_sub(MAX_LISTED);
    names.truncate(MAX_LISTED);
    match (names.is_empty(), more) {
        (true, _) => "the folder is empty".to_owned(),
        (false, 0) => format!("the folder holds {}", names.join(", ")),
        (false, _) => format!("the folder holds {} and {more} more", names.join(", ")),
    }
}
