//! Rules for single values.

use std::fmt::Display;

use serde::Serialize;
use serde_json::{Value, json};

use super::node::Json;
use super::number::whole;
use super::rule::{At, Rule};
use super::text::alternatives;

/// A whole number in a range, both ends included; `50.0` is one.
#[derive(Clone, Copy)]
pub(crate) struct Count<T>(pub(crate) T, pub(crate) T);

impl<T: Copy + PartialOrd + Display + Serialize + TryFrom<i64>> Rule for Count<T> {
    type Value = T;

    fn words(&self) -> String {
        format!("a whole number from {} to {}", self.0, self.1)
    }

    fn read(&self, at: &mut At) -> Option<T> {
        let Json::Number(value) = at.node.json else { return at.wrong_type(&self.words()) };
        match whole(value).and_then(|whole| T::try_from(whole).ok()) {
            Some(count) if (self.0..=self.1).contains(&count) => Some(count),
            _ => at.not_allowed("scene::out_of_range", &self.words(), ""),
        }
    }

    fn schema(&self) -> Value {
        json!({ "type": "integer", "minimum": self.0, "maximum": self.1 })
    }

    fn json(&self, value: &T) -> Value {
        json!(value)
    }

    fn placeholder(&self) -> T {
        self.0
    }
}

/// `true` or `false`.
#[derive(Clone, Copy)]
pub(crate) struct Flag;

impl Rule for Flag {
    type Value = bool;

    fn words(&self) -> String {
        "true or false".into()
    }

    fn read(&self, at: &mut At) -> Option<bool> {
        match at.node.json {
            Json::Bool(value) => Some(value),
            _ => at.wrong_type(&self.words()),
        }
    }

    fn schema(&self) -> Value {
        json!({ "type": "boolean" })
    }

    fn json(&self, value: &bool) -> Value {
        json!(value)
    }

    fn placeholder(&self) -> bool {
        false
    }
}

/// One of a few whole numbers.
#[derive(Clone, Copy)]
pub(crate) struct OneOf(pub(crate) &'static [u32]);

impl Rule for OneOf {
    type Value = u32;

    fn words(&self) -> String {
        alternatives(self.0.iter().map(u32::to_string))
    }

    fn read(&self, at: &mut At) -> Option<u32> {
        let Json::Number(value) = at.node.json else {
            return at.wrong_type(&format!("the number {}", self.words()));
        };
        let known = self.0.iter().find(|&&known| f64::from(known) == value);
        known.copied().or_else(|| at.not_allowed("scene::unknown_value", &self.words(), ""))
    }

    fn schema(&self) -> Value {
        json!({ "enum": self.0 })
    }

    fn json(&self, value: &u32) -> Value {
        json!(value)
    }

    fn placeholder(&self) -> u32 {
        self.0[0]
    }
}

/// A name that can be part of a file name: letters, digits, `_` and `-` only.
#[derive(Clone, Copy)]
pub(crate) struct Name;

impl Rule for Name {
    type Value = String;

    fn words(&self) -> String {
        "a name of letters, digits, `_` and `-`".into()
    }

    fn read(&self, at: &mut At) -> Option<String> {
        let Json::Text(text) = &at.node.json else { return at.wrong_type(&self.words()) };
        let plain = |c: char| c.is_ascii_alphanumeric() || "_-".contains(c);
        if (1..=64).contains(&text.len()) && text.chars().all(plain) {
            return Some(text.clone());
        }
        at.not_allowed("scene::bad_name", &self.words(), "give the name without folder and extension")
    }

    fn schema(&self) -> Value {
        json!({ "type": "string", "pattern": "^[A-Za-z0-9_-]{1,64}$" })
    }

    fn json(&self, value: &String) -> Value {
        json!(value)
    }

    fn placeholder(&self) -> String {
        String::new()
    }
}
