//! What is found wrong while a scene is read: collected, so that all errors come at once.

use std::rc::Rc;

use super::render;
use super::schema::Key;
use super::source::{Source, Span};
use crate::error::{Diagnostic, Error};

/// Reading stops after this many errors.
const MOST_ERRORS: usize = 100;

/// One thing found, before it is turned into a [`Diagnostic`].
pub(super) struct Finding {
    pub(super) code: &'static str,
    pub(super) message: String,
    pub(super) key: String,
    pub(super) place: Option<Span>,
    pub(super) label: String,
    pub(super) also: Option<(Span, String)>,
    pub(super) help: String,
}

impl Finding {
    /// A finding that says `message`, at no place yet.
    pub(super) fn new(code: &'static str, message: impl Into<String>) -> Self {
        Self {
            code,
            message: message.into(),
            key: String::new(),
            place: None,
            label: String::new(),
            also: None,
            help: String::new(),
        }
    }

    /// Points at `place`, with `label` beside the caret.
    pub(super) fn at(mut self, place: Span, label: impl Into<String>) -> Self {
        self.place = Some(place);
        self.label = label.into();
        self
    }

    /// Names the dotted key that is wrong.
    pub(super) fn key(mut self, key: impl Into<String>) -> Self {
        self.key = key.into();
        self
    }

    /// Points at a second place that explains the first.
    pub(super) fn also(mut self, place: Option<Span>, label: impl Into<String>) -> Self {
        self.also = place.map(|place| (place, label.into()));
        self
    }

    /// Says what to try.
    pub(super) fn help(mut self, help: impl Into<String>) -> Self {
        self.help = help.into();
        self
    }
}

/// The number of a source and a byte in it; what has no place comes last.
type Place = (usize, usize);

/// The sources of a scene and everything found in them.
#[derive(Default)]
pub(super) struct Report {
    pub(super) sources: Vec<Source>,
    errors: Vec<(Place, Diagnostic)>,
    warnings: Vec<Diagnostic>,
    /// Every key that the reader knows, if they are asked for instead of a scene.
    pub(super) keys: Option<Vec<Key>>,
}

impl Report {
    /// Takes in a text; returns its number.
    pub(super) fn add_source(&mut self, name: impl Into<String>, text: impl Into<Rc<str>>) -> usize {
        self.sources.push(Source { name: name.into(), text: text.into() });
        self.sources.len() - 1
    }

    /// The text of a span on one line.
    pub(super) fn text(&self, span: Span) -> String {
        let text = self.sources.get(span.source).and_then(|source| source.text.get(span.start..span.end));
        text.unwrap_or("").split_whitespace().collect::<Vec<_>>().join(" ")
    }

    /// Records an error: no scene will come of this text.
    pub(super) fn error(&mut self, finding: Finding) {
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
        let diagnostic = self.diagnostic(finding, render::Severity::Error);
        self.errors.push((place, diagnostic));
    }

    /// Whether there are so many errors that looking for more makes no sense.
    pub(super) fn is_full(&self) -> bool {
        self.errors.len() >= MOST_ERRORS
    }

    /// Records something doubtful that is allowed.
    pub(super) fn warn(&mut self, finding: Finding) {
        let diagnostic = self.diagnostic(&finding, render::Severity::Warning);
        self.warnings.push(diagnostic);
    }

    /// Whether nothing is wrong at `key` itself or inside it.
    pub(super) fn clean(&self, key: &str) -> bool {
        let inside = |found: &str| {
            found.strip_prefix(key).is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
        };
        !self.errors.iter().any(|(_, e)| inside(&e.key))
    }

    /// The warnings if there was no error, else all errors as one, in the order of their places.
    pub(super) fn finish(mut self) -> Result<Vec<Diagnostic>, Error> {
        if self.errors.is_empty() {
            return Ok(self.warnings);
        }
        self.errors.sort_by_key(|(place, _)| *place);
        Err(Error::scene(self.errors.into_iter().map(|(_, error)| error).collect()))
    }

    fn diagnostic(&self, finding: &Finding, severity: render::Severity) -> Diagnostic {
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
            rendered: render::render(&self.sources, finding, severity),
        }
    }
}
