//! JSON text to a tree in which every value knows the place where it stands.

use jsonc_parser::ast::{self, ObjectPropName};
use jsonc_parser::common::{Range, Ranged};
use jsonc_parser::errors::{ParseError, ParseErrorKind};
use jsonc_parser::{CollectOptions, ParseOptions, parse_to_ast};

use super::diagnostic::Diagnostics;
use super::finding::Finding;
use super::node::{Json, Member, Node};
use super::path::{Path, Step};
use super::span::Span;
use super::text::shown;

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

/// Reads the part of a source from byte `start` on as one JSON value.
///
/// Duplicate keys are reported and the first one is kept. Returns nothing, after an error, if the
/// text is not JSON.
pub(crate) fn parse(diagnostics: &mut Diagnostics, source: usize, start: usize) -> Option<Node> {
    let whole = diagnostics.sources.get(source)?.text.clone();
    let text = whole.get(start..).unwrap_or("");
    let mut tree = Tree { diagnostics, source, start };
    match parse_to_ast(text, &CollectOptions::default(), &STRICT) {
        Err(error) => tree.syntax_error(&error, text),
        Ok(parsed) => match (parsed.value, loose_character(text)) {
            (_, Some((range, reason))) => tree.not_json(range, reason),
            (Some(value), None) => tree.node(value, &Path::ROOT),
            (None, None) => tree.not_json(Range::new(0, text.len()), "there is no value here"),
        },
    }
}

/// Builds the tree of one source.
struct Tree<'a> {
    diagnostics: &'a mut Diagnostics,
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
        self.diagnostics.error(finding);
    }

    fn too_deep<T>(&mut self, span: Span) -> Option<T> {
        let label = format!("nested deeper than {MOST_LEVELS} levels");
        self.diagnostics.error(Finding::new("scene::syntax", "nested too deeply").at(span.first(), label));
        None
    }

    fn syntax_error<T>(&mut self, error: &ParseError, text: &str) -> Option<T> {
        match error.kind() {
            ParseErrorKind::NestingDepthExceeded => self.too_deep(self.span(error.range())),
            // A comment as in Python or YAML, of which the parser does not know.
            _ if text.get(error.range().start..).is_some_and(|rest| rest.starts_with('#')) => {
                self.not_json(error.range(), &reason(&ParseErrorKind::CommentsNotAllowed))
            }
            kind => self.not_json(error.range(), &reason(kind)),
        }
    }

    fn not_json<T>(&mut self, range: Range, reason: &str) -> Option<T> {
        let span = self.span(range);
        self.diagnostics
            .error(Finding::new("scene::syntax", format!("not valid JSON: {reason}")).at(span, "here"));
        None
    }
}

/// What the parser lets pass though it is not JSON: control characters in strings, and white space
/// of other kinds than space, tab and line end. `text` has passed the parser.
fn loose_character(text: &str) -> Option<(Range, &'static str)> {
    let (mut in_string, mut escaped) = (false, false);
    for (start, c) in text.char_indices() {
        let range = Range { start, end: start + c.len_utf8() };
        match c {
            '"' if !escaped => in_string = !in_string,
            '\0'..='\x1f' if in_string => return Some((range, "control characters in text must be escaped")),
            ' ' | '\t' | '\n' | '\r' | '!'..='~' => {}
            _ if !in_string => return Some((range, "this character is not allowed here")),
            _ => {}
        }
        escaped = in_string && c == '\\' && !escaped;
    }
    None
}

/// What is wrong, in words that say what to change.
fn reason(kind: &ParseErrorKind) -> String {
    use ParseErrorKind as K;
    match kind {
        K::MultipleRootJsonValues => {
            "nothing may follow: a scene ends with its closing brace, and a list stands in brackets".into()
        }
        K::UnterminatedObject => "this object is never closed".into(),
        K::UnterminatedArray => "this list is never closed".into(),
        K::UnexpectedToken | K::UnexpectedWord => "this is no JSON value".into(),
        K::UnexpectedTokenInObject => "expected a key in quotes, or `}`".into(),
        K::ExpectedColonAfterObjectKey => "expected `:` after the key".into(),
        K::CommentsNotAllowed => {
            "comments are not allowed: a scene is plain JSON, as in the course's viewer".into()
        }
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

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn read(text: &str) -> (Option<Node>, Vec<crate::error::Diagnostic>) {
        let mut diagnostics = Diagnostics::default();
        let source = diagnostics.add_source("x.json", text);
        let node = parse(&mut diagnostics, source, 0);
        (node, diagnostics.finish().err().map(|error| error.diagnostics).unwrap_or_default())
    }

    #[test]
    fn every_value_knows_its_place() {
        let text = r#"{"a": [1, "ü\n", {"b": null}]}"#;
        let (node, errors) = read(text);
        let node = node.unwrap();
        assert_eq!(errors, []);
        let place = |path: &str| {
            let span = node.get(path).unwrap().span;
            &text[span.start..span.end]
        };
        assert_eq!(place("a"), r#"[1, "ü\n", {"b": null}]"#);
        assert_eq!((place("a.0"), place("a.1"), place("a.2.b")), ("1", r#""ü\n""#, "null"));
        assert_eq!(node.get("a.1").unwrap().json, Json::Text("ü\n".into()));
        assert_eq!(node.get("a.3"), None);
    }

    #[test]
    fn the_first_of_two_equal_keys_is_kept() {
        let (node, errors) = read(r#"{"a": {"b": 1, "b": 2, "\u0062": 3}}"#);
        assert_eq!(node.unwrap().get("a.b").unwrap().json, Json::Number(1.0));
        let found: Vec<_> = errors.iter().map(|e| (e.code, e.column, e.key.as_str())).collect();
        assert_eq!(found, [("scene::duplicate_key", 16, "a.b"), ("scene::duplicate_key", 24, "a.b")]);
    }

    /// Pieces of JSON and what is nearly JSON, to be strung together.
    fn pieces() -> impl Strategy<Value = String> {
        let pieces = [
            "{", "}", "[", "]", ",", ":", " ", "\n", "\t", "\u{b}", "\u{a0}", "\u{feff}", "\"a\"", "\"",
            "\\", "\\u", "\\n", "d800", "0041", "1", "0", "-", "+", ".", "e", "E", "5", "true", "null", "x",
            "'", "/", "*", "\0", "\r",
        ];
        prop::collection::vec(prop::sample::select(pieces.to_vec()), 0..9).prop_map(|words| words.concat())
    }

    fn agrees_with_serde_json(text: &str) -> Result<(), TestCaseError> {
        let (node, errors) = read(text);
        let theirs: Result<serde_json::Value, _> = serde_json::from_str(text);
        // Its numbers end where binary64 does; then only its grammar can be compared.
        let theirs = match &theirs {
            Err(e) if e.to_string().starts_with("number out of range") => {
                prop_assume!(!text.contains('\\'));
                serde_json::from_str::<serde::de::IgnoredAny>(text).is_ok()
            }
            theirs => theirs.is_ok(),
        };
        let ours = node.is_some() && errors.iter().all(|e| e.code == "scene::duplicate_key");
        prop_assert_eq!(ours, theirs, "{:?}", text);
        Ok(())
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: 4000, failure_persistence: None, ..ProptestConfig::default() })]

        #[test]
        fn what_is_json_is_decided_as_serde_json_does(text in pieces()) {
            agrees_with_serde_json(&text)?;
            agrees_with_serde_json(&format!("[{text}]"))?;
            agrees_with_serde_json(&format!("{{\"k\": {text}}}"))?;
            agrees_with_serde_json(&format!("\"{text}\""))?;
        }
    }
}
