//! What the values of a SPEC file must be.

use serde_json::{Value, json};

use super::super::json::finding::Finding;
use super::super::json::key::Key;
use super::super::json::node::{Json, Member};
use super::super::json::rule::{At, Rule};
use super::super::json::suggest::did_you_mean;
use super::super::keys::keys;
use super::axis::{self, Axis};

/// Text that is not empty.
pub(super) struct Text(pub(super) &'static str);

impl Rule for Text {
    type Value = String;

    fn words(&self) -> String {
        self.0.into()
    }

    fn read(&self, at: &mut At) -> Option<String> {
        match &at.node.json {
            Json::Text(text) if !text.is_empty() => Some(text.clone()),
            Json::Text(_) => at.not_allowed("sweep::no_name", self.0, ""),
            _ => at.wrong_type(self.0),
        }
    }

    fn schema(&self) -> Value {
        json!({ "type": "string", "minLength": 1 })
    }

    fn json(&self, value: &String) -> Value {
        json!(value)
    }

    fn placeholder(&self) -> String {
        String::new()
    }
}

/// A list of known names, at least one and each once.
pub(super) struct Names<'a>(pub(super) &'a [&'a str]);

impl Rule for Names<'_> {
    type Value = Vec<String>;

    fn words(&self) -> String {
        format!("a list of {}", self.0.join(", "))
    }

    fn read(&self, at: &mut At) -> Option<Vec<String>> {
        let names = at.list(&self.words(), |at, _| {
            let Json::Text(name) = &at.node.json else { return at.wrong_type("a name") };
            if self.0.contains(&name.as_str()) {
                return Some(name.clone());
            }
            let help = did_you_mean(name, self.0.iter().copied()).unwrap_or_default();
            at.not_allowed("sweep::unknown_measure", &format!("one of {}", self.0.join(", ")), &help)
        })?;
        let twice = names.iter().enumerate().any(|(i, name)| names[..i].contains(name));
        if names.is_empty() || twice {
            return at.not_allowed("sweep::measures", "a list of one or more names, each once", "");
        }
        Some(names)
    }

    fn schema(&self) -> Value {
        json!({ "type": "array", "items": { "enum": self.0 }, "minItems": 1, "uniqueItems": true })
    }

    fn json(&self, value: &Vec<String>) -> Value {
        json!(value)
    }

    fn placeholder(&self) -> Vec<String> {
        Vec::new()
    }
}

/// An object of keys of the scene, each with its values.
pub(super) struct Changes;

impl Rule for Changes {
    type Value = Vec<Axis>;

    fn words(&self) -> String {
        format!("an object whose keys are keys of the scene, each with {}", axis::WORDS)
    }

    fn read(&self, at: &mut At) -> Option<Vec<Axis>> {
        let Some(members) = at.node.members() else { return at.wrong_type(&self.words()) };
        let (paths, mut left) = (paths(), axis::MOST_IN_ALL);
        let mut axes = Vec::new();
        for member in members {
            let known = check_path(at, member, &member.key, &paths);
            let key = format!("{}.{}", at.key, member.key);
            let mut inside = At { diagnostics: at.diagnostics, key: &key, node: &member.value };
            axes.push(Axis::read(&member.key, &mut inside, &mut left).filter(|_| known));
        }
        axes.into_iter().collect()
    }

    fn schema(&self) -> Value {
        json!({ "type": "object", "additionalProperties": axis::schema() })
    }

    fn json(&self, value: &Vec<Axis>) -> Value {
        value.iter().map(|axis| (axis.path.clone(), json!(axis.values))).collect()
    }

    fn placeholder(&self) -> Vec<Axis> {
        Vec::new()
    }
}

/// Keys of a material with their values.
pub(super) struct Material;

impl Rule for Material {
    type Value = Vec<(String, Value)>;

    fn words(&self) -> String {
        "an object of keys of `material`".into()
    }

    fn read(&self, at: &mut At) -> Option<Self::Value> {
        let Some(members) = at.node.members() else { return at.wrong_type(&self.words()) };
        let paths = paths();
        let known =
            members.iter().map(|member| check_path(at, member, &format!("material.{}", member.key), &paths));
        let known: Vec<bool> = known.collect();
        let values = members.iter().map(|member| (member.key.clone(), member.value.plain()));
        known.iter().all(|&known| known).then(|| values.collect())
    }

    fn schema(&self) -> Value {
        json!({ "type": "object" })
    }

    fn json(&self, value: &Self::Value) -> Value {
        value.iter().cloned().collect()
    }

    fn placeholder(&self) -> Self::Value {
        Vec::new()
    }
}

/// The path of every key of scenes.
fn paths() -> Vec<String> {
    keys().iter().map(Key::path).collect()
}

/// Whether `path` is one of the `paths` of scenes; reports one that is not, at the key of `member`.
fn check_path(at: &mut At, member: &Member, path: &str, paths: &[String]) -> bool {
    let names: Vec<&str> = path.split('.').filter(|step| step.parse::<usize>().is_err()).collect();
    let name = names.join(".");
    let known = paths.contains(&name);
    // Looking for a similar name takes time.
    if known || at.diagnostics.is_full() {
        return known;
    }
    let help = did_you_mean(&name, paths.iter().map(String::as_str))
        .unwrap_or_else(|| "`drape schema` lists every key".into());
    let finding = Finding::new("sweep::unknown_key", format!("there is no key `{path}` in a scene"))
        .at(member.key_span, "not a key of a scene")
        .key(format!("{}.{}", at.key, member.key))
        .help(help);
    at.diagnostics.error(finding);
    false
}
