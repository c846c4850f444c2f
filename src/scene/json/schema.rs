//! The JSON schema of a document, made from its keys.

use serde_json::{Map, Value, json};

use super::key::{Key, Shape};

/// The JSON schema (draft 2020-12) of a document that has `keys`.
///
/// It accepts every document that the reader accepts, and refuses unknown and missing keys, wrong types
/// and numbers out of range. Each key has its meaning and what it must be as `description`, and its
/// `default` if that is always the same value.
pub(crate) fn schema(title: &str, keys: &[Key]) -> Value {
    let mut schema = object(keys, "");
    schema["$schema"] = json!("https://json-schema.org/draft/2020-12/schema");
    schema["title"] = json!(title);
    schema
}

fn object(keys: &[Key], path: &str) -> Value {
    let inside = || keys.iter().filter(|key| key.object == path);
    let properties: Map<String, Value> =
        inside().map(|key| (key.name.to_owned(), property(keys, key))).collect();
    let required: Vec<&str> = inside().filter(|key| key.required()).map(|key| key.name).collect();
    json!({
        "type": "object",
        "properties": properties,
        "required": required,
        "additionalProperties": false,
    })
}

fn property(keys: &[Key], key: &Key) -> Value {
    let inner = || object(keys, &key.path());
    let mut schema = match &key.shape {
        Shape::Value { schema, .. } => schema.clone(),
        Shape::Object => inner(),
        Shape::Objects => json!({ "anyOf": [inner(), { "type": "array", "items": inner() }] }),
    };
    schema["description"] = match &key.shape {
        Shape::Value { rule, .. } => format!("{} It must be {rule}.", key.full_meaning()).into(),
        Shape::Object | Shape::Objects => key.meaning.clone().into(),
    };
    if let Some(default) = key.default() {
        schema["default"] = default.clone();
    }
    schema
}
