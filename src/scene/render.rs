//! A finding drawn for people: the line of the file with a caret under the place.

use annotate_snippets::{Annotation, AnnotationKind, Group, Level, Origin, Renderer, Snippet};

use super::report::Finding;
use super::source::{Source, Span};

/// How bad a finding is.
#[derive(Clone, Copy)]
pub(super) enum Severity {
    Error,
    Warning,
}

/// The finding as plain text in the look of rustc, without a line end.
pub(super) fn render(sources: &[Source], finding: &Finding, severity: Severity) -> String {
    let level = match severity {
        Severity::Error => Level::ERROR,
        Severity::Warning => Level::WARNING,
    };
    let mut group = Group::with_title(level.primary_title(&finding.message).id(finding.code));
    match finding.place {
        Some(place) => group = group.elements(snippets(sources, finding, place)),
        None => group = group.elements(sources.first().map(|source| Origin::path(&source.name))),
    }
    if !finding.help.is_empty() {
        group = group.element(Level::HELP.message(&finding.help));
    }
    Renderer::plain().render(&[group])
}

/// One snippet when both places stand in one source, else one for each.
fn snippets<'a>(
    sources: &'a [Source],
    finding: &'a Finding,
    place: Span,
) -> Vec<Snippet<'a, Annotation<'a>>> {
    let primary = (AnnotationKind::Primary, place, finding.label.as_str());
    let also = finding.also.as_ref().map(|(span, label)| (AnnotationKind::Context, *span, label.as_str()));
    match also {
        Some(also) if also.1.source == place.source => {
            snippet(sources, &[primary, also]).into_iter().collect()
        }
        Some(also) => snippet(sources, &[primary]).into_iter().chain(snippet(sources, &[also])).collect(),
        None => snippet(sources, &[primary]).into_iter().collect(),
    }
}

/// The lines that hold `marks`, which all stand in one source.
fn snippet<'a>(
    sources: &'a [Source],
    marks: &[(AnnotationKind, Span, &'a str)],
) -> Option<Snippet<'a, Annotation<'a>>> {
    let source = sources.get(marks.first()?.1.source)?;
    let spans = || marks.iter().map(|mark| on_one_line(source, mark.1));
    let start = spans().map(|span| span.start).min()?;
    let end = spans().map(|span| span.end).max()?;
    let (offset, text) = source.lines_around(start, end);
    let (line, _) = source.line_column(offset);
    let annotations = marks.iter().map(|&(kind, span, label)| {
        let span = on_one_line(source, span);
        kind.span(span.start - offset..span.end - offset).label((!label.is_empty()).then_some(label))
    });
    Some(Snippet::source(text).line_start(line).path(&source.name).annotations(annotations))
}

/// A span that does not run over its first line's end.
fn on_one_line(source: &Source, span: Span) -> Span {
    Span { end: span.start + source.first_line(span).len(), ..span }
}
