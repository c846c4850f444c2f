//! From a file's name to a [`Scene`]: reads, patches, validates.

use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use super::json::diagnostic::Diagnostics;
use super::json::finding::Finding;
use super::json::merge::merge;
use super::json::node::{Json, Node};
use super::json::object;
use super::json::parse::parse;
use super::json::span::Span;
use super::json::suggest::nearest;
use super::keys::keys;
use super::set::{self, Set};
use super::{Scene, stock, validate};
use crate::error::{Diagnostic, Error, Kind, Result};

/// Largest scene or patch file, in bytes.
pub const MAX_FILE: u64 = 16 << 20;

/// The path that stands for standard input.
const STDIN: &str = "-";

/// Changes to a scene from outside its file: all patches in order, then all sets, then all flags. They are made
/// before the scene is validated.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Overrides {
    /// Files with a JSON merge patch each (RFC 7396). There `null` removes a key.
    pub patches: Vec<PathBuf>,
    /// `PATH=JSON` each, such as `cloth.ks=500`, `sphere.0.radius=0.1` or `material.shader=bump`
    /// (a bare word is text). The value replaces what is there; `null` is a value like any other, but removes a
    /// whole object, such as `plane=null`.
    pub sets: Vec<String>,
    /// What flags of a program change.
    pub flags: Vec<Flag>,
}

/// A change that a flag of a program makes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Flag {
    /// How the program calls it, such as `--size`; errors name it.
    pub name: &'static str,
    /// `PATH=JSON`, as a set. `*` after the key of an object stands for every such object that there is:
    /// `sphere.*.resolution.0=16`.
    pub set: String,
}

/// A valid scene and what is doubtful in it.
#[derive(Clone, Debug, PartialEq)]
pub struct Loaded {
    /// The scene.
    pub scene: Scene,
    /// The scene of the file alone, without the changes, if that is valid too.
    pub unchanged: Option<Scene>,
    /// What is allowed but probably not meant.
    pub warnings: Vec<Diagnostic>,
}

/// Loads the scene file `path`, changed by `overrides`; `-` is standard input.
///
/// # Errors
/// [`Kind::Scene`] with every diagnostic if the file, a patch or a set is not valid;
/// [`Kind::Io`] if a file cannot be read; [`Kind::Usage`] if a set is not of the form `PATH=JSON`.
pub fn load(path: &Path, overrides: &Overrides) -> Result<Loaded> {
    let name =
        if path == Path::new(STDIN) { "standard input".to_owned() } else { path.display().to_string() };
    assemble(&name, &read(path)?, overrides, read)
}

/// Loads a scene as [`load`] does in the repository's folder, but from the files built into the
/// program: `path` and the patches are `scenes/sphere.json`, `scenes/look/ball.json` and the like.
///
/// # Errors
/// As [`load`]; [`Kind::Io`] if no built-in file has that path.
pub fn load_stock(path: &Path, overrides: &Overrides) -> Result<Loaded> {
    assemble(&path.display().to_string(), &stock::read(path)?, overrides, stock::read)
}

/// The file name of the stock scene that is `scene`, such as `sphere.json`.
pub fn stock_name(scene: &Scene) -> Option<&'static str> {
    let is_same = |text| {
        let loaded = load_text("stock", text, &Overrides::default());
        loaded.is_ok_and(|loaded| loaded.scene == *scene)
    };
    let (path, _) = stock::SCENES.iter().find(|(_, text)| is_same(text))?;
    path.strip_prefix("scenes/")
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
    let (mut sets, mut flags) = (Vec::new(), Vec::new());
    for argument in &overrides.sets {
        sets.push(set::read_set(&mut diagnostics, "--set", argument)?);
    }
    for flag in &overrides.flags {
        flags.push(set::read_set(&mut diagnostics, flag.name, &flag.set)?);
    }
    let is_changed = *overrides != Overrides::default();
    let unchanged = document.as_ref().filter(|_| is_changed).and_then(unchanged);
    let scene = changed(&mut diagnostics, document, patches, sets, flags)
        .and_then(|document| read_scene(&mut diagnostics, &document));
    let warnings = diagnostics.finish()?;
    let scene = scene.ok_or_else(|| Error::new(Kind::Internal, "no scene and no error"))?;
    let unchanged = unchanged.or_else(|| (!is_changed).then(|| scene.clone()));
    Ok(Loaded { scene, unchanged, warnings })
}

/// The scene of a document without changes, if it is valid; what is wrong with it is no concern.
fn unchanged(document: &Node) -> Option<Scene> {
    let mut diagnostics = Diagnostics::default();
    let scene = read_scene(&mut diagnostics, document);
    diagnostics.finish().ok().and(scene)
}

/// The document with all changes; nothing if a text was not JSON.
fn changed(
    diagnostics: &mut Diagnostics,
    document: Option<Node>,
    patches: Vec<Option<Node>>,
    sets: Vec<Option<Set>>,
    flags: Vec<Option<Set>>,
) -> Option<Node> {
    let (patches, sets) = (all(patches)?, all(sets)?);
    let mut document = patches.into_iter().fold(document?, merge);
    sets.into_iter().for_each(|set| set::apply(diagnostics, &mut document, set));
    all(flags)?.into_iter().for_each(|flag| set::apply_to_each(diagnostics, &mut document, flag));
    Some(document)
}

fn all<T>(values: Vec<Option<T>>) -> Option<Vec<T>> {
    values.into_iter().collect()
}

/// Checks that `json` is allowed as the value of the key at `path`, such as `render.samples`. Whether it
/// fits the other keys of a scene is checked when one is loaded.
///
/// # Errors
/// What is wrong with it, in words.
pub fn check_value(path: &str, json: &str) -> Result<(), String> {
    let mut diagnostics = Diagnostics::default();
    let set = set::read_set(&mut diagnostics, "--set", &format!("{path}={json}"));
    if let Some(set) = set.map_err(|error| error.message)? {
        let mut document = Node { span: Span::NOWHERE, json: Json::Object(Vec::new()) };
        set::apply(&mut diagnostics, &mut document, set);
        object::read(&mut diagnostics, &document, keys, Scene::read);
    }
    match diagnostics.finish() {
        Ok(_) => Ok(()),
        // Keys that are missing beside it have errors, too.
        Err(error) => {
            let of_value = |found: &Diagnostic| found.code == "scene::syntax" || found.key.starts_with(path);
            let own = error.diagnostics.into_iter().find(of_value);
            own.map_or(Ok(()), |found| Err(found.message))
        }
    }
}

fn read_scene(diagnostics: &mut Diagnostics, document: &Node) -> Option<Scene> {
    let scene = object::read(diagnostics, document, keys, Scene::read)?;
    validate::validate(diagnostics, document, &scene);
    Some(scene)
}

/// The text of the scene file `path` as it is; `-` is standard input. What is not UTF-8 is replaced.
///
/// # Errors
/// [`Kind::Io`] if the file cannot be read.
pub fn read_text(path: &Path) -> Result<String> {
    Ok(String::from_utf8_lossy(&read(path)?).into_owned())
}

/// The bytes of a file, at most one more than allowed.
fn read(path: &Path) -> Result<Vec<u8>> {
    if path == Path::new(STDIN) {
        return standard_input();
    }
    let mut bytes = Vec::new();
    File::open(path).and_then(|file| file.take(MAX_FILE + 1).read_to_end(&mut bytes)).map_err(|e| {
        let error = Error::new(Kind::Io, format!("cannot read {}: {e}", path.display()));
        error.with_help(neighbor(path).unwrap_or_default())
    })?;
    Ok(bytes)
}

/// What standard input holds, at most one byte more than allowed. It can be read once, so it is kept: some commands
/// load their scene again with changes.
fn standard_input() -> Result<Vec<u8>> {
    static KEPT: OnceLock<std::result::Result<Vec<u8>, String>> = OnceLock::new();
    let read = || {
        let mut bytes = Vec::new();
        let read = std::io::stdin().lock().take(MAX_FILE + 1).read_to_end(&mut bytes);
        read.map(|_| bytes).map_err(|e| e.to_string())
    };
    let kept = KEPT.get_or_init(read).clone();
    kept.map_err(|e| Error::new(Kind::Io, format!("cannot read the scene from standard input: {e}")))
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
pub(super) fn file(diagnostics: &mut Diagnostics, name: &str, bytes: &[u8]) -> Option<Node> {
    if bytes.len() as u64 > MAX_FILE {
        let place = Span { source: diagnostics.add_source(name, ""), start: 0, end: 0 };
        let message = format!("the file is larger than {MAX_FILE} bytes");
        diagnostics.error(Finding::new("scene::too_large", message).at(place, "not read"));
        return None;
    }
    let text = String::from_utf8_lossy(bytes);
    let source = diagnostics.add_source(name, &*text);
    // Some editors begin a file with a byte order mark.
    let mark = if text.starts_with('\u{feff}') { '\u{feff}'.len_utf8() } else { 0 };
    let wrong = if let Err(error) = std::str::from_utf8(bytes) {
        let start = error.valid_up_to();
        // As PowerShell redirects and some editors save.
        let wide = [[0xFF, 0xFE], [0xFE, 0xFF]].iter().any(|mark| bytes.starts_with(mark));
        let message = if wide { "the file is UTF-16: save it as UTF-8" } else { "not valid UTF-8" };
        Some((start..start + char::REPLACEMENT_CHARACTER.len_utf8(), message))
    } else if text[mark..].trim_ascii().is_empty() {
        Some((0..0, "the file is empty"))
    } else {
        None
    };
    match wrong {
        None => parse(diagnostics, source, mark),
        Some((range, message)) => {
            let place = Span { source, start: range.start, end: range.end };
            diagnostics.error(Finding::new("scene::syntax", message).at(place, "here"));
            None
        }
    }
}
