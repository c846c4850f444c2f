//! Changes to a scene from outside: merge patches and `--set PATH=JSON`.

use std::collections::BTreeMap;

use super::ColliderKind;
use super::json::diagnostic::Diagnostics;
use super::json::finding::Finding;
use super::json::node::{Json, Member, Node};
use super::json::parse::parse;
use super::json::span::Span;
use super::json::text::{join, quoted, shown};
use crate::error::{Error, Kind, Result};

/// Most steps of a `--set` path; a scene needs four.
const MOST_STEPS: usize = 64;

/// `target` changed by a JSON merge patch (RFC 7396): objects are merged, `null` removes, anything
/// else replaces.
pub(super) fn merge(target: Node, patch: Node) -> Node {
    let Json::Object(changes) = patch.json else { return patch };
    let (span, members) = match target.json {
        Json::Object(members) => (target.span, members),
        _ => (patch.span, Vec::new()),
    };
    let mut places: BTreeMap<String, usize> =
        members.iter().enumerate().map(|(i, member)| (member.key.clone(), i)).collect();
    let mut slots: Vec<Option<Member>> = members.into_iter().map(Some).collect();
    for change in changes {
        let place = *places.entry(change.key.clone()).or_insert_with(|| {
            slots.push(None);
            slots.len() - 1
        });
        if let Some(slot) = slots.get_mut(place) {
            *slot = merged_member(slot.take(), change);
        }
    }
    Node { span, json: Json::Object(slots.into_iter().flatten().collect()) }
}

fn merged_member(old: Option<Member>, change: Member) -> Option<Member> {
    if change.value.json == Json::Null {
        return None;
    }
    let absent = Node { span: change.value.span, json: Json::Null };
    Some(match old {
        Some(old) => Member { value: merge(old.value, change.value), ..old },
        None => Member { value: merge(absent, change.value), ..change },
    })
}

/// One `--set PATH=JSON`, read.
pub(super) struct Set {
    steps: Vec<Step>,
    value: Node,
}

/// One name or number of a path.
#[derive(Clone)]
struct Step {
    name: String,
    span: Span,
}

/// Reads `PATH=JSON`; a bare word that is not JSON is text. Gives nothing, after an error, if the
/// value is not JSON.
///
/// # Errors
/// [`Kind::Usage`] if `argument` has no `=`, or an empty or far too long path.
pub(super) fn read_set(diagnostics: &mut Diagnostics, argument: &str) -> Result<Option<Set>> {
    let usage = |what: &str| {
        Error::new(Kind::Usage, format!("`--set {}`: {what}", shown(argument)))
            .with_help("write a dotted key and a JSON value, such as `--set cloth.ks=500`")
    };
    let (path, value) = argument.split_once('=').ok_or_else(|| usage("there is no `=`"))?;
    let source = diagnostics.add_source(format!("--set {argument}"), argument);
    let steps = steps(path, source);
    if steps.len() > MOST_STEPS {
        return Err(usage("the path is too long"));
    }
    if steps.iter().any(|step| step.name.is_empty()) {
        return Err(usage("the path has an empty step"));
    }
    let start = path.len() + 1;
    let value = if is_bare_word(value) {
        let span = Span { source, start, end: argument.len() };
        Some(Node { span, json: Json::Text(value.into()) })
    } else {
        parse(diagnostics, source, start)
    };
    Ok(value.map(|value| Set { steps, value }))
}

fn steps(path: &str, source: usize) -> Vec<Step> {
    let mut start = 0;
    path.split('.')
        .map(|name| {
            let span = Span { source, start, end: start + name.len() };
            start = span.end + 1;
            Step { name: name.into(), span }
        })
        .collect()
}

fn is_bare_word(value: &str) -> bool {
    let inside = |c: char| c.is_ascii_alphanumeric() || "_-.".contains(c);
    value.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_')
        && value.chars().all(inside)
        && !["true", "false", "null"].contains(&value)
}

/// Puts the value of `set` into `document`; objects on the way are made where they are missing.
pub(super) fn apply(diagnostics: &mut Diagnostics, document: &mut Node, set: Set) {
    let steps = list_steps(document, set.steps);
    insert(diagnostics, document, &steps, "", set.value);
}

/// Lets one collider count as a list of one, and a list of one as its only collider.
fn list_steps(document: &Node, mut steps: Vec<Step>) -> Vec<Step> {
    let [list, second, ..] = steps.as_slice() else { return steps };
    if ColliderKind::ALL.iter().all(|kind| kind.key() != list.name) {
        return steps;
    }
    match document.get(&list.name).map(|node| &node.json) {
        Some(Json::List(items)) if items.len() == 1 && second.name.parse::<usize>().is_err() => {
            steps.insert(1, Step { name: "0".into(), span: second.span });
        }
        Some(Json::Object(_)) | None if second.name == "0" => {
            steps.remove(1);
        }
        _ => {}
    }
    steps
}

fn insert(diagnostics: &mut Diagnostics, node: &mut Node, steps: &[Step], path: &str, value: Node) {
    let Some((step, rest)) = steps.split_first() else {
        *node = value;
        return;
    };
    let kind = node.kind();
    let inner = match &mut node.json {
        Json::Object(members) => Some(member(members, step)),
        Json::List(items) => step.name.parse().ok().and_then(|i: usize| items.get_mut(i)),
        _ => None,
    };
    match inner {
        Some(inner) => insert(diagnostics, inner, rest, &join(path, &step.name), value),
        None => diagnostics.error(no_such_place(step, path, kind)),
    }
}

/// The value of a key, made if it is not there.
fn member<'a>(members: &'a mut Vec<Member>, step: &Step) -> &'a mut Node {
    let place = members.iter().position(|member| member.key == step.name).unwrap_or(members.len());
    if place == members.len() {
        let value = Node { span: step.span, json: Json::Object(Vec::new()) };
        members.push(Member { key: step.name.clone(), key_span: step.span, value });
    }
    &mut members[place].value
}

fn no_such_place(step: &Step, path: &str, kind: &str) -> Finding {
    let key = shown(&join(path, &step.name));
    Finding::new("scene::no_such_place", format!("there is no `{key}`: {} is {kind}", quoted(&shown(path))))
        .at(step.span, "no such place")
        .key(key)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn node(text: &str) -> Node {
        let mut diagnostics = Diagnostics::default();
        let source = diagnostics.add_source("x.json", text);
        parse(&mut diagnostics, source, 0).unwrap()
    }

    fn plain(node: &Node) -> serde_json::Value {
        match &node.json {
            Json::Null => serde_json::Value::Null,
            Json::Bool(value) => (*value).into(),
            Json::Number(value) => (*value).into(),
            Json::Text(text) => text.as_str().into(),
            Json::List(items) => items.iter().map(plain).collect(),
            Json::Object(members) => members.iter().map(|m| (m.key.clone(), plain(&m.value))).collect(),
        }
    }

    #[test]
    fn merge_gives_every_example_of_rfc_7396() {
        // Appendix A: original, patch, result.
        let examples = [
            (r#"{"a":"b"}"#, r#"{"a":"c"}"#, r#"{"a":"c"}"#),
            (r#"{"a":"b"}"#, r#"{"b":"c"}"#, r#"{"a":"b","b":"c"}"#),
            (r#"{"a":"b"}"#, r#"{"a":null}"#, r#"{}"#),
            (r#"{"a":"b","b":"c"}"#, r#"{"a":null}"#, r#"{"b":"c"}"#),
            (r#"{"a":["b"]}"#, r#"{"a":"c"}"#, r#"{"a":"c"}"#),
            (r#"{"a":"c"}"#, r#"{"a":["b"]}"#, r#"{"a":["b"]}"#),
            (r#"{"a":{"b":"c"}}"#, r#"{"a":{"b":"d","c":null}}"#, r#"{"a":{"b":"d"}}"#),
            (r#"{"a":[{"b":"c"}]}"#, r#"{"a":[1]}"#, r#"{"a":[1]}"#),
            (r#"["a","b"]"#, r#"["c","d"]"#, r#"["c","d"]"#),
            (r#"{"a":"b"}"#, r#"["c"]"#, r#"["c"]"#),
            (r#"{"a":"foo"}"#, r#"null"#, r#"null"#),
            (r#"{"a":"foo"}"#, r#""bar""#, r#""bar""#),
            (r#"{"e":null}"#, r#"{"a":1}"#, r#"{"e":null,"a":1}"#),
            (r#"[1,2]"#, r#"{"a":"b","c":null}"#, r#"{"a":"b"}"#),
            (r#"{}"#, r#"{"a":{"bb":{"ccc":null}}}"#, r#"{"a":{"bb":{}}}"#),
        ];
        for (original, patch, result) in examples {
            let merged = merge(node(original), node(patch));
            assert_eq!(plain(&merged), plain(&node(result)), "{original} with {patch}");
        }
    }

    fn after(text: &str, set: &str) -> String {
        let mut diagnostics = Diagnostics::default();
        let mut document = node(text);
        let set = read_set(&mut diagnostics, set).unwrap().unwrap();
        apply(&mut diagnostics, &mut document, set);
        diagnostics.finish().unwrap();
        plain(&document).to_string()
    }

    #[test]
    fn a_set_replaces_what_is_there_and_makes_what_is_not() {
        assert_eq!(after(r#"{"a": {"b": 1}}"#, "a.b=true"), r#"{"a":{"b":true}}"#);
        assert_eq!(after(r#"{"a": {"b": 1}}"#, r#"a={"c": "x=y"}"#), r#"{"a":{"c":"x=y"}}"#);
        assert_eq!(after("{}", "a.b.c=null"), r#"{"a":{"b":{"c":null}}}"#);
        assert_eq!(after(r#"{"a": [true, [false]]}"#, "a.1.0=null"), r#"{"a":[true,[null]]}"#);
        assert_eq!(after("{}", "a=bump"), r#"{"a":"bump"}"#);
        assert_eq!(after("{}", "a= \"bump\" "), r#"{"a":"bump"}"#);
    }
}
