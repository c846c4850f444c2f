//! A JSON value that knows where it stands in its text.

use serde_json::Value;

use super::number::number;
use super::span::Span;

/// A JSON value and where it stands.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Node {
    pub(crate) span: Span,
    pub(crate) json: Json,
}

/// A JSON value. Numbers are the nearest binary64 (infinite if beyond its range).
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Json {
    Null,
    Bool(bool),
    Number(f64),
    Text(String),
    List(Vec<Node>),
    Object(Vec<Member>),
}

/// A key of an object with its value.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Member {
    pub(crate) key: String,
    pub(crate) key_span: Span,
    pub(crate) value: Node,
}

impl Node {
    /// What the value is, in plain words.
    pub(crate) fn kind(&self) -> &'static str {
        match self.json {
            Json::Null => "null",
            Json::Bool(_) => "true or false",
            Json::Number(_) => "a number",
            Json::Text(_) => "text",
            Json::List(_) => "a list",
            Json::Object(_) => "an object",
        }
    }

    /// The value without the places where its parts stand. Whole numbers are integers.
    pub(crate) fn plain(&self) -> Value {
        match &self.json {
            Json::Null => Value::Null,
            Json::Bool(value) => (*value).into(),
            Json::Number(value) => number(*value),
            Json::Text(text) => text.as_str().into(),
            Json::List(items) => items.iter().map(Self::plain).collect(),
            Json::Object(members) => members.iter().map(|m| (m.key.clone(), m.value.plain())).collect(),
        }
    }

    /// The keys of an object.
    pub(crate) fn members(&self) -> Option<&[Member]> {
        match &self.json {
            Json::Object(members) => Some(members),
            _ => None,
        }
    }

    /// The value at a dotted path such as `cloth.pinned.0`.
    pub(crate) fn get(&self, path: &str) -> Option<&Self> {
        path.split('.').try_fold(self, |node, step| match &node.json {
            Json::Object(members) => members.iter().find(|m| m.key == step).map(|m| &m.value),
            Json::List(items) => items.get(step.parse::<usize>().ok()?),
            _ => None,
        })
    }
}
