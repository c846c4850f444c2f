//! What is wrong in the texts that are read: collected, so that all errors are reported at once.

use std::rc::Rc;

use super::finding::Finding;
use super::snippet::{self, Severity};
use super::span::{Source, Span};
use super::text::quoted;
use crate::error::{Diagnostic, Error};

/// Reading stops after this many errors.
const MOST_ERRORS: usize = 100;

/// The number of a source and a byte in it; what has no place comes last.
type Place = (usize, usize);

/// The texts that are read and everything found in them.
#[derive(Default)]
pub(crate) struct Diagnostics {
    /// What the document is, in messages: "the sweep"; a scene if it is empty.
    document: &'static str,
    pub(crate) sources: Vec<Source>,
    errors: Vec<(Place, Diagnostic)>,
    warnings: Vec<Diagnostic>,
}

impl Diagnostics {
    /// For a document that messages call `document`.
    pub(crate) fn of(document: &'static str) -> Self {
        Self { document, ..Self::default() }
    }

    /// Takes in a text; returns its number.
    pub(crate) fn add_source(&mut self, name: impl Into<String>, text: impl Into<Rc<str>>) -> usize {
        self.sources.push(Source { name: name.into(), text: text.into() });
        self.sources.len() - 1
    }

    /// A dotted path in quotes; the empty one is the whole document.
    pub(crate) fn quoted(&self, path: &str) -> String {
        if path.is_empty() && !self.document.is_empty() { self.document.into() } else { quoted(path) }
    }

    /// The text of a span on one line.
    pub(crate) fn text(&self, span: Span) -> String {
        let text = self.sources.get(span.source).and_then(|source| source.text.get(span.start..span.end));
        text.unwrap_or("").split_whitespace().collect::<Vec<_>>().join(" ")
    }

    /// Records an error: the text is refused.
    pub(crate) fn error(&mut self, finding: Finding) {
        if self.is_full() {
            return;
        }
        self.push(&finding);
        if self.is_full() {
            self.push(&Finding::new("scene::more", format!("stopped after {MOST_ERRORS} errors")));
        }
    }

    fn push(&mut self, finding: &Finding) {
        let place = finding.place.map_or((usize::MAX, 0), |span| (span.source, span.start));
        let diagnostic = self.diagnostic(finding, Severity::Error);
        self.errors.push((place, diagnostic));
    }

    /// Whether there are so many errors that looking for more makes no sense.
    pub(crate) fn is_full(&self) -> bool {
        self.errors.len() >= MOST_ERRORS
    }

    /// Records something doubtful that is allowed.
    pub(crate) fn warn(&mut self, finding: Finding) {
        let diagnostic = self.diagnostic(&finding, Severity::Warning);
        self.warnings.push(diagnostic);
    }

    /// Whether nothing is wrong at `key` itself or inside it.
    pub(crate) fn clean(&self, key: &str) -> bool {
        let inside = |found: &str| {
            found.strip_prefix(key).is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
        };
        !self.errors.iter().any(|(_, e)| inside(&e.key))
    }

    /// The warnings if there was no error, else all errors as one, in the order of their places.
    pub(crate) fn finish(mut self) -> Result<Vec<Diagnostic>, Error> {
        if self.errors.is_empty() {
            return Ok(self.warnings);
        }
        self.errors.sort_by_key(|(place, _)| *place);
        Err(Error::scene(self.errors.into_iter().map(|(_, error)| error).collect()))
    }

    fn diagnostic(&self, finding: &Finding, severity: Severity) -> Diagnostic {
        let source = finding.place.and_then(|span| Some((self.sources.get(span.source)?, span)));
        let (line, column) = source.map_or((0, 0), |(source, span)| source.line_column(span.start));
        let file = source.map(|(source, _)| source).or(self.sources.first());
        Diagnostic {
            code: finding.code,
            message: finding.message.clone(),
            file: file.map_or_else(String::new, |source| source.name.clone()),
            line,
            column,
            key: finding.key.clone(),
            help: finding.help.clone(),
            rendered: snippet::draw(&self.sources, finding, severity),
        }
    }
}
