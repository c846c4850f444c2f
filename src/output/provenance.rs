//! Provenance: what a file says of itself, so that anyone can make it again and compare.
//!
//! Every format writes the same keys: a PNG and an animated PNG as text chunks and a GIF as lines of its comment, with
//! `drape:` before each, a `.glb` in `asset.extras.drape`, and positions in a JSON file beside them.
//!
//! | key | what it says |
//! |---|---|
//! | `version` | the version of the program, with a mark of its results |
//! | `scene` | the hash of the scene's text |
//! | `scene-json` | that text: a scene file with every key, all changes made. It has no `render.time`, since the moment is an argument. Left out above [`MAX_TEXT`] |
//! | `arguments` | the moments, what is drawn, and what was changed in the scene file |
//! | `textures` | the hash of the texels, where they are not the built-in ones |
//! | `state` | the hash of the simulated state; of several frames that of their hashes |
//! | `picture` | the hash of the colours that a reader of the file sees; of an animation of all, with their times |
//! | `content` | of what is no picture: the hash of its numbers |
//! | `command` | the command line as it was typed, if that was asked for |
//!
//! A scene file holds no paths, so there are none but in `command`. Nothing depends on the time, the machine or the
//! number of threads. The hashes find damage and carelessness, not a forger, who can write new ones: the proof is
//! the second run.

use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

use crate::error::{Error, Kind, Result};
use crate::math::StateHash;
use crate::scene::{Difference, Loaded, Scene, differences, stock_name};
use crate::version::VERSION;

/// Most bytes of the text of a scene, and of the arguments.
pub const MAX_TEXT: usize = 1 << 16;

/// What stands before each key in a text chunk.
const PREFIX: &str = "drape:";

/// What a file says of itself.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub struct Provenance {
    /// The hash of the picture.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub picture: Option<String>,
    /// The hash of the state.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub state: Option<String>,
    /// The version of the program, see [`VERSION`].
    pub version: String,
    /// The hash of the scene's text.
    pub scene: String,
    /// How the scene was made and which of its moments are shown.
    pub arguments: Arguments,
    /// The hash of the textures that do not come from the built-in set.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub textures: Option<String>,
    /// The hash of what is no picture.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub content: Option<String>,
    /// The command line, word by word.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub command: Option<Vec<String>>,
    /// The scene.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub scene_json: Option<Map<String, Value>>,
}

/// What is needed besides the scene to make a file again, and besides a scene file to make the scene.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Arguments {
    /// The stock scene that the scene file is, such as `sphere.json`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stock: Option<String>,
    /// What options changed in the scene file, as `PATH=JSON` each.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub changes: Vec<String>,
    /// The frame that is shown.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub frame: Option<u64>,
    /// The frames that are shown, without the last.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub frames: Option<[u64; 2]>,
    /// Pictures per second of an animation.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fps: Option<u16>,
    /// Whether a mesh has the other objects besides the cloth.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub objects: bool,
    /// The kinds of springs that a wireframe shows, separated by commas.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub springs: Option<String>,
}

/// A hash as it is written.
pub fn hex(hash: u64) -> String {
    format!("{hash:016x}")
}

/// The scene as [`Provenance`] has it: every key but the moment.
pub fn document(scene: &Scene) -> Map<String, Value> {
    let mut document = scene.document();
    if let Some(Value::Object(render)) = document.get_mut("render") {
        render.remove("time");
    }
    document
}

/// The hash of a document, over the bytes of its text.
pub fn document_hash(document: &Map<String, Value>) -> String {
    bytes_hash(text(document).as_bytes())
}

fn text(value: &impl Serialize) -> String {
    // Maps with names as keys are always JSON.
    serde_json::to_string(value).unwrap_or_default()
}

fn bytes_hash(bytes: &[u8]) -> String {
    let mut hash = StateHash::default();
    hash.write(bytes);
    hex(hash.finish())
}

impl Provenance {
    /// That of a file of the scene in `loaded`, without the hashes of what is not yet computed. `arguments` says what
    /// is shown.
    pub fn new(loaded: &Loaded, arguments: Arguments) -> Self {
        let document = document(&loaded.scene);
        let scene = text(&document);
        let unchanged = loaded.unchanged.as_ref();
        let changes = unchanged.map(|unchanged| differences(&self::document(unchanged), &document));
        let changes: Vec<String> = changes.iter().flatten().map(Difference::set).collect();
        let fits = changes.iter().map(String::len).sum::<usize>() <= MAX_TEXT;
        let stock = unchanged.and_then(stock_name).map(str::to_owned);
        Self {
            version: VERSION.to_owned(),
            scene: bytes_hash(scene.as_bytes()),
            arguments: Arguments { stock, changes: if fits { changes } else { Vec::new() }, ..arguments },
            scene_json: (scene.len() <= MAX_TEXT).then_some(document),
            ..Self::default()
        }
    }

    /// The same of a picture.
    pub fn of_picture(&self, state: u64, picture: u64) -> Self {
        Self { state: Some(hex(state)), picture: Some(hex(picture)), ..self.clone() }
    }

    /// The same of numbers, which are no picture.
    pub fn of_content(&self, state: u64, numbers: &[u8]) -> Self {
        Self { state: Some(hex(state)), content: Some(bytes_hash(numbers)), ..self.clone() }
    }

    /// Whether the other is of the same picture: the same moment of the same scene, however that was made.
    pub fn is_like(&self, other: &Self) -> bool {
        let shown = |all: &Self| {
            let arguments = Arguments { stock: None, changes: Vec::new(), ..all.arguments.clone() };
            let [version, scene] = [&all.version, &all.scene].map(String::clone);
            Self { version, scene, textures: all.textures.clone(), arguments, ..Self::default() }
        };
        shown(self) == shown(other)
    }

    /// The keys with their values, as one object.
    pub fn to_json(&self) -> Value {
        serde_json::to_value(self).unwrap_or_default()
    }

    /// Keywords and texts, in ASCII and each without a line feed: what is no text is JSON. Of a picture the
    /// hashes, which are known last, come first.
    pub fn texts(&self) -> Vec<(String, String)> {
        let keys = ["picture", "state", "version", "scene", "arguments", "textures", "content", "command"];
        let mut values = match self.to_json() {
            Value::Object(values) => values,
            _ => Map::new(),
        };
        let all = keys.into_iter().chain(["scene-json"]);
        let named = all.filter_map(|key| Some((format!("{PREFIX}{key}"), values.remove(key)?)));
        named.map(|(keyword, value)| (keyword, in_ascii(value))).collect()
    }

    /// What the texts of a file say; nothing if none has a keyword of [`Provenance::texts`].
    ///
    /// # Errors
    /// [`Kind::Io`] when they are not whole or not readable, or one of them stands there twice.
    pub fn from_texts(texts: &[(String, String)]) -> Result<Option<Self>> {
        let mut values = Map::new();
        for (keyword, text) in texts {
            let Some(key) = keyword.strip_prefix(PREFIX) else { continue };
            if values.insert(key.to_owned(), parsed(text)).is_some() {
                return Err(Error::new(Kind::Io, format!("the file says `{keyword}` twice: it is damaged")));
            }
        }
        if values.is_empty() {
            return Ok(None);
        }
        serde_json::from_value(Value::Object(values)).map(Some).map_err(|e| {
            Error::new(Kind::Io, format!("what the file says of itself is damaged or not whole: {e}"))
        })
    }
}

/// A text as it is; anything else as JSON with all characters beyond ASCII escaped.
fn in_ascii(value: Value) -> String {
    let text = match value {
        Value::String(text) => text,
        value => value.to_string(),
    };
    let mut ascii = String::new();
    for c in text.chars() {
        if c.is_ascii() {
            ascii.push(c);
        } else {
            let mut units = [0; 2];
            c.encode_utf16(&mut units).iter().for_each(|unit| ascii += &format!("\\u{unit:04x}"));
        }
    }
    ascii
}

/// An object or a list, if the text is one; else the text.
fn parsed(text: &str) -> Value {
    let json = text.starts_with(['{', '[']).then(|| serde_json::from_str(text).ok()).flatten();
    json.unwrap_or_else(|| text.into())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Overrides, load_text};

    fn sphere(sets: &[&str]) -> Loaded {
        let sets = sets.iter().map(ToString::to_string).collect();
        let text = include_str!("../../scenes/sphere.json");
        load_text("a.json", text, &Overrides { sets, ..Overrides::default() }).unwrap()
    }

    fn provenance(sets: &[&str]) -> Provenance {
        Provenance::new(&sphere(sets), Arguments { frame: Some(3), ..Arguments::default() })
    }

    #[test]
    fn texts_are_ascii_and_read_back() {
        let mut all = provenance(&["cloth.ks=100"]).of_picture(1, u64::MAX);
        all.command = Some(vec!["drape".into(), "\u{fc}\u{1f600}\n\"".into()]);
        let texts = all.texts();
        assert!(
            texts.iter().all(|(key, text)| (key.clone() + text).chars().all(|c| (' '..='~').contains(&c)))
        );
        assert_eq!(texts[0], ("drape:picture".into(), "ffffffffffffffff".into()));
        assert_eq!(Provenance::from_texts(&texts).unwrap(), Some(all.clone()));
        assert_eq!(serde_json::from_value::<Provenance>(all.to_json()).unwrap(), all);
        assert_eq!(Provenance::from_texts(&[("Title".into(), "x".into())]).unwrap(), None);
        for (i, _) in texts.iter().enumerate().filter(|(_, (key, _))| key == "drape:scene") {
            let less = [&texts[..i], &texts[i + 1..]].concat();
            assert_eq!(Provenance::from_texts(&less).unwrap_err().kind, Kind::Io);
        }
        for twice in &texts {
            let more = [&texts[..], std::slice::from_ref(twice)].concat();
            assert_eq!(Provenance::from_texts(&more).unwrap_err().kind, Kind::Io, "{twice:?}");
        }
    }

    #[test]
    fn the_text_of_the_scene_is_a_scene_file_and_the_changes_make_it_of_the_stock_scene() {
        let all =
            provenance(&["cloth.ks=100", "plane={\"point\":[0,0,0],\"normal\":[0,1,0],\"friction\":0}"]);
        let text = text(&all.scene_json.clone().unwrap());
        assert_eq!(bytes_hash(text.as_bytes()), all.scene);
        let scene = load_text("b.json", &text, &Overrides::default()).unwrap().scene;
        assert_eq!(document_hash(&document(&scene)), all.scene);
        assert_eq!(all.arguments.stock.as_deref(), Some("sphere.json"));
        assert_eq!(all.arguments.changes.len(), 2);
        let changes: Vec<&str> = all.arguments.changes.iter().map(String::as_str).collect();
        assert_eq!(provenance(&changes).scene, all.scene);
    }

    #[test]
    fn the_moment_is_no_part_of_the_scene_and_all_else_is() {
        assert!(provenance(&[]).is_like(&provenance(&["render.time=1"]).of_content(1, &[2])));
        for other in ["render.samples=4", "cloth.ks=1", "light.color=[1,0,0]"] {
            assert!(!provenance(&[]).is_like(&provenance(&[other])), "{other}");
            assert_ne!(provenance(&[]).scene, provenance(&[other]).scene, "{other}");
        }
    }

    #[test]
    fn a_scene_that_is_too_large_is_only_named() {
        let pins: Vec<[usize; 2]> = (0..12_000).map(|i| [i % 150, i / 150]).collect();
        let pins = format!("cloth.pinned={}", serde_json::to_string(&pins).unwrap());
        let sides = ["cloth.num_width_points=150", "cloth.num_height_points=150"];
        let all = provenance(&[sides[0], sides[1], &pins]);
        assert!(all.scene_json.is_none() && all.arguments.changes.is_empty());
        assert_ne!(all.scene, provenance(&sides).scene);
    }
}
