//! Rules for single values.

use serde_json::{Value, json};

use super::format::Json;
use super::nearest::did_you_mean;
use super::range::Range;
use super::rule::{At, Rule};
use super::words::alternatives;

/// A number in a range.
#[derive(Clone, Copy)]
pub(super) struct Number(pub(super) Range);

impl Rule for Number {
    type Value = f64;

    fn words(&self) -> String {
        format!("a number {}", self.0.words())
    }

    fn read(&self, at: &mut At) -> Option<f64> {
        match at.node.json {
            Json::Number(value) if self.0.contains(value) => Some(value),
            Json::Number(_) => at.not_allowed("scene::out_of_range", &self.0.words(), ""),
            _ => at.wrong_type(&self.words()),
        }
    }

    fn schema(&self) -> Value {
        json!({ "type": "number", "minimum": self.0.min, "maximum": self.0.max })
    }

    fn json(&self, value: &f64) -> Value {
        whole(*value).map_or_else(|| json!(value), |whole| json!(whole))
    }

    fn stand_in(&self) -> f64 {
        self.0.min
    }
}

/// A whole number in a range; `50.0` is one.
#[derive(Clone, Copy)]
pub(super) struct Count(pub(super) u32, pub(super) u32);

impl Rule for Count {
    type Value = u32;

    fn words(&self) -> String {
        format!("a whole number from {} to {}", self.0, self.1)
    }

    fn read(&self, at: &mut At) -> Option<u32> {
        let Json::Number(value) = at.node.json else { return at.wrong_type(&self.words()) };
        match whole(value).and_then(|whole| u32::try_from(whole).ok()) {
            Some(count) if (self.0..=self.1).contains(&count) => Some(count),
            _ => at.not_allowed("scene::out_of_range", &self.words(), ""),
        }
    }

    fn schema(&self) -> Value {
        json!({ "type": "integer", "minimum": self.0, "maximum": self.1 })
    }

    fn json(&self, value: &u32) -> Value {
        json!(value)
    }

    fn stand_in(&self) -> u32 {
        self.0
    }
}

/// `value` as an integer, if it is one of at most 2^53.
pub(super) fn whole(value: f64) -> Option<i64> {
    const EXACT: f64 = 9_007_199_254_740_992.0;
    #[expect(clippy::cast_possible_truncation, reason = "the guard leaves exact integers only")]
    (value.fract() == 0.0 && (-EXACT..=EXACT).contains(&value)).then_some(value as i64)
}

/// `true` or `false`.
#[derive(Clone, Copy)]
pub(super) struct Flag;

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

    fn stand_in(&self) -> bool {
        false
    }
}

/// One of a few names.
#[derive(Clone, Copy)]
pub(super) struct Choice<T: 'static>(pub(super) &'static [(&'static str, T)]);

impl<T: Copy + PartialEq> Rule for Choice<T> {
    type Value = T;

    fn words(&self) -> String {
        alternatives(self.0.iter().map(|(name, _)| format!("\"{name}\"")))
    }

    fn read(&self, at: &mut At) -> Option<T> {
        let Json::Text(text) = &at.node.json else { return at.wrong_type(&self.words()) };
        let known = self.0.iter().find(|(name, _)| name == text);
        known.map(|(_, value)| *value).or_else(|| {
            let help = did_you_mean(text, self.0.iter().map(|(name, _)| *name)).unwrap_or_default();
            at.not_allowed("scene::unknown_value", &self.words(), &help)
        })
    }

    fn schema(&self) -> Value {
        let names: Vec<&str> = self.0.iter().map(|(name, _)| *name).collect();
        json!({ "enum": names })
    }

    fn json(&self, value: &T) -> Value {
        json!(self.0.iter().find(|(_, known)| known == value).map(|(name, _)| name))
    }

    fn stand_in(&self) -> T {
        self.0[0].1
    }
}

/// One of a few whole numbers, each with a word for what it stands for, or none.
#[derive(Clone, Copy)]
pub(super) struct Coded<T: 'static>(pub(super) &'static [(i64, &'static str, T)]);

impl<T: Copy + PartialEq> Rule for Coded<T> {
    type Value = T;

    fn words(&self) -> String {
        alternatives(self.0.iter().map(|(code, word, _)| match *word {
            "" => code.to_string(),
            word => format!("{code} ({word})"),
        }))
    }

    fn read(&self, at: &mut At) -> Option<T> {
        let Json::Number(value) = at.node.json else {
            return at.wrong_type(&format!("the number {}", self.words()));
        };
        let known = self.0.iter().find(|(code, ..)| whole(value) == Some(*code));
        known.map(|(.., value)| *value).or_else(|| at.not_allowed("scene::unknown_value", &self.words(), ""))
    }

    fn schema(&self) -> Value {
        let codes: Vec<i64> = self.0.iter().map(|(code, ..)| *code).collect();
        json!({ "enum": codes })
    }

    fn json(&self, value: &T) -> Value {
        json!(self.0.iter().find(|(.., known)| known == value).map(|(code, ..)| code))
    }

    fn stand_in(&self) -> T {
        self.0[0].2
    }
}

/// The name of a texture: part of a file name, so letters, digits, `_` and `-` only.
#[derive(Clone, Copy)]
pub(super) struct Name;

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
        at.not_allowed("scene::bad_name", &self.words(), "give the name without folder and ending")
    }

    fn schema(&self) -> Value {
        json!({ "type": "string", "pattern": "^[A-Za-z0-9_-]{1,64}$" })
    }

    fn json(&self, value: &String) -> Value {
        json!(value)
    }

    fn stand_in(&self) -> String {
        String::new()
    }
}
