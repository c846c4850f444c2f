//! Changes to a scene from outside its file: `--set PATH=JSON` and flags.

use super::ColliderKind;
use super::json::diagnostic::Diagnostics;
use super::json::finding::Finding;
use super::json::node::{Json, Member, Node};
use super::json::parse::parse;
use super::json::span::Span;
use super::json::text::{join, quoted, shown};
use super::keys::keys;
use crate::error::{Error, Kind, Result};

/// Most steps of a `--set` path; a scene needs four.
const MOST_STEPS: usize = 64;

/// One `PATH=JSON`, read.
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

/// Reads `PATH=JSON`, which `option` of the command line makes; a bare word that is not JSON is text. Gives
/// nothing, after an error, if the value is not JSON.
///
/// # Errors
/// [`Kind::Usage`] if `argument` has no `=`, or an empty or far too long path.
pub(super) fn read_set(diagnostics: &mut Diagnostics, option: &str, argument: &str) -> Result<Option<Set>> {
    let usage = |what: &str| {
        Error::new(Kind::Usage, format!("`{option} {}`: {what}", shown(argument)))
            .with_help("write a dotted key and a JSON value, such as `--set cloth.ks=500`")
    };
    let (path, value) = argument.split_once('=').ok_or_else(|| usage("there is no `=`"))?;
    let source = diagnostics.add_source(format!("{option} {argument}"), argument);
    let steps = steps(path, source);
    if steps.len() > MOST_STEPS {
        return Err(usage(&format!("the path has {} steps, and at most {MOST_STEPS} are read", steps.len())));
    }
    if steps.iter().any(|step| step.name.is_empty()) {
        return Err(usage("the path has an empty step"));
    }
    let span = Span { source, start: path.len() + 1, end: argument.len() };
    let value = if is_bare_word(value) {
        Some(Node { span, json: Json::Text(value.into()) })
    } else if let Some(help) = nearly_number(path, value) {
        let message = format!("`{}` is neither a number nor another JSON value", shown(value));
        diagnostics.error(Finding::new("scene::syntax", message).at(span, "here").key(path).help(help));
        None
    } else {
        parse(diagnostics, source, span.start)
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

/// What to write instead of a `value` that starts as a number but is not one in JSON, such as `5k`.
fn nearly_number(path: &str, value: &str) -> Option<String> {
    let ends = value.char_indices().map(|(i, c)| i + c.len_utf8());
    let (number, rest) = ends.rev().find_map(|end| {
        let (number, rest) = value.split_at(end);
        Some((number.trim().parse::<f64>().ok().filter(|number| number.is_finite())?, rest.trim()))
    })?;
    if serde_json::from_str::<serde::de::IgnoredAny>(value).is_ok() {
        return None;
    }
    match rest {
        "k" => Some(format!("write `--set {path}={}`", number * 1e3)),
        rest if rest.starts_with(',') => {
            Some(format!("a list stands in brackets: `--set '{path}=[{value}]'`"))
        }
        _ => Some(format!("write the number alone, `--set {path}={number}`, or text in quotes")),
    }
}

/// Puts the value of `set` into `document`; objects on the way are made where they are missing.
pub(super) fn apply(diagnostics: &mut Diagnostics, document: &mut Node, set: Set) {
    let steps = list_steps(document, set.steps);
    if let ([step], Json::Null, Json::Object(members)) =
        (steps.as_slice(), &set.value.json, &mut document.json)
    {
        return members.retain(|member| member.key != step.name);
    }
    insert(diagnostics, document, &steps, "", set.value);
}

/// As [`apply`], but `*` in the path stands for every object that is there under the key before it.
pub(super) fn apply_to_each(diagnostics: &mut Diagnostics, document: &mut Node, set: Set) {
    let Some(place) = set.steps.iter().position(|step| step.name == "*") else {
        return apply(diagnostics, document, set);
    };
    let path: Vec<&str> = set.steps[..place].iter().map(|step| step.name.as_str()).collect();
    let numbers: Vec<String> = match document.get(&path.join(".")).map(|node| &node.json) {
        Some(Json::List(items)) => (0..items.len()).map(|i| i.to_string()).collect(),
        Some(_) => vec![String::new()],
        None => Vec::new(),
    };
    for number in numbers {
        let mut steps = set.steps.clone();
        match number.as_str() {
            "" => drop(steps.remove(place)),
            _ => steps[place].name = number,
        }
        insert(diagnostics, document, &steps, "", set.value.clone());
    }
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
    let (kind, path_here) = (node.kind(), join(path, &step.name));
    let inner = match &mut node.json {
        Json::Object(members) => Some(member(members, step, || missing(&path_here, rest))),
        Json::List(items) => step.name.parse().ok().and_then(|i: usize| items.get_mut(i)),
        _ => None,
    };
    match inner {
        Some(inner) => insert(diagnostics, inner, rest, &path_here, value),
        None => diagnostics.error(no_such_place(step, path, kind)),
    }
}

/// The value of a key, made if it is not there.
fn member<'a>(members: &'a mut Vec<Member>, step: &Step, missing: impl FnOnce() -> Json) -> &'a mut Node {
    let place = members.iter().position(|member| member.key == step.name).unwrap_or(members.len());
    if place == members.len() {
        let value = Node { span: step.span, json: missing() };
        members.push(Member { key: step.name.clone(), key_span: step.span, value });
    }
    &mut members[place].value
}

/// What stands at `path` in the place of a value that is missing: the default list where one of its items is
/// set, so that the others keep their values, else an object without keys.
fn missing(path: &str, rest: &[Step]) -> Json {
    let of_item = rest.first().is_some_and(|step| step.name.parse::<usize>().is_ok());
    let default = of_item.then(|| default_list(path)).flatten();
    default.unwrap_or_else(|| Json::Object(Vec::new()))
}

/// The numbers that are the default of the key at `path`.
fn default_list(path: &str) -> Option<Json> {
    let names: Vec<&str> = path.split('.').filter(|step| step.parse::<usize>().is_err()).collect();
    let key = keys().into_iter().find(|key| key.path() == names.join("."))?;
    let number =
        |value: &serde_json::Value| Some(Node { span: Span::NOWHERE, json: Json::Number(value.as_f64()?) });
    Some(Json::List(key.default()?.as_array()?.iter().map(number).collect::<Option<_>>()?))
}

fn no_such_place(step: &Step, path: &str, kind: &str) -> Finding {
    let key = shown(&join(path, &step.name));
    Finding::new("scene::no_such_place", format!("there is no `{key}`: {} is {kind}", quoted(&shown(path))))
        .at(step.span, "no such place")
        .key(key)
}

#[cfg(test)]
mod tests {
    use super::super::json::testing::node;
    use super::*;

    fn after(text: &str, set: &str) -> String {
        let mut diagnostics = Diagnostics::default();
        let mut document = node(text);
        let set = read_set(&mut diagnostics, "--set", set).unwrap().unwrap();
        apply(&mut diagnostics, &mut document, set);
        diagnostics.finish().unwrap();
        document.plain().to_string()
    }

    #[test]
    fn a_set_replaces_what_is_there_and_makes_what_is_not() {
        assert_eq!(after(r#"{"a": {"b": 1}}"#, "a.b=true"), r#"{"a":{"b":true}}"#);
        assert_eq!(after(r#"{"a": {"b": 1}}"#, r#"a={"c": "x=y"}"#), r#"{"a":{"c":"x=y"}}"#);
        assert_eq!(after("{}", "a.b.c=null"), r#"{"a":{"b":{"c":null}}}"#);
        assert_eq!(after(r#"{"a": [true, [false]]}"#, "a.1.0=null"), r#"{"a":[true,[null]]}"#);
        assert_eq!(after(r#"{"a": {"b": 1}, "c": true}"#, "a=null"), r#"{"c":true}"#);
        assert_eq!(after("{}", "a=bump"), r#"{"a":"bump"}"#);
        assert_eq!(after("{}", "a= \"bump\" "), r#"{"a":"bump"}"#);
    }

    #[test]
    fn an_item_of_a_list_that_is_left_out_is_set_in_the_default_list() {
        assert_eq!(after("{}", "sim.gravity.1=-1.5"), r#"{"sim":{"gravity":[0,-1.5,0]}}"#);
        let after = after(r#"{"sphere": [{}, {}]}"#, "sphere.1.resolution.0=8");
        assert_eq!(after, r#"{"sphere":[{},{"resolution":[8,40]}]}"#);
    }

    #[test]
    fn a_star_is_every_object_that_is_there() {
        let after = |text: &str, set: &str| {
            let (mut diagnostics, mut document) = (Diagnostics::default(), node(text));
            let set = read_set(&mut diagnostics, "--shader", set).unwrap().unwrap();
            apply_to_each(&mut diagnostics, &mut document, set);
            diagnostics.finish().unwrap();
            document.plain().to_string()
        };
        assert_eq!(
            after(r#"{"sphere": [{}, {"a": {}}]}"#, "sphere.*.a.b=true"),
            r#"{"sphere":[{"a":{"b":true}},{"a":{"b":true}}]}"#
        );
        assert_eq!(after(r#"{"sphere": {}}"#, "sphere.*.a=true"), r#"{"sphere":{"a":true}}"#);
        assert_eq!(after("{}", "sphere.*.a=true"), "{}");
        assert_eq!(after("{}", "a.b=true"), r#"{"a":{"b":true}}"#);
    }

    #[test]
    fn what_is_nearly_a_number_is_written_out() {
        let help = |value: &str| nearly_number("cloth.ks", value);
        assert_eq!(help("5k").as_deref(), Some("write `--set cloth.ks=5000`"));
        assert_eq!(
            help("5 N/m").as_deref(),
            Some("write the number alone, `--set cloth.ks=5`, or text in quotes")
        );
        assert_eq!(
            help(".5").as_deref(),
            Some("write the number alone, `--set cloth.ks=0.5`, or text in quotes")
        );
        assert_eq!(help("1,2,3").as_deref(), Some("a list stands in brackets: `--set 'cloth.ks=[1,2,3]'`"));
        for fine in ["5", "-5e3", " 5 ", "1e999", "[5]", "{}", "\"5k\"", ""] {
            assert_eq!(help(fine), None, "{fine}");
        }
    }
}
