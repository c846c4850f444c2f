//! Reads the keys of an object by rules, and reports keys that are missing or unknown.

use super::format::{Json, Member, Node};
use super::meanings::objects_with;
use super::nearest::did_you_mean;
use super::report::{Finding, Report};
use super::rule::{At, Rule};
use super::schema::{Key, Shape};
use super::source::Span;
use super::words::{alternatives, join, quoted, shown};

/// An object of a scene file while its keys are read.
pub(super) struct Object<'a> {
    report: &'a mut Report,
    members: &'a [Member],
    span: Span,
    path: &'a str,
    known: Vec<&'static str>,
}

/// Reads the whole document, which must be an object, with `read`.
pub(super) fn document<T>(
    report: &mut Report,
    node: &Node,
    read: impl FnOnce(&mut Object) -> T,
) -> Option<T> {
    object(report, "", node, read)
}

fn object<T>(report: &mut Report, path: &str, node: &Node, read: impl FnOnce(&mut Object) -> T) -> Option<T> {
    let Json::Object(members) = &node.json else {
        return At { report, key: path, node }.wrong_type("an object");
    };
    let mut object = Object { report, members, span: node.span, path, known: Vec::new() };
    let value = read(&mut object);
    object.report_unknown();
    Some(value)
}

impl Object<'_> {
    /// The value of a key that must be given.
    pub(super) fn required<R: Rule>(&mut self, name: &'static str, rule: R) -> R::Value {
        self.note(name, true, || Shape::value(&rule, None));
        match self.find(name) {
            Some(node) => self.read(name, node, &rule),
            None => {
                self.report_missing(name, &rule.words());
                rule.stand_in()
            }
        }
    }

    /// The value of a key that may be left out.
    pub(super) fn optional<R: Rule>(&mut self, name: &'static str, default: R::Value, rule: R) -> R::Value {
        self.note(name, false, || Shape::value(&rule, Some(&default)));
        match self.find(name) {
            Some(node) => self.read(name, node, &rule),
            None => default,
        }
    }

    /// An object that may be left out, which means an empty one.
    pub(super) fn group<T>(&mut self, name: &'static str, read: impl FnOnce(&mut Object) -> T) -> Option<T> {
        self.note(name, false, || Shape::Object);
        let empty = self.empty();
        let path = self.join(name);
        let node = self.find(name).unwrap_or(&empty);
        object(self.report, &path, node, read)
    }

    /// An object that may be left out.
    pub(super) fn maybe<T>(&mut self, name: &'static str, read: impl FnOnce(&mut Object) -> T) -> Option<T> {
        let asked = self.note(name, false, || Shape::Object).then(|| self.empty());
        let path = self.join(name);
        self.find(name).or(asked.as_ref()).and_then(|node| object(self.report, &path, node, read))
    }

    /// No object, one, or a list of them.
    pub(super) fn each<T>(&mut self, name: &'static str, mut read: impl FnMut(&mut Object) -> T) -> Vec<T> {
        let asked = self.note(name, false, || Shape::Objects).then(|| self.empty());
        let path = self.join(name);
        let Some(node) = self.find(name).or(asked.as_ref()) else { return Vec::new() };
        let Json::List(items) = &node.json else {
            return object(self.report, &path, node, read).into_iter().collect();
        };
        let mut values = Vec::new();
        for (i, item) in items.iter().enumerate() {
            if self.report.is_full() {
                break;
            }
            values.extend(object(self.report, &format!("{path}.{i}"), item, &mut read));
        }
        values
    }

    /// Whether the key is given.
    pub(super) fn has(&self, name: &str) -> bool {
        self.members.iter().any(|member| member.key == name)
    }

    /// Notes the key, if the keys are asked for; whether they are.
    fn note(&mut self, name: &'static str, required: bool, shape: impl FnOnce() -> Shape) -> bool {
        if let Some(keys) = &mut self.report.keys {
            keys.push(Key { object: self.path.into(), name, required, shape: shape() });
        }
        self.report.keys.is_some()
    }

    fn empty(&self) -> Node {
        Node { span: self.span, json: Json::Object(Vec::new()) }
    }

    fn read<R: Rule>(&mut self, name: &str, node: &Node, rule: &R) -> R::Value {
        let key = self.join(name);
        let value = rule.read(&mut At { report: self.report, key: &key, node });
        value.unwrap_or_else(|| rule.stand_in())
    }

    fn join(&self, name: &str) -> String {
        join(self.path, name)
    }

    fn report_missing(&mut self, name: &str, words: &str) {
        let finding =
            Finding::new("scene::missing_key", format!("{} is missing `{name}`", quoted(self.path)))
                .at(self.span.first(), "in the object that starts here")
                .key(self.join(name))
                .help(format!("`{name}` is {words}"));
        self.report.error(finding);
    }

    fn report_unknown(&mut self) {
        for member in self.members.iter().filter(|m| !self.known.contains(&m.key.as_str())) {
            if self.report.is_full() {
                return;
            }
            let path = self.join(&shown(&member.key));
            let listed = || format!("the keys here are {}", self.known.join(", "));
            let help = did_you_mean(&member.key, self.known.iter().copied())
                .or_else(|| self.elsewhere(&member.key))
                .unwrap_or_else(listed);
            let finding = Finding::new("scene::unknown_key", format!("unknown key `{path}`"))
                .at(member.key_span, "not a key of this object")
                .key(path)
                .help(help);
            self.report.error(finding);
        }
    }

    /// "did you mean `material.shader`?" if other objects have a key of that name. An object that may
    /// stand in this one is meant there.
    fn elsewhere(&self, name: &str) -> Option<String> {
        let place = |object: &str| {
            let path = if self.known.contains(&object) { self.join(object) } else { object.into() };
            format!("`{}`", join(&path, name))
        };
        let places = alternatives(objects_with(name).map(place));
        (!places.is_empty()).then(|| format!("did you mean {places}?"))
    }
}

impl<'a> Object<'a> {
    /// The value of a key, which from now on is known.
    fn find(&mut self, name: &'static str) -> Option<&'a Node> {
        self.known.push(name);
        self.members.iter().find(|member| member.key == name).map(|member| &member.value)
    }
}
