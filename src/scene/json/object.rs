//! Reads the keys of an object by their rows, and reports keys that are missing or unknown. The same
//! code lists the keys when it is asked to read nothing.

use super::diagnostic::Diagnostics;
use super::finding::Finding;
use super::key::{Key, Row, Shape};
use super::node::{Json, Member, Node};
use super::rule::{At, Rule};
use super::span::Span;
use super::suggest::did_you_mean;
use super::text::{alternatives, join, paragraph, shown};

/// What the objects of one document share while they are read.
struct Reader<'a> {
    diagnostics: &'a mut Diagnostics,
    document: &'a Node,
    /// The keys that were asked for, if they are listed.
    listed: Option<Vec<Key>>,
    /// Lists every key of a document.
    all: fn() -> Vec<Key>,
}

/// An object while its keys are read.
pub(crate) struct Object<'a, 'd> {
    reader: &'a mut Reader<'d>,
    members: &'a [Member],
    /// The object whose keys count where this one has none, if there is such a one.
    fallback: Option<&'a [Member]>,
    span: Span,
    path: &'a str,
    known: Vec<&'static str>,
}

/// Reads the whole document, which must be an object, with `read`; `all` lists the keys.
pub(crate) fn read<T>(
    diagnostics: &mut Diagnostics,
    document: &Node,
    all: fn() -> Vec<Key>,
    read: impl FnOnce(&mut Object) -> T,
) -> Option<T> {
    let mut reader = Reader { diagnostics, document, listed: None, all };
    reader.object("", document, None, read)
}

/// Every key that `read` asks for.
pub(crate) fn list<T>(read: impl FnOnce(&mut Object) -> T) -> Vec<Key> {
    let (diagnostics, document) = (&mut Diagnostics::default(), &NOTHING);
    let mut reader = Reader { diagnostics, document, listed: Some(Vec::new()), all: Vec::new };
    reader.object("", document, None, read);
    reader.listed.unwrap_or_default()
}

/// What `read` makes of an object without keys.
pub(crate) fn defaults<T>(read: impl FnOnce(&mut Object) -> T) -> T {
    let mut reader =
        Reader { diagnostics: &mut Diagnostics::default(), document: &NOTHING, listed: None, all: Vec::new };
    read(&mut Object {
        reader: &mut reader,
        members: &[],
        fallback: None,
        span: NOTHING.span,
        path: "",
        known: Vec::new(),
    })
}

/// An object without keys.
static NOTHING: Node = Node { span: Span::NOWHERE, json: Json::Object(Vec::new()) };

impl Reader<'_> {
    fn object<T>(
        &mut self,
        path: &str,
        node: &Node,
        fallback: Option<&[Member]>,
        read: impl FnOnce(&mut Object) -> T,
    ) -> Option<T> {
        let Json::Object(members) = &node.json else {
            return At { diagnostics: self.diagnostics, key: path, node }.wrong_type("an object");
        };
        let known = Vec::new();
        let mut object = Object { reader: self, members, fallback, span: node.span, path, known };
        let value = read(&mut object);
        object.report_unknown();
        Some(value)
    }
}

impl<'a> Object<'a, '_> {
    /// The value of a key that must be given.
    pub(crate) fn required<R: Rule>(&mut self, row: Row, rule: R) -> R::Value {
        self.list_value(row, &rule, None);
        match self.find(row.name) {
            Some(node) => self.value(row.name, node, &rule),
            None => {
                self.report_missing(row.name, &rule.words());
                rule.placeholder()
            }
        }
    }

    /// The value of a key that may be left out.
    pub(crate) fn optional<R: Rule>(&mut self, row: Row, default: R::Value, rule: R) -> R::Value {
        self.list_value(row, &rule, Some(&default));
        match self.find(row.name) {
            Some(node) => self.value(row.name, node, &rule),
            None => self.fallback_value(row.name, &rule).unwrap_or(default),
        }
    }

    /// An object that may be left out, which means one without keys.
    pub(crate) fn group<T>(&mut self, row: Row, read: impl FnOnce(&mut Object) -> T) -> Option<T> {
        self.list_key(row, || Shape::Object);
        let path = self.join(row.name);
        let node = self.find(row.name).unwrap_or(&NOTHING);
        self.reader.object(&path, node, None, read)
    }

    /// As a group, but keys that are left out are those of the document's object of the same name.
    pub(crate) fn inherited<T>(&mut self, row: Row, read: impl FnOnce(&mut Object) -> T) -> Option<T> {
        self.list_key(row, || Shape::Object);
        let path = self.join(row.name);
        let node = self.find(row.name).unwrap_or(&NOTHING);
        let fallback = match self.reader.document.get(row.name).map(|node| &node.json) {
            Some(Json::Object(members)) => members.as_slice(),
            _ => &[],
        };
        self.reader.object(&path, node, Some(fallback), read)
    }

    /// An object that may be left out, which means that there is none.
    pub(crate) fn maybe<T>(&mut self, row: Row, read: impl FnOnce(&mut Object) -> T) -> Option<T> {
        let listing = self.list_key(row, || Shape::Object);
        let path = self.join(row.name);
        let node = self.find(row.name).or(listing.then_some(&NOTHING))?;
        self.reader.object(&path, node, None, read)
    }

    /// No object, one, or a list of them.
    pub(crate) fn each<T>(&mut self, row: Row, mut read: impl FnMut(&mut Object) -> T) -> Vec<T> {
        let listing = self.list_key(row, || Shape::Objects);
        let path = self.join(row.name);
        let Some(node) = self.find(row.name).or(listing.then_some(&NOTHING)) else { return Vec::new() };
        let Json::List(items) = &node.json else {
            return self.reader.object(&path, node, None, read).into_iter().collect();
        };
        let mut values = Vec::new();
        for (i, item) in items.iter().enumerate() {
            if self.reader.diagnostics.is_full() {
                break;
            }
            values.extend(self.reader.object(&format!("{path}.{i}"), item, None, &mut read));
        }
        values
    }

    /// Whether the key is given, here or where this object falls back to.
    pub(crate) fn has(&self, name: &str) -> bool {
        [Some(self.members), self.fallback].into_iter().flatten().any(|members| get(members, name).is_some())
    }

    /// The value of a key, which from now on is known.
    fn find(&mut self, name: &'static str) -> Option<&'a Node> {
        self.known.push(name);
        get(self.members, name)
    }

    fn value<R: Rule>(&mut self, name: &str, node: &Node, rule: &R) -> R::Value {
        let key = self.join(name);
        let value = rule.read(&mut At { diagnostics: self.reader.diagnostics, key: &key, node });
        value.unwrap_or_else(|| rule.placeholder())
    }

    /// The value that the other object gives; what is wrong there is reported there.
    fn fallback_value<R: Rule>(&self, name: &str, rule: &R) -> Option<R::Value> {
        let node = get(self.fallback?, name)?;
        rule.read(&mut At { diagnostics: &mut Diagnostics::default(), key: name, node })
    }

    fn join(&self, name: &str) -> String {
        join(self.path, name)
    }

    /// Lists the key of a value, if keys are listed.
    fn list_value<R: Rule>(&mut self, row: Row, rule: &R, default: Option<&R::Value>) {
        let inherits = self.fallback.is_some();
        self.list_key(row, || Shape::value(rule, default, inherits));
    }

    /// Lists the key, if keys are listed; whether they are.
    fn list_key(&mut self, row: Row, shape: impl FnOnce() -> Shape) -> bool {
        if let Some(keys) = &mut self.reader.listed {
            let Row { name, doc, local } = row;
            keys.push(Key { object: self.path.into(), name, meaning: paragraph(doc), shape: shape(), local });
        }
        self.reader.listed.is_some()
    }

    fn report_missing(&mut self, name: &str, words: &str) {
        let finding = Finding::new(
            "scene::missing_key",
            format!("{} is missing `{name}`", self.reader.diagnostics.quoted(self.path)),
        )
        .at(self.span.first(), "in the object that starts here")
        .key(self.join(name))
        .help(format!("`{name}` is {words}"));
        self.reader.diagnostics.error(finding);
    }

    fn report_unknown(&mut self) {
        for member in self.members.iter().filter(|m| !self.known.contains(&m.key.as_str())) {
            if self.reader.diagnostics.is_full() {
                return;
            }
            let path = self.join(&shown(&member.key));
            let finding = Finding::new("scene::unknown_key", format!("unknown key `{path}`"))
                .at(member.key_span, "not a key of this object")
                .key(path)
                .help(self.suggestion(&member.key));
            self.reader.diagnostics.error(finding);
        }
    }

    /// What an unknown key may have been meant to be.
    fn suggestion(&self, name: &str) -> String {
        did_you_mean(name, self.known.iter().copied())
            .or_else(|| self.elsewhere(name))
            .unwrap_or_else(|| format!("the keys here are {}", self.known.join(", ")))
    }

    /// "did you mean `material.shader`?" if other objects have a key of that name. An object that may
    /// stand in this one is meant there.
    fn elsewhere(&self, name: &str) -> Option<String> {
        let keys = (self.reader.all)();
        let meant = |key: &&Key| {
            let inside = self.known.contains(&key.object.as_str());
            key.name == name && !key.object.contains('.') && (!key.local || inside || self.path.is_empty())
        };
        let place = |key: &Key| {
            let inside = self.known.contains(&key.object.as_str());
            format!("`{}`", if inside { self.join(&key.path()) } else { key.path() })
        };
        let places = alternatives(keys.iter().filter(meant).map(place));
        (!places.is_empty()).then(|| format!("did you mean {places}?"))
    }
}

fn get<'a>(members: &'a [Member], name: &str) -> Option<&'a Node> {
    members.iter().find(|member| member.key == name).map(|member| &member.value)
}
