//! What a value must be: small rules, composed in `fields.rs` into one line for each key.

use serde_json::Value;

use super::format::{Json, Node};
use super::report::{Finding, Report};
use super::words::{quoted, shown};

/// A value in a scene file and the dotted key that leads to it.
pub(super) struct At<'a> {
    pub(super) report: &'a mut Report,
    pub(super) key: &'a str,
    pub(super) node: &'a Node,
}

/// What a value must be, and how it is read.
pub(super) trait Rule {
    /// What the value becomes.
    type Value;
    /// What is allowed, in plain words: "a number from 0 to 1".
    fn words(&self) -> String;
    /// The value; nothing, after a report, if it is not allowed.
    fn read(&self, at: &mut At) -> Option<Self::Value>;
    /// The same as a JSON schema; it may let pass what only the check of the whole scene refuses.
    fn schema(&self) -> Value;
    /// The value as a scene file writes it.
    fn json(&self, value: &Self::Value) -> Value;
    /// Stands in for a value that is wrong or missing, in a scene that is thrown away.
    fn stand_in(&self) -> Self::Value;
}

impl At<'_> {
    /// Reports a value of the wrong type.
    pub(super) fn wrong_type<T>(&mut self, words: &str) -> Option<T> {
        let help = match &self.node.json {
            Json::Text(text) if words.contains("number") && text.trim().parse::<f64>().is_ok() => {
                "write the number without quotes"
            }
            _ => "",
        };
        let kind = self.node.kind();
        let message = format!("{} is {kind} but must be {words}", quoted(self.key));
        let finding = Finding::new("scene::wrong_type", message)
            .at(self.node.span, "wrong type")
            .key(self.key)
            .help(help);
        self.report.error(finding);
        None
    }

    /// Reports a value that its rule does not allow.
    pub(super) fn not_allowed<T>(&mut self, code: &'static str, words: &str, help: &str) -> Option<T> {
        let found = shown(&self.report.text(self.node.span));
        let message = format!("{} is {found} but must be {words}", quoted(self.key));
        let finding = Finding::new(code, message).at(self.node.span, "not allowed").key(self.key).help(help);
        self.report.error(finding);
        None
    }

    /// The items of a list of exactly `N` values, each read by `read` with its number.
    pub(super) fn items<T, const N: usize>(
        &mut self,
        words: &str,
        mut read: impl FnMut(&mut At, usize) -> Option<T>,
    ) -> Option<[T; N]> {
        let Json::List(items) = &self.node.json else { return self.wrong_type(words) };
        if items.len() != N {
            let message = format!("`{}` has length {} but must be {words}", self.key, items.len());
            let finding =
                Finding::new("scene::wrong_length", message).at(self.node.span, "wrong length").key(self.key);
            self.report.error(finding);
            return None;
        }
        let values: Vec<Option<T>> =
            items.iter().enumerate().map(|(i, node)| self.item(i, node, &mut read)).collect();
        let values: Vec<T> = values.into_iter().collect::<Option<_>>()?;
        values.try_into().ok()
    }

    /// One item of a list, read by `read` with its number `i`; none if there are too many errors.
    pub(super) fn item<T>(
        &mut self,
        i: usize,
        node: &Node,
        read: &mut impl FnMut(&mut At, usize) -> Option<T>,
    ) -> Option<T> {
        if self.report.is_full() {
            return None;
        }
        let key = format!("{}.{i}", self.key);
        read(&mut At { report: self.report, key: &key, node }, i)
    }
}
