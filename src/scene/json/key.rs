//! A key of a document: one row from which everything about it is made.

use serde_json::Value;

use super::rule::Rule;
use super::text::join;

/// What the code says of a key besides its rule and default.
#[derive(Clone, Copy)]
pub(crate) struct Row {
    pub(crate) name: &'static str,
    /// The lines of its documentation; the first paragraph is its meaning, for users.
    pub(crate) doc: &'static [&'static str],
    /// Whether the name means something else in another object, so that it is not suggested there.
    pub(crate) local: bool,
}

impl Row {
    /// The row of an object.
    pub(crate) const fn new(name: &'static str, doc: &'static [&'static str]) -> Self {
        Self { name, doc, local: false }
    }
}

/// An object whose values can be listed as a document writes them.
pub(crate) trait Listed {
    /// Adds every key of its own with its value, below `path`; objects inside it are left out.
    fn list(&self, path: &str, list: &mut Vec<(String, Value)>);
}

/// A key of a document with everything that is said about it.
#[derive(Clone, Debug, PartialEq)]
pub struct Key {
    /// Dotted path of the object that holds it, such as `cloth.material`; empty for the scene itself.
    pub object: String,
    /// Its name there.
    pub name: &'static str,
    /// What it means, in full sentences for users.
    pub meaning: String,
    /// What stands under it.
    pub shape: Shape,
    pub(crate) local: bool,
}

/// What stands under a key.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// A value.
    Value {
        /// What is allowed, in words that complete "it must be".
        rule: String,
        /// The values to choose from, each with its meaning; none if it is no choice.
        choices: Vec<(String, String)>,
        /// The value that stands for one that is left out; none if it must be given, or is that of
        /// another object.
        default: Option<Value>,
        /// Whether it must be given.
        required: bool,
        /// What is allowed, as a JSON schema.
        schema: Value,
    },
    /// An object, whose keys are listed too.
    Object,
    /// One such object, or a list of them.
    Objects,
}

impl Key {
    /// Its dotted path, such as `cloth.material.kd`.
    pub fn path(&self) -> String {
        join(&self.object, self.name)
    }

    /// What is allowed, in words that complete "it must be".
    pub fn rule(&self) -> &str {
        match &self.shape {
            Shape::Value { rule, .. } => rule,
            Shape::Object => "an object",
            Shape::Objects => "an object, or a list of them",
        }
    }

    /// Its meaning, followed by those of the values to choose from.
    pub fn full_meaning(&self) -> String {
        let entry = |(value, meaning): &(String, String)| format!(" `{value}`: {meaning}");
        match &self.shape {
            Shape::Value { choices, .. } => {
                self.meaning.clone() + &choices.iter().map(entry).collect::<String>()
            }
            Shape::Object | Shape::Objects => self.meaning.clone(),
        }
    }

    /// Whether it must be given where its object is.
    pub fn required(&self) -> bool {
        matches!(self.shape, Shape::Value { required: true, .. })
    }

    /// The value that stands for one that is left out, if it is always the same.
    pub fn default(&self) -> Option<&Value> {
        match &self.shape {
            Shape::Value { default, .. } => default.as_ref(),
            Shape::Object | Shape::Objects => None,
        }
    }
}

impl Shape {
    /// A value under `rule`, required if there is no default; one that is inherited has no fixed default.
    pub(super) fn value<R: Rule>(rule: &R, default: Option<&R::Value>, inherited: bool) -> Self {
        Self::Value {
            rule: rule.words(),
            choices: rule.choices(),
            default: default.filter(|_| !inherited).map(|value| rule.json(value)),
            required: default.is_none(),
            schema: rule.schema(),
        }
    }
}
