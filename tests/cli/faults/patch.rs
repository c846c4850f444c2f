//! Finds an expression in a function, constant or GLSL file by their names, wherever they stand, so
//! that moving code costs nothing. Layout does not matter either: tokens are compared, not characters.

use std::fs;
use std::ops::Range;
use std::path::{Path, PathBuf};

/// The folders that are searched.
const FOLDERS: [&str; 4] = ["src", "lab/src", "cli/src", "tests/engine/support"];

/// What begins an item.
const KEYWORDS: [&str; 3] = ["fn", "const", "static"];

/// The one place of an expression in the sources.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Place {
    /// The file, from the top of the repository.
    pub(super) file: PathBuf,
    /// Where the expression stands in its text.
    range: Range<usize>,
}

impl Place {
    /// The text of the file with `new` in this place.
    pub(super) fn replaced(&self, text: &str, new: &str) -> String {
        [&text[..self.range.start], new, &text[self.range.end..]].concat()
    }
}

/// The place of the expression `old` in an item or GLSL file called `item`, of the repository at `top`.
///
/// # Errors
/// Says what was found when that is not exactly one place.
pub(super) fn find(top: &Path, item: &str, old: &str) -> Result<Place, String> {
    let mut places = Vec::new();
    for file in FOLDERS.iter().flat_map(|folder| sources(&top.join(folder))) {
        let text = fs::read_to_string(&file).unwrap();
        let bodies =
            if file.ends_with(item) { std::iter::once(0..text.len()).collect() } else { items(&text, item) };
        let found = bodies.into_iter().flat_map(|body| occurrences(&text, body, old));
        let file = file.strip_prefix(top).unwrap();
        places.extend(found.map(|range| Place { file: file.to_owned(), range }));
    }
    match &places[..] {
        [place] => Ok(place.clone()),
        _ => Err(format!("{} places in items called `{item}`: {old}\n{places:#?}", places.len())),
    }
}

/// Every Rust and GLSL file in a folder, in the order of their names.
fn sources(folder: &Path) -> Vec<PathBuf> {
    let mut entries: Vec<PathBuf> =
        fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    entries.sort();
    let inside = entries.into_iter().flat_map(|path| if path.is_dir() { sources(&path) } else { vec![path] });
    inside.filter(|path| path.extension().is_some_and(|e| e == "rs" || e == "frag" || e == "vert")).collect()
}

/// Where the items called `name` stand: each from its first line to the one that ends it, which is
/// the next at the same depth to end in a brace or semicolon.
fn items(text: &str, name: &str) -> Vec<Range<usize>> {
    let (mut found, mut start) = (Vec::new(), 0);
    for line in text.split_inclusive('\n') {
        // Most lines do not hold the name, and to take all of them apart for each fault takes half a minute.
        let words = if line.contains(name) { tokens(line) } else { Vec::new() };
        let begins = words.windows(2).any(|pair| KEYWORDS.contains(&pair[0].text) && pair[1].text == name);
        if begins {
            let lines = text[start..].split_inclusive('\n');
            let before = lines.take_while(|next| !ends_item(next, depth(line))).map(str::len).sum::<usize>();
            let last = text[start + before..].split_inclusive('\n').next().map_or(0, str::len);
            found.push(start..start + before + last);
        }
        start += line.len();
    }
    found
}

fn depth(line: &str) -> usize {
    line.len() - line.trim_start().len()
}

fn ends_item(line: &str, at: usize) -> bool {
    depth(line) == at && line.trim_end().ends_with([';', '}'])
}

/// Where the tokens of `old` stand in the part `body` of a text.
fn occurrences(text: &str, body: Range<usize>, old: &str) -> Vec<Range<usize>> {
    let (inside, old) = (tokens(&text[body.clone()]), tokens(old));
    let alike = |part: &&[Token<'_>]| part.iter().zip(&old).all(|(a, b)| a.text == b.text);
    let place = |part: &[Token<'_>]| {
        let (first, last) = (&part[0], &part[part.len() - 1]);
        body.start + first.start..body.start + last.start + last.text.len()
    };
    inside.windows(old.len()).filter(alike).map(place).collect()
}

/// A word, a text in quotes or any other character but white space.
struct Token<'a> {
    start: usize,
    text: &'a str,
}

/// The tokens of a text, without the commas before closing brackets.
fn tokens(text: &str) -> Vec<Token<'_>> {
    let mut tokens: Vec<Token<'_>> = Vec::new();
    let mut start = 0;
    while let Some(c) = text[start..].chars().next() {
        let word = |c: char| c.is_alphanumeric() || c == '_';
        let length = match c {
            '"' => text[start + 1..].find('"').map_or(1, |end| end + 2),
            c if word(c) => text[start..].find(|c| !word(c)).unwrap_or(text.len() - start),
            c => c.len_utf8(),
        };
        if [')', ']', '}'].contains(&c) && tokens.last().is_some_and(|last| last.text == ",") {
            tokens.pop();
        }
        if !c.is_whitespace() {
            tokens.push(Token { start, text: &text[start..start + length] });
        }
        start += length;
    }
    tokens
}

#[test]
fn an_expression_is_found_in_its_item_whatever_the_layout() {
    let text =
        "fn a() {\n    f(1, 2);\n}\n\nfn b() {\n    f(\n        1,\n        2,\n    );\n    g(\"1 ,\");\n}\n";
    assert_eq!(items(text, "b").len(), 1);
    assert!(items(text, "f").is_empty(), "a call is no item");
    let places = |item: &str, old: &str| -> Vec<Range<usize>> {
        items(text, item).into_iter().flat_map(|body| occurrences(text, body, old)).collect()
    };
    for item in ["a", "b"] {
        assert_eq!(places(item, "f(1, 2)").len(), 1, "{item}");
    }
    assert_eq!(places("a", "f(2, 1)").len() + places("a", "g(\"1 ,\")").len() + places("c", "1").len(), 0);
    let place = Place { file: PathBuf::new(), range: places("b", "f(1, 2)").remove(0) };
    assert_eq!(
        place.replaced(text, "h()").split("fn b").nth(1),
        Some("() {\n    h();\n    g(\"1 ,\");\n}\n")
    );
}
