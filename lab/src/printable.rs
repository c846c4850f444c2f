//! Text from outside, such as names of files and lines of scenes, in a form that only shows: it moves no cursor,
//! changes no colour, starts no new line and turns no direction of writing.

/// Whether a character does more than to show.
fn acts(c: char) -> bool {
    let breaks_lines = matches!(c, '\u{2028}' | '\u{2029}');
    let turns =
        matches!(c, '\u{61C}' | '\u{200E}' | '\u{200F}' | '\u{202A}'..='\u{202E}' | '\u{2066}'..='\u{2069}');
    c.is_control() || breaks_lines || turns
}

/// What stands for a character that acts, as wide as a letter, so that a caret below it stays in its place.
fn stand_in(c: char) -> char {
    match c {
        '\0'..='\u{1F}' => char::from_u32(0x2400 + u32::from(c)).unwrap_or(char::REPLACEMENT_CHARACTER),
        '\u{7F}' => '\u{2421}',
        _ => char::REPLACEMENT_CHARACTER,
    }
}

/// Text of several lines for people: control characters but line feeds and tabs become their symbols (`␛`), what
/// else acts becomes `�`.
pub fn lines(text: &str) -> String {
    text.chars().map(|c| if acts(c) && !matches!(c, '\n' | '\t') { stand_in(c) } else { c }).collect()
}

/// As [`lines`], for text within a line: line feeds and tabs become symbols too.
pub fn line(text: &str) -> String {
    text.chars().map(|c| if acts(c) { stand_in(c) } else { c }).collect()
}

/// JSON in which the same characters are escaped. It means the same: they stand only within strings, but for line feeds
/// and tabs, which stand only outside.
pub fn json(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        // All of them fit into one unit of UTF-16.
        if acts(c) && !matches!(c, '\n' | '\t') {
            escaped += &format!("\\u{:04x}", u32::from(c))
        } else {
            escaped.push(c)
        }
    }
    escaped
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_acts_is_shown() {
        assert_eq!(line("a\n\t\r\u{1b}[31m\u{7f}"), "a␊␉␍␛[31m␡");
        assert_eq!(lines("a\n\tb\r\u{9b}"), "a\n\tb␍�");
        assert_eq!(line("\u{2028}\u{202e}é漢\u{200f}"), "��é漢�");
        let value = "\u{9b}\u{7f}\u{2028}\u{1b}";
        let escaped = json(&serde_json::to_string(value).unwrap());
        assert_eq!(escaped, "\"\\u009b\\u007f\\u2028\\u001b\"");
        assert_eq!(serde_json::from_str::<String>(&escaped).unwrap(), value);
        assert_eq!(json("{\n\t\"a\": 1\n}"), "{\n\t\"a\": 1\n}");
    }
}
