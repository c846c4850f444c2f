//! From a file's name to a [`Scene`]: reads, patches, validates.

use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

use super::json::diagnostic::Diagnostics;
use super::json::finding::Finding;
use super::json::node::Node;
use super::json::object;
use super::json::parse::parse;
use super::json::span::Span;
use super::json::suggest::nearest;
use super::keys::keys;
use super::{Scene, patch, stock, validate};
use crate::error::{Diagnostic, Error, Kind, Result};

/// Largest scene or patch file, in bytes.
pub const MAX_FILE: u64 = 16 << 20;

/// Changes to a scene from outside its file: all patches in order, then all sets in order.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Overrides {
    /// Files with a JSON merge patch each (RFC 7396). There `null` removes a key.
    pub patches: Vec<PathBuf>,
    /// `PATH=JSON` each, such as `cloth.ks=500`, `sphere.0.radius=0.1` or `material.shader=bump`
    /// (a bare word is text). The value replaces what is there; `null` is a value like any other.
    pub sets: Vec<String>,
}

/// A valid scene and what is doubtful in it.
#[derive(Clone, Debug, PartialEq)]
pub struct Loaded {
    /// The scene.
    pub scene: Scene,
    /// What is allowed but probably not meant.
    pub warnings: Vec<Diagnostic>,
}

/// Loads the scene file `path`, changed by `overrides`.
///
/// # Errors
/// [`Kind::Scene`] with every diagnostic if the file, a patch or a set is not valid;
/// [`Kind::Io`] if a file cannot be read; [`Kind::Usage`] if a set is not of the form `PATH=JSON`.
pub fn load(path: &Path, overrides: &Overrides) -> Result<Loaded> {
    assemble(&path.display().to_string(), &read(path)?, overrides, read)
}

/// Loads a scene as [`load`] does in the repository's folder, but from the files built into the
/// program: `path` and the patches are `scenes/sphere.json`, `scenes/look/ball.json` and the like.
///
/// # Errors
/// As [`load`]; [`Kind::Io`] if no built-in file has that path.
pub fn load_stock(path: &Path, overrides: &Overrides) -> Result<Loaded> {
    assemble(&path.display().to_string(), &stock::read(path)?, overrides, stock::read)
}

/// Loads a scene from `text`, which errors call `name`, changed by `overrides`.
///
/// # Errors
/// As [`load`].
///
/// ```
/// use drape::scene::{Overrides, load_text};
///
/// let scene = load_text("empty", "{}", &Overrides::default())?.scene;
/// assert_eq!(scene.sim.fps, 90.0);
///
/// let error = load_text("typo", r#"{"camera": {"polr": 60}}"#, &Overrides::default()).unwrap_err();
/// assert_eq!(error.diagnostics[0].help, "did you mean `polar`?");
/// # Ok::<(), drape::error::Error>(())
/// ```
pub fn load_text(name: &str, text: &str, overrides: &Overrides) -> Result<Loaded> {
    assemble(name, text.as_bytes(), overrides, read)
}

/// The scene of a file's bytes, whose patches `read` finds.
fn assemble(
    name: &str,
    bytes: &[u8],
    overrides: &Overrides,
    read: impl Fn(&Path) -> Result<Vec<u8>>,
) -> Result<Loaded> {
    let mut diagnostics = Diagnostics::default();
    let document = file(&mut diagnostics, name, bytes);
    let mut patches = Vec::new();
    for path in &overrides.patches {
        patches.push(file(&mut diagnostics, &path.display().to_string(), &read(path)?));
    }
    let mut sets = Vec::new();
    for argument in &overrides.sets {
        sets.push(patch::read_set(&mut diagnostics, argument)?);
    }
    let texts = document.zip(patches.into_iter().collect::<Option<Vec<_>>>());
    let scene =
        texts.zip(sets.into_iter().collect::<Option<Vec<_>>>()).and_then(|((document, patches), sets)| {
            let mut document = patches.into_iter().fold(document, patch::merge);
            sets.into_iter().for_each(|set| patch::apply(&mut diagnostics, &mut document, set));
            read_scene(&mut diagnostics, &document)
        });
    let warnings = diagnostics.finish()?;
    let scene = scene.ok_or_else(|| Error::new(Kind::Internal, "no scene and no error"))?;
    Ok(Loaded { scene, warnings })
}

fn read_scene(diagnostics: &mut Diagnostics, document: &Node) -> Option<Scene> {
    let scene = object::read(diagnostics, document, keys, Scene::read)?;
    validate::validate(diagnostics, document, &scene);
    Some(scene)
}

/// The bytes of a file, at most one more than allowed.
fn read(path: &Path) -> Result<Vec<u8>> {
    let mut bytes = Vec::new();
    File::open(path).and_then(|file| file.take(MAX_FILE + 1).read_to_end(&mut bytes)).map_err(|e| {
        let error = Error::new(Kind::Io, format!("cannot read {}: {e}", path.display()));
        error.with_help(neighbor(path).unwrap_or_default())
    })?;
    Ok(bytes)
}

/// "did you mean `scenes/sphere.json`?" if that is not there and a file with nearly that name is.
fn neighbor(path: &Path) -> Option<String> {
    if path.exists() {
        return None;
    }
    let folder = path.parent()?;
    let listed = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    let entries = listed.read_dir().ok()?.flatten();
    let mut names: Vec<String> = entries.filter_map(|entry| entry.file_name().into_string().ok()).collect();
    names.sort_unstable();
    let near = nearest(path.file_name()?.to_str()?, names.iter().map(String::as_str))?;
    Some(format!("did you mean `{}`?", folder.join(near).display()))
}

/// The JSON value of a file's bytes; nothing, after an error, if they are not JSON in UTF-8.
fn file(diagnostics: &mut Diagnostics, name: &str, bytes: &[u8]) -> Option<Node> {
    if bytes.len() as u64 > MAX_FILE {
        let place = Span { source: diagnostics.add_source(name, ""), start: 0, end: 0 };
        let message = format!("the file is larger than {MAX_FILE} bytes");
        diagnostics.error(Finding::new("scene::too_large", message).at(place, "not read"));
        return None;
    }
    let text = String::from_utf8_lossy(bytes);
    let source = diagnostics.add_source(name, &*text);
    let wrong = if let Err(error) = std::str::from_utf8(bytes) {
        let start = error.valid_up_to();
        Some((start..start + char::REPLACEMENT_CHARACTER.len_utf8(), "not valid UTF-8"))
    } else if text.starts_with('\u{feff}') {
        Some((0..'\u{feff}'.len_utf8(), "the file starts with a byte order mark"))
    } else if text.trim_ascii().is_empty() {
        Some((0..0, "the file is empty"))
    } else {
        None
    };
    match wrong {
        None => parse(diagnostics, source, 0),
        Some((range, message)) => {
            let place = Span { source, start: range.start, end: range.end };
            diagnostics.error(Finding::new("scene::syntax", message).at(place, "here"));
            None
        }
    }
}
