//! What a value must be: small rules, composed into one row for each key.

use serde_json::Value;

use super::diagnostic::Diagnostics;
use super::finding::Finding;
use super::node::{Json, Node};
use super::text::shown;

/// A value and the dotted key that leads to it.
pub(crate) struct At<'a> {
    pub(crate) diagnostics: &'a mut Diagnostics,
    pub(crate) key: &'a str,
    pub(crate) node: &'a Node,
}

/// What a value must be, and how it is read.
pub(crate) trait Rule {
    /// What the value becomes.
    type Value;
    /// What is allowed, in plain words: "a number from 0 to 1".
    fn words(&self) -> String;
    /// The value; nothing, after an error, if it is not allowed.
    fn read(&self, at: &mut At) -> Option<Self::Value>;
    /// The same as a JSON schema; it may accept what only the check of the whole document refuses.
    fn schema(&self) -> Value;
    /// The value as a document writes it.
    fn json(&self, value: &Self::Value) -> Value;
    /// A value in the place of one that is wrong or missing, so that reading can go on.
    fn placeholder(&self) -> Self::Value;
    /// The values to choose from, each with its meaning; none where the value is no choice.
    fn choices(&self) -> Vec<(String, String)> {
        Vec::new()
    }
}

impl At<'_> {
    /// Reports a value of the wrong type.
    pub(crate) fn wrong_type<T>(&mut self, words: &str) -> Option<T> {
        let help = match &self.node.json {
            Json::Text(text) if words.contains("number") && text.trim().parse::<f64>().is_ok() => {
                "write the number without quotes"
            }
            _ => "",
        };
        let message =
            format!("{} is {} but must be {words}", self.diagnostics.quoted(self.key), self.node.kind());
        self.refuse(Finding::new("scene::wrong_type", message).help(help), "wrong type")
    }

    /// Reports a value that its rule does not allow.
    pub(crate) fn not_allowed<T>(&mut self, code: &'static str, words: &str, help: &str) -> Option<T> {
        let found = shown(&self.diagnostics.text(self.node.span));
        let message = format!("{} is {found} but must be {words}", self.diagnostics.quoted(self.key));
        self.refuse(Finding::new(code, message).help(help), "not allowed")
    }

    fn wrong_length<T>(&mut self, length: usize, words: &str) -> Option<T> {
        let message = format!("`{}` has length {length} but must be {words}", self.key);
        self.refuse(Finding::new("scene::wrong_length", message), "wrong length")
    }

    fn refuse<T>(&mut self, finding: Finding, label: &str) -> Option<T> {
        self.diagnostics.error(finding.at(self.node.span, label).key(self.key));
        None
    }

    /// The items of a list of exactly `N` values, each read by `read` with its number.
    pub(crate) fn items<T, const N: usize>(
        &mut self,
        words: &str,
        read: impl FnMut(&mut At, usize) -> Option<T>,
    ) -> Option<[T; N]> {
        match &self.node.json {
            Json::List(items) if items.len() == N => self.list(words, read)?.try_into().ok(),
            Json::List(items) => self.wrong_length(items.len(), words),
            _ => self.wrong_type(words),
        }
    }

    /// The items of a list, each read by `read` with its number, until there are too many errors.
    pub(crate) fn list<T>(
        &mut self,
        words: &str,
        mut read: impl FnMut(&mut At, usize) -> Option<T>,
    ) -> Option<Vec<T>> {
        let Json::List(items) = &self.node.json else { return self.wrong_type(words) };
        let mut values = Vec::with_capacity(items.len());
        for (i, node) in items.iter().enumerate() {
            if self.diagnostics.is_full() {
                return None;
            }
            let key = format!("{}.{i}", self.key);
            values.push(read(&mut At { diagnostics: self.diagnostics, key: &key, node }, i));
        }
        values.into_iter().collect()
    }
}
