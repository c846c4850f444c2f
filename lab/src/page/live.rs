//! Links to moments on the live page (`web/README.md` has their parts).

use std::fmt::Write;

use super::escape;

/// A live page at an address, and what all links to it have in common.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Live {
    start: String,
}

impl Live {
    /// The live page at `url`.
    pub fn at(url: &str) -> Self {
        let page = url.split('#').next().unwrap_or_default();
        Self { start: format!("{page}#paused") }
    }

    /// The same, with further parts in every link: each a name and a value.
    #[must_use]
    pub fn with<'a>(&self, parts: impl IntoIterator<Item = (&'a str, &'a str)>) -> Self {
        let mut start = self.start.clone();
        for (name, value) in parts {
            start += &format!("&{name}");
            if !value.is_empty() {
                start += &format!("={}", encoded(value));
            }
        }
        Self { start }
    }

    /// A link in HTML, with `text` (HTML already) to click on.
    pub fn link(&self, text: &str) -> String {
        format!("<a href=\"{}\">{text}</a>", escape(&self.start))
    }
}

/// A value as a part of an address.
fn encoded(value: &str) -> String {
    value.bytes().fold(String::new(), |mut text, byte| {
        if byte.is_ascii_alphanumeric() || b"-_.~=,/:".contains(&byte) {
            text.push(char::from(byte));
        } else {
            // Writing to a string cannot fail.
            let _ = write!(text, "%{byte:02X}");
        }
        text
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_link_has_its_parts_and_nothing_that_ends_them() {
        let live = Live::at("https://example.org/live.html#scene=plane").with([("scene", "sphere")]);
        let parts = [("set", "light.color=[1,0,0]"), ("text", "a&b \"é"), ("allow-unstable", "")];
        assert_eq!(
            live.with(parts).link("see"),
            "<a href=\"https://example.org/live.html#paused&amp;scene=sphere&amp;set=light.color=%5B1,0,0%5D&amp;\
             text=a%26b%20%22%C3%A9&amp;allow-unstable\">see</a>"
        );
    }
}
