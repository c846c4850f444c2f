//! The JSON schema of scene files, made from the rules that the reader reads by: it is asked to
//! read nothing, and to note every key that it looks for.

use serde_json::{Map, Value, json};

use super::format::{Json, Node};
use super::meanings::meaning;
use super::report::Report;
use super::rule::Rule;
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
    /// A value of this schema, described in words; `default` stands for one that is left out.
    Value { schema: Value, words: String, default: Option<Value> },
    /// An object, whose keys are noted too.
    Object,
    /// One such object, or a list of them.
    Objects,
}

impl Shape {
    /// A value after `rule`.
    pub(super) fn value<R: Rule>(rule: &R, default: Option<&R::Value>) -> Self {
        let default = default.map(|value| rule.json(value));
        Self::Value { schema: rule.schema(), words: rule.words(), default }
    }
}

/// The JSON schema (draft 2020-12) of a scene file.
///
/// It accepts every scene that the reader accepts, and refuses unknown and missing keys, wrong types
/// and numbers out of range. What two values together make wrong (a pin outside the grid, a near
/// plane beyond the far one, a cloth of too many points) only the reader refuses. Each key has its
/// meaning and what it must be as `description`, and its `default` if that is one value.
pub fn schema() -> Value {
    let mut schema = object(&keys(), "");
    schema["$schema"] = json!("https://json-schema.org/draft/2020-12/schema");
    schema["title"] = json!("A scene of drape");
    schema
}

/// Every key that the reader knows.
fn keys() -> Vec<Key> {
    let mut report = Report::default();
    report.keys = Some(Vec::new());
    let nothing = Node { span: Span { source: 0, start: 0, end: 0 }, json: Json::Object(Vec::new()) };
    reader::document(&mut report, &nothing, fields::scene);
    report.keys.unwrap_or_default()
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
    let mut schema = match &key.shape {
        Shape::Value { schema, .. } => schema.clone(),
        Shape::Object => inner(),
        Shape::Objects => json!({ "anyOf": [inner(), { "type": "array", "items": inner() }] }),
    };
    schema["description"] = meaning(&key.object, key.name).into();
    if let Shape::Value { words, default, .. } = &key.shape {
        schema["description"] = format!("{} It must be {words}.", meaning(&key.object, key.name)).into();
        // The defaults of an object's own material are the scene's material, whatever that says.
        if let Some(default) = default.as_ref().filter(|_| !key.object.contains('.')) {
            schema["default"] = default.clone();
        }
    }
    schema
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::super::meanings::MEANINGS;
    use super::*;

    #[test]
    fn every_key_has_a_meaning_and_every_meaning_a_key() {
        let keys = keys();
        let last = |path: &str| path.rsplit('.').next().unwrap_or_default().to_owned();
        let known: BTreeSet<_> = keys.iter().map(|key| (last(&key.object), key.name)).collect();
        let listed =
            MEANINGS.iter().flat_map(|(object, keys)| keys.iter().map(|key| ((*object).into(), key.0)));
        assert_eq!(known, listed.collect());
        for key in &keys {
            let meaning = meaning(&key.object, key.name);
            assert!(meaning.len() > 10 && meaning.ends_with('.'), "{}.{}", key.object, key.name);
        }
    }
}
