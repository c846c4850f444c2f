//! Enums whose variants have a name in documents and a description: one table for each.

use std::marker::PhantomData;

use serde_json::{Value, json};

use super::node::Json;
use super::number::whole;
use super::rule::{At, Rule};
use super::suggest::did_you_mean;
use super::text::alternatives;

/// An enum made by [`choices`].
pub(crate) trait Named: Copy + PartialEq + 'static {
    /// Every variant with its name.
    const ROWS: &'static [(&'static str, Self)];

    /// What the variant means, in a sentence or two for users.
    fn meaning_of(self) -> String;
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

            /// What this variant means, in a sentence or two for users.
            pub fn meaning(self) -> String {
                $crate::scene::json::text::paragraph(match self {
                    $(Self::$variant => &[$($doc),*],)*
                })
            }
        }

        impl $crate::scene::json::choice::Named for $enum {
            const ROWS: &'static [(&'static str, Self)] = Self::NAMES;

            fn meaning_of(self) -> String {
                self.meaning()
            }
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
        alternatives(T::ROWS.iter().map(|(name, _)| format!("\"{name}\"")))
    }

    fn read(&self, at: &mut At) -> Option<T> {
        let Json::Text(text) = &at.node.json else { return at.wrong_type(&self.words()) };
        let known = T::ROWS.iter().find(|(name, _)| name == text);
        known.map(|(_, value)| *value).or_else(|| {
            let help = did_you_mean(text, T::ROWS.iter().map(|(name, _)| *name)).unwrap_or_default();
            at.not_allowed("scene::unknown_value", &self.words(), &help)
        })
    }

    fn schema(&self) -> Value {
        json!({ "enum": T::ROWS.iter().map(|(name, _)| *name).collect::<Vec<_>>() })
    }

    fn json(&self, value: &T) -> Value {
        json!(T::ROWS.iter().find(|(_, known)| known == value).map(|(name, _)| name))
    }

    fn placeholder(&self) -> T {
        T::ROWS[0].1
    }

    fn choices(&self) -> Vec<(String, String)> {
        T::ROWS.iter().map(|(name, value)| ((*name).to_owned(), value.meaning_of())).collect()
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
        alternatives(T::ROWS.iter().enumerate().map(|(code, (name, _))| format!("{code} ({name})")))
    }

    fn read(&self, at: &mut At) -> Option<T> {
        let Json::Number(value) = at.node.json else {
            return at.wrong_type(&format!("the number {}", self.words()));
        };
        let code = whole(value).and_then(|code| usize::try_from(code).ok());
        let known = code.and_then(|code| T::ROWS.get(code)).map(|(_, value)| *value);
        known.or_else(|| at.not_allowed("scene::unknown_value", &self.words(), ""))
    }

    fn schema(&self) -> Value {
        json!({ "enum": (0..T::ROWS.len()).collect::<Vec<_>>() })
    }

    fn json(&self, value: &T) -> Value {
        json!(T::ROWS.iter().position(|(_, known)| known == value))
    }

    fn placeholder(&self) -> T {
        T::ROWS[0].1
    }

    fn choices(&self) -> Vec<(String, String)> {
        T::ROWS.iter().enumerate().map(|(code, (_, value))| (code.to_string(), value.meaning_of())).collect()
    }
}
