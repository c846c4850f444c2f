//! What the unit tests of documents share.

use super::diagnostic::Diagnostics;
use super::node::{Json, Node};
use super::parse::parse;

/// The value that `text` is.
pub(crate) fn node(text: &str) -> Node {
    let mut diagnostics = Diagnostics::default();
    let source = diagnostics.add_source("x.json", text);
    parse(&mut diagnostics, source, 0).unwrap()
}

/// The value without the places where its parts stand.
pub(crate) fn plain(node: &Node) -> serde_json::Value {
    match &node.json {
        Json::Null => serde_json::Value::Null,
        Json::Bool(value) => (*value).into(),
        Json::Number(value) => (*value).into(),
        Json::Text(text) => text.as_str().into(),
        Json::List(items) => items.iter().map(plain).collect(),
        Json::Object(members) => members.iter().map(|m| (m.key.clone(), plain(&m.value))).collect(),
    }
}
