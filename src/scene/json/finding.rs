//! One thing that is wrong in a text, before it is drawn for people.

use super::span::Span;

/// One thing found, before it is turned into a [`Diagnostic`].
pub(crate) struct Finding {
    pub(crate) code: &'static str,
    pub(crate) message: String,
    pub(crate) key: String,
    pub(crate) place: Option<Span>,
    pub(crate) label: String,
    pub(crate) also: Option<(Span, String)>,
    pub(crate) help: String,
}

impl Finding {
    /// A finding that says `message`, at no place yet.
    pub(crate) fn new(code: &'static str, message: impl Into<String>) -> Self {
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
    pub(crate) fn at(mut self, place: Span, label: impl Into<String>) -> Self {
        self.place = Some(place);
        self.label = label.into();
        self
    }

    /// Names the dotted key that is wrong.
    pub(crate) fn key(mut self, key: impl Into<String>) -> Self {
        self.key = key.into();
        self
    }

    /// Points at a second place that explains the first.
    pub(crate) fn also(mut self, place: Option<Span>, label: impl Into<String>) -> Self {
        self.also = place.map(|place| (place, label.into()));
        self
    }

    /// Says what to try.
    pub(crate) fn help(mut self, help: impl Into<String>) -> Self {
        self.help = help.into();
        self
    }
}
