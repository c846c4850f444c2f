//! Enums whose variants have a name in documents and a description: one table for each.

use std::marker::PhantomData;

use serde_json::{Value, json};

use super::node::Json;
use super::rule::{At, Rule};
use super::scalar::whole;
use super::suggest::did_you_mean;
use super::text::{alternatives, paragraph};

/// An enum made by [`choices`].
pub(crate) trait Named: Copy + PartialEq + 'static {
    /// Every variant with its name and the lines of its documentation.
    const ROWS: &'static [(&'static str, Self, &'static [&'static str])];

    /// What the variants stand for, a sentence or two each.
    fn glossary() -> String {
        let entry = |(name, _, doc): &(&str, Self, &[&str])| format!("`{name}`: {}", paragraph(doc));
        Self::ROWS.iter().map(entry).collect::<Vec<_>>().join(" ")
    }
}

/// Makes an enum of which each variant has a name and a description, so that none can be forgotten.
///
/// The first paragraph of a variant's documentation is for users: it stands in the schema and in the
/// tables of keys. What follows is for readers of the code.
macro_rules! choices {
    ($(#[$attribute:meta])* pub enum $enum:ident {
        $($(#[doc = $doc:literal])* $variant:ident = $name:literal,)*
    }) => {
        $(#[$attribute])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum $enum {
            $($(#[doc = $doc])* $variant,)*
        }

        impl $enum {
            /// Every variant with its name, in the order of the documentation.
            pub const NAMES: &'static [(&'static str, Self)] = &[$(($name, Self::$variant)),*];

            /// The name of this variant in scene files.
            pub fn name(self) -> &'static str {
                match self {
                    $(Self::$variant => $name,)*
                }
            }
        }

        impl $crate::scene::json::choice::Named for $enum {
            const ROWS: &'static [(&'static str, Self, &'static [&'static str])] =
                &[$(($name, Self::$variant, &[$($doc),*])),*];
        }
    };
}
pub(crate) use choices;

/// One of the names of an enum.
pub(crate) struct Choice<T>(PhantomData<T>);

/// One of the names of an enum.
pub(crate) const fn choice<T: Named>() -> Choice<T> {
    Choice(PhantomData)
}

impl<T: Named> Rule for Choice<T> {
    type Value = T;

    fn words(&self) -> String {
        alternatives(T::ROWS.iter().map(|(name, ..)| format!("\"{name}\"")))
    }

    fn read(&self, at: &mut At) -> Option<T> {
        let Json::Text(text) = &at.node.json else { return at.wrong_type(&self.words()) };
        let known = T::ROWS.iter().find(|(name, ..)| name == text);
        known.map(|(_, value, _)| *value).or_else(|| {
            let help = did_you_mean(text, T::ROWS.iter().map(|(name, ..)| *name)).unwrap_or_default();
            at.not_allowed("scene::unknown_value", &self.words(), &help)
        })
    }

    fn schema(&self) -> Value {
        json!({ "enum": T::ROWS.iter().map(|(name, ..)| *name).collect::<Vec<_>>() })
    }

    fn json(&self, value: &T) -> Value {
        json!(T::ROWS.iter().find(|(_, known, _)| known == value).map(|(name, ..)| name))
    }

    fn placeholder(&self) -> T {
        T::ROWS[0].1
    }

    fn glossary(&self) -> String {
        T::glossary()
    }
}

/// A variant of an enum by its place in the table, counted from 0.
pub(crate) struct Numbered<T>(PhantomData<T>);

/// A variant of an enum by its place in the table, counted from 0.
pub(crate) const fn numbered<T: Named>() -> Numbered<T> {
    Numbered(PhantomData)
}

impl<T: Named> Rule for Numbered<T> {
    type Value = T;

    fn words(&self) -> String {
        alternatives(T::ROWS.iter().enumerate().map(|(code, (name, ..))| format!("{code} ({name})")))
    }

    fn read(&self, at: &mut At) -> Option<T> {
        let Json::Number(value) = at.node.json else {
            return at.wrong_type(&format!("the number {}", self.words()));
        };
        let code = whole(value).and_then(|code| usize::try_from(code).ok());
        let known = code.and_then(|code| T::ROWS.get(code)).map(|(_, value, _)| *value);
        known.or_else(|| at.not_allowed("scene::unknown_value", &self.words(), ""))
    }

    fn schema(&self) -> Value {
        json!({ "enum": (0..T::ROWS.len()).collect::<Vec<_>>() })
    }

    fn json(&self, value: &T) -> Value {
        json!(T::ROWS.iter().position(|(_, known, _)| known == value))
    }

    fn placeholder(&self) -> T {
        T::ROWS[0].1
    }

    fn glossary(&self) -> String {
        T::glossary()
    }
}
