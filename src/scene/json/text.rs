//! Wording that the messages share.

/// `text` fit for a message: characters that do not print escaped, long text cut.
pub(crate) fn shown(text: &str) -> String {
    const MOST: usize = 60;
    let mut cut = String::new();
    for c in text.chars().take(MOST) {
        match c {
            '"' | '\'' | '\\' => cut.push(c),
            _ => cut.extend(c.escape_debug()),
        }
    }
    if text.chars().nth(MOST).is_some() { cut + "..." } else { cut }
}

/// The dotted path of the key `name` in the object at `path`.
pub(crate) fn join(path: &str, name: &str) -> String {
    if path.is_empty() { name.into() } else { format!("{path}.{name}") }
}

/// A dotted path in quotes; the empty one is the whole scene.
pub(crate) fn quoted(path: &str) -> String {
    if path.is_empty() { "the scene".into() } else { format!("`{path}`") }
}

/// The names as a choice: `a, b or c`.
pub(crate) fn alternatives(names: impl Iterator<Item = String>) -> String {
    enumerated(&names.collect::<Vec<_>>(), "or")
}

/// The names with a word before the last: `a, b and c`.
pub(crate) fn enumerated(names: &[String], word: &str) -> String {
    match names {
        [first @ .., last] if !first.is_empty() => format!("{} {word} {last}", first.join(", ")),
        all => all.concat(),
    }
}

/// The first paragraph of the lines of a documentation comment.
pub(crate) fn paragraph(lines: &[&str]) -> String {
    let lines = lines.iter().map(|line| line.trim());
    lines.take_while(|line| !line.is_empty()).collect::<Vec<_>>().join(" ")
}
