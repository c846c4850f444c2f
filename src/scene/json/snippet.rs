//! A finding drawn for people: the line of the file with a caret under the place.

use std::borrow::Cow;

use annotate_snippets::{Annotation, AnnotationKind, Group, Level, Origin, Renderer, Snippet};

use super::finding::Finding;
use super::span::{Source, Span};

/// Longer pieces of a source are not shown, only named.
const MOST_SHOWN: usize = 8192;

/// How bad a finding is.
#[derive(Clone, Copy)]
pub(crate) enum Severity {
    Error,
    Warning,
}

/// The finding as plain text in the look of rustc, without a line end.
pub(crate) fn draw(sources: &[Source], finding: &Finding, severity: Severity) -> String {
    let level = match severity {
        Severity::Error => Level::ERROR,
        Severity::Warning => Level::WARNING,
    };
    let mut group = Group::with_title(level.primary_title(&finding.message).id(finding.code));
    let snippets = finding.place.map_or_else(Vec::new, |place| snippets(sources, finding, place));
    if snippets.is_empty() {
        group = group.elements(origin(sources, finding.place));
    }
    group = group.elements(snippets);
    if !finding.help.is_empty() {
        group = group.element(Level::HELP.message(&finding.help));
    }
    Renderer::plain().render(&[group])
}

/// What stands at one place, and the words beside it.
type Mark<'a> = (AnnotationKind, Span, &'a str);

/// One snippet when both places stand close together, else one for each.
fn snippets<'a>(
    sources: &'a [Source],
    finding: &'a Finding,
    place: Span,
) -> Vec<Snippet<'a, Annotation<'a>>> {
    let primary: Mark = (AnnotationKind::Primary, place, &finding.label);
    let also = finding.also.as_ref().map(|(span, label)| (AnnotationKind::Context, *span, label.as_str()));
    let near = also.filter(|also| also.1.source == place.source);
    match near.and_then(|also| snippet(sources, &[primary, also])) {
        Some(both) => vec![both],
        None => [primary].into_iter().chain(also).filter_map(|mark| snippet(sources, &[mark])).collect(),
    }
}

/// The lines that hold `marks`, which all stand in one source; none if that is too much.
fn snippet<'a>(sources: &'a [Source], marks: &[Mark<'a>]) -> Option<Snippet<'a, Annotation<'a>>> {
    let source = sources.get(marks.first()?.1.source)?;
    let spans = || marks.iter().map(|mark| on_one_line(source, mark.1));
    let start = spans().map(|span| span.start).min()?;
    let end = spans().map(|span| span.end).max()?;
    let (offset, text) = source.lines_around(start, end);
    if text.len() > MOST_SHOWN {
        return None;
    }
    let (line, _) = source.line_column(offset);
    let annotations = marks.iter().map(|&(kind, span, label)| {
        let span = on_one_line(source, span);
        kind.span(span.start - offset..span.end - offset).label((!label.is_empty()).then_some(label))
    });
    Some(Snippet::source(text).line_start(line).path(shown(&source.name)).annotations(annotations))
}

/// The place by name alone.
fn origin(sources: &[Source], place: Option<Span>) -> Option<Origin<'_>> {
    let Some(place) = place else { return sources.first().map(|source| Origin::path(shown(&source.name))) };
    let source = sources.get(place.source)?;
    let (line, column) = source.line_column(place.start);
    Some(Origin::path(shown(&source.name)).line(line).char_column(column))
}

/// A name on one line, whatever is in it.
fn shown(name: &str) -> Cow<'_, str> {
    if name.contains('\n') { name.replace('\n', "\u{240A}").into() } else { name.into() }
}

/// A span that does not run over its first line's end.
fn on_one_line(source: &Source, span: Span) -> Span {
    Span { end: span.start + source.first_line(span).len(), ..span }
}
