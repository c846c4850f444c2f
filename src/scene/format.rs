//! JSON text to a tree in which every value knows the place where it stands.

use jsonc_parser::ast::{self, ObjectPropName};
use jsonc_parser::common::{Range, Ranged};
use jsonc_parser::errors::{ParseError, ParseErrorKind};
use jsonc_parser::{CollectOptions, ParseOptions, parse_to_ast};

use super::path::{Path, Step};
use super::report::{Finding, Report};
use super::source::Span;
use super::words::shown;

/// Deepest nesting of objects and lists that is read; a scene needs four.
const MOST_LEVELS: usize = 64;

/// JSON and nothing looser.
const STRICT: ParseOptions = ParseOptions {
    allow_comments: false,
    allow_loose_object_property_names: false,
    allow_trailing_commas: false,
    allow_missing_commas: false,
    allow_single_quoted_strings: false,
    allow_hexadecimal_numbers: false,
    allow_unary_plus_numbers: false,
    allow_bare_decimal_point_numbers: false,
    allow_non_finite_numbers: false,
    allow_extended_string_escapes: false,
};

/// A JSON value and where it stands.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Node {
    pub(super) span: Span,
    pub(super) json: Json,
}

/// A JSON value. Numbers are the nearest binary64 (infinite if beyond its range).
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Json {
    Null,
    Bool(bool),
    Number(f64),
    Text(String),
    List(Vec<Node>),
    Object(Vec<Member>),
}

/// A key of an object with its value.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Member {
    pub(super) key: String,
    pub(super) key_span: Span,
    pub(super) value: Node,
}

impl Node {
    /// What the value is, in plain words.
    pub(super) fn kind(&self) -> &'static str {
        match self.json {
            Json::Null => "null",
            Json::Bool(_) => "true or false",
            Json::Number(_) => "a number",
            Json::Text(_) => "text",
            Json::List(_) => "a list",
            Json::Object(_) => "an object",
        }
    }

    /// The value at a dotted path such as `cloth.pinned.0`.
    pub(super) fn get(&self, path: &str) -> Option<&Self> {
        path.split('.').try_fold(self, |node, step| match &node.json {
            Json::Object(members) => members.iter().find(|m| m.key == step).map(|m| &m.value),
            Json::List(items) => items.get(step.parse::<usize>().ok()?),
            _ => None,
        })
    }
}

/// Reads the part of a source from byte `start` on as one JSON value.
///
/// Duplicate keys are reported and the first one is kept. Returns nothing, after a report, if the
/// text is not JSON.
pub(super) fn parse(report: &mut Report, source: usize, start: usize) -> Option<Node> {
    let whole = report.sources.get(source)?.text.clone();
    let text = whole.get(start..).unwrap_or("");
    let mut tree = Tree { report, source, start };
    match parse_to_ast(text, &CollectOptions::default(), &STRICT) {
        Err(error) => tree.syntax_error(&error),
        Ok(parsed) => match parsed.value {
            Some(value) if tree.is_json(text) => tree.node(value, &Path::ROOT),
            Some(_) => None,
            None => tree.nothing_there(text.len()),
        },
    }
}

/// Builds the tree of one source.
struct Tree<'a> {
    report: &'a mut Report,
    source: usize,
    start: usize,
}

impl Tree<'_> {
    fn span(&self, range: Range) -> Span {
        Span { source: self.source, start: self.start + range.start, end: self.start + range.end }
    }

    fn node(&mut self, value: ast::Value<'_>, path: &Path) -> Option<Node> {
        let span = self.span(value.range());
        if path.level > MOST_LEVELS {
            return self.too_deep(span);
        }
        let json = match value {
            ast::Value::NullKeyword(_) => Json::Null,
            ast::Value::BooleanLit(literal) => Json::Bool(literal.value),
            ast::Value::NumberLit(literal) => Json::Number(literal.value.parse().ok()?),
            ast::Value::StringLit(literal) => Json::Text(literal.value.into_owned()),
            ast::Value::Array(array) => {
                let numbered = array.elements.into_iter().enumerate();
                let items = numbered.map(|(i, item)| self.node(item, &path.then(Step::Number(i))));
                Json::List(items.collect::<Option<_>>()?)
            }
            ast::Value::Object(object) => Json::Object(self.members(object.properties, path)?),
        };
        Some(Node { span, json })
    }

    fn members(&mut self, properties: Vec<ast::ObjectProp<'_>>, path: &Path) -> Option<Vec<Member>> {
        let mut members = Vec::with_capacity(properties.len());
        let mut seen = std::collections::BTreeMap::new();
        for property in properties {
            let key_span = self.span(match &property.name {
                ObjectPropName::String(name) => name.range,
                ObjectPropName::Word(name) => name.range,
            });
            let key = property.name.into_string();
            let path = path.then(Step::Name(&key));
            let value = self.node(property.value, &path)?;
            match seen.get(&key) {
                Some(&first) => self.duplicate(&path, key_span, first),
                None => {
                    seen.insert(key.clone(), key_span);
                    members.push(Member { key, key_span, value });
                }
            }
        }
        Some(members)
    }

    fn duplicate(&mut self, path: &Path, span: Span, first: Span) {
        let key = shown(&path.dotted());
        let message = format!("duplicate key `{key}`");
        let finding = Finding::new("scene::duplicate_key", message)
            .at(span, "given again here")
            .key(key)
            .also(Some(first), "first given here")
            .help("keep one of the two");
        self.report.error(finding);
    }

    fn too_deep<T>(&mut self, span: Span) -> Option<T> {
        let label = format!("nested deeper than {MOST_LEVELS} levels");
        self.report.error(Finding::new("scene::syntax", "nested too deeply").at(span.first(), label));
        None
    }

    fn syntax_error<T>(&mut self, error: &ParseError) -> Option<T> {
        let span = self.span(error.range());
        if matches!(error.kind(), ParseErrorKind::NestingDepthExceeded) {
            return self.too_deep(span);
        }
        self.not_json(span, &reason(error.kind()))
    }

    fn nothing_there<T>(&mut self, len: usize) -> Option<T> {
        self.not_json(self.span(Range { start: 0, end: len }), "there is no value here")
    }

    /// Whether `text` is JSON also for a second, stricter reader: the parser above lets control
    /// characters in strings and uncommon white space pass.
    fn is_json(&mut self, text: &str) -> bool {
        let Err(error) = serde_json::from_str::<serde::de::IgnoredAny>(text) else { return true };
        if error.to_string().starts_with("recursion limit") {
            return true; // `node` reports this with our own limit, which is lower
        }
        let message = error.to_string();
        let at = offset(text, error.line(), error.column());
        let next = text.get(at..).and_then(|rest| rest.chars().next()).map_or(0, char::len_utf8);
        let span = self.span(Range { start: at, end: at + next });
        self.not_json::<()>(span, message.split(" at line ").next().unwrap_or(&message));
        false
    }

    fn not_json<T>(&mut self, span: Span, reason: &str) -> Option<T> {
        self.report
            .error(Finding::new("scene::syntax", format!("not valid JSON: {reason}")).at(span, "here"));
        None
    }
}

/// Byte offset of the character that holds the one-based `column`, in bytes, of `line`.
fn offset(text: &str, line: usize, column: usize) -> usize {
    let before: usize = text.split_inclusive('\n').take(line.saturating_sub(1)).map(str::len).sum();
    let at = (before + column.saturating_sub(1)).min(text.len());
    (0..=at).rev().find(|&i| text.is_char_boundary(i)).unwrap_or(0)
}

/// What is wrong, in words that say what to change.
fn reason(kind: &ParseErrorKind) -> String {
    use ParseErrorKind as K;
    match kind {
        K::MultipleRootJsonValues => "nothing may follow the scene's closing brace".into(),
        K::UnterminatedObject => "this object is never closed".into(),
        K::UnterminatedArray => "this list is never closed".into(),
        K::UnexpectedToken | K::UnexpectedWord => "this is no JSON value".into(),
        K::UnexpectedTokenInObject => "expected a key in quotes, or `}`".into(),
        K::ExpectedColonAfterObjectKey => "expected `:` after the key".into(),
        K::ExpectedComma => "expected `,`".into(),
        K::ExpectedDigitFollowingNegativeSign => "expected a digit after the sign".into(),
        K::ExpectedPlusMinusOrDigitInNumberLiteral => "expected an exponent".into(),
        other => lower_first(&other.to_string()),
    }
}

fn lower_first(text: &str) -> String {
    let mut chars = text.chars();
    chars.next().map_or_else(String::new, |first| first.to_lowercase().chain(chars).collect())
}
