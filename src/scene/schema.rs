//! The JSON schema of scene files, made from the rules that the reader reads by: it is asked to
//! read nothing, and to note every key that it looks for.

use serde_json::{Map, Value, json};

use super::format::{Json, Node};
use super::report::Report;
use super::source::Span;
use super::words::join;
use super::{fields, reader};

/// A key that the reader knows.
pub(super) struct Key {
    /// Dotted path of the object that holds it; empty for the scene.
    pub(super) object: String,
    pub(super) name: &'static str,
    pub(super) required: bool,
    pub(super) shape: Shape,
}

/// What stands under a key.
pub(super) enum Shape {
    /// A value of this schema.
    Value(Value),
    /// An object, whose keys are noted too.
    Object,
    /// One such object, or a list of them.
    Objects,
}

/// The JSON schema (draft 2020-12) of a scene file.
///
/// It accepts every scene that the reader accepts, and refuses unknown and missing keys, wrong types
/// and numbers out of range. What two values together make wrong (a pin outside the grid, a near
/// plane beyond the far one, a cloth of too many points) only the reader refuses.
pub fn schema() -> Value {
    let mut report = Report::default();
    report.keys = Some(Vec::new());
    let nothing = Node { span: Span { source: 0, start: 0, end: 0 }, json: Json::Object(Vec::new()) };
    reader::document(&mut report, &nothing, fields::scene);
    let mut schema = object(&report.keys.unwrap_or_default(), "");
    schema["$schema"] = json!("https://json-schema.org/draft/2020-12/schema");
    schema["title"] = json!("A scene of drape");
    schema
}

fn object(keys: &[Key], path: &str) -> Value {
    let inside = || keys.iter().filter(|key| key.object == path);
    let properties: Map<String, Value> =
        inside().map(|key| (key.name.to_owned(), property(keys, key))).collect();
    let required: Vec<&str> = inside().filter(|key| key.required).map(|key| key.name).collect();
    json!({
        "type": "object",
        "properties": properties,
        "required": required,
        "additionalProperties": false,
    })
}

fn property(keys: &[Key], key: &Key) -> Value {
    let inner = || object(keys, &join(&key.object, key.name));
    match &key.shape {
        Shape::Value(schema) => schema.clone(),
        Shape::Object => inner(),
        Shape::Objects => json!({ "anyOf": [inner(), { "type": "array", "items": inner() }] }),
    }
}
