//! Reads JSON documents by rows of keys: with the place of every value, all errors at once, and a
//! schema from the same rows. It knows nothing of scenes.
//!
//! Data flows `text -> parse -> Node -> object -> values`; `diagnostic` collects what is wrong.

pub(crate) mod choice;
pub(crate) mod diagnostic;
pub(crate) mod finding;
pub(crate) mod key;
pub(crate) mod keys;
pub(crate) mod list;
pub(crate) mod merge;
pub(crate) mod node;
pub(crate) mod number;
pub(crate) mod object;
pub(crate) mod parse;
mod path;
pub(crate) mod range;
pub(crate) mod rule;
pub(crate) mod scalar;
pub(crate) mod schema;
mod snippet;
pub(crate) mod span;
pub(crate) mod suggest;
pub(crate) mod text;
#[cfg(test)]
pub(crate) mod testing;
