//! The texts that a scene is made from (its file, patches, overrides), and places in them.

use std::rc::Rc;

/// A stretch of one source: byte offsets `start..end` of the text with number `source`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Span {
    pub(crate) source: usize,
    pub(crate) start: usize,
    pub(crate) end: usize,
}

impl Span {
    /// The place of what stands in no text.
    pub(crate) const NOWHERE: Self = Self { source: 0, start: 0, end: 0 };

    /// The first byte alone: where a long object or list starts.
    pub(crate) fn first(self) -> Self {
        Self { end: self.end.min(self.start + 1), ..self }
    }
}

/// One text with the name that errors give it.
#[derive(Debug)]
pub(crate) struct Source {
    pub(crate) name: String,
    pub(crate) text: Rc<str>,
}

impl Source {
    /// One-based line, and one-based column in characters, of the byte offset `at`.
    pub(crate) fn line_column(&self, at: usize) -> (usize, usize) {
        let before = self.text.get(..at).unwrap_or(&self.text);
        let line = before.matches('\n').count() + 1;
        let column = before.chars().rev().take_while(|&c| c != '\n').count() + 1;
        (line, column)
    }

    /// The whole lines that hold `start..end`, without the last line's end but where the span reaches into it: their
    /// offset and text.
    pub(crate) fn lines_around(&self, start: usize, end: usize) -> (usize, &str) {
        let from = self.text.get(..start).and_then(|t| t.rfind('\n')).map_or(0, |i| i + 1);
        let rest = self.text.get(end..).unwrap_or("");
        let to = end + rest.find('\n').unwrap_or(rest.len());
        let text = self.text.get(from..to).unwrap_or("");
        let length = text.trim_end_matches('\r').len().max(end - from);
        (from, text.get(..length).unwrap_or(text))
    }

    /// The text of a span, cut off where its first line ends.
    pub(crate) fn first_line(&self, span: Span) -> &str {
        let text = self.text.get(span.start..span.end).unwrap_or("");
        text.split(['\n', '\r']).next().unwrap_or(text)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_count_characters_not_bytes() {
        let source = Source { name: String::new(), text: "{\n  \"größe\": 1}".into() };
        assert_eq!(source.line_column(0), (1, 1));
        assert_eq!(source.line_column(2), (2, 1));
        let one = source.text.find('1').unwrap();
        assert_eq!(source.line_column(one), (2, 12));
        assert_eq!(source.line_column(source.text.len()), (2, 14));
    }

    #[test]
    fn lines_around_a_span_are_whole_lines() {
        let source = Source { name: String::new(), text: "ab\r\ncd\r\nef".into() };
        assert_eq!(source.lines_around(4, 5), (4, "cd"));
        assert_eq!(source.lines_around(1, 5), (0, "ab\r\ncd"));
        assert_eq!(source.lines_around(10, 10), (8, "ef"));
        let source = Source { name: String::new(), text: "{\r\r\r".into() };
        assert_eq!(source.lines_around(0, 1), (0, "{"));
        assert_eq!(source.lines_around(4, 4), (0, "{\r\r\r"), "an error at the end of the file stands there");
    }
}
