//! Every figure in the text of `docs/findings.md` is that of the cell of the table that it names.

use super::{Row, page};

/// A number in a text, with the text before and after it.
struct Number<'a> {
    before: &'a str,
    text: &'a str,
    after: &'a str,
}

/// The numbers in `text`; those that are parts of words are none.
fn numbers(text: &str) -> Vec<Number<'_>> {
    let mut found = Vec::new();
    let mut start = 0;
    while let Some(first) = text[start..].chars().next() {
        let rest = &text[start..];
        let mut end = first.len_utf8();
        if first.is_ascii_digit() {
            let belongs = |(i, c): (usize, char)| {
                c.is_ascii_digit()
                    || (matches!(c, '.' | 'e') && rest[i + 1..].starts_with(|c: char| c.is_ascii_digit()))
                    || (c == 'e' && rest[i + 1..].starts_with('-'))
                    || (c == '-' && rest[..i].ends_with('e'))
            };
            end = rest.char_indices().find(|&found| !belongs(found)).map_or(rest.len(), |(i, _)| i);
            if !text[..start].ends_with(char::is_alphanumeric) {
                found.push(Number { before: &text[..start], text: &rest[..end], after: &rest[end..] });
            }
        }
        start += end;
    }
    found
}

/// `value` with as many digits as `like` has.
fn rounded(value: f64, like: &str) -> String {
    let mantissa = like.split('e').next().unwrap();
    let digits = mantissa.split_once('.').map_or(0, |(_, digits)| digits.len());
    if like.contains('e') { format!("{value:.digits$e}") } else { format!("{value:.digits$}") }
}

/// A cell that a text names, such as `2b`, or a row alone, such as `2`.
#[derive(Clone, Copy)]
struct Cell<'a> {
    row: &'a Row,
    column: Option<char>,
}

impl<'a> Cell<'a> {
    fn parse(text: &str, rows: &'a [Row]) -> Option<Self> {
        let column = text.chars().last().filter(|c| ('a'..='e').contains(c));
        let number = column.map_or(text, |_| &text[..text.len() - 1]);
        Some(Self { row: rows.iter().find(|row| row.number == number)?, column })
    }

    fn value(&self) -> f64 {
        self.column.map_or(f64::NAN, |column| self.row.value(usize::from(column as u8 - b'a')))
    }
}

/// The cells between two brackets, `2b, 24e/2e`: a cell with the one that it is divided by, if there is one.
fn citation<'a>(text: &str, rows: &'a [Row]) -> Option<Vec<(Cell<'a>, Option<Cell<'a>>)>> {
    let part = |part: &str| match part.split_once('/') {
        None => Some((Cell::parse(part, rows)?, None)),
        Some((a, b)) => Some((Cell::parse(a, rows)?, Some(Cell::parse(b, rows)?))),
    };
    text.split(", ").map(part).collect()
}

/// What is wrong with a paragraph. Every number belongs to the next citation. The steps a second, the time
/// and the k/m are those of the rows and columns that it names; the other numbers are its cells, in order. A
/// k/m is that of all rows that follow, up to the next one.
fn wrong(paragraph: &str, rows: &[Row]) -> Vec<String> {
    let mut wrong = Vec::new();
    let mut k_over_m = "";
    let (parts, last) = paragraph.rsplit_once(']').unwrap_or(("", paragraph));
    wrong.extend(numbers(last).iter().map(|number| format!("{} has no citation", number.text)));
    for part in parts.split(']').filter(|part| !part.is_empty()) {
        let (prose, names) = part.split_once('[').unwrap();
        let Some(cited) = citation(names, rows) else {
            wrong.push(format!("[{names}] is not in the table"));
            continue;
        };
        let cells: Vec<Cell<'_>> = cited.iter().flat_map(|(a, b)| [Some(*a), *b]).flatten().collect();
        let mut figures = Vec::new();
        for number in numbers(prose) {
            let fits = |is: &dyn Fn(&Cell<'_>) -> bool| cells.iter().any(is);
            let is_right = if number.before.ends_with("k/m ") {
                k_over_m = number.text;
                true
            } else if number.after.starts_with(" steps/s") {
                fits(&|cell| cell.row.name.ends_with(&format!(" {} steps/s", number.text)))
            } else if number.after.starts_with(" s") && !number.after[2..].starts_with(char::is_alphanumeric)
            {
                let column = match number.text {
                    "0.1" => 'a',
                    "0.5" => 'b',
                    _ => '-',
                };
                fits(&|cell| cell.column == Some(column))
            } else {
                figures.push(number);
                continue;
            };
            if !is_right {
                wrong.push(format!("{} is not that of [{names}]", number.text));
            }
        }
        let values: Vec<f64> = cited
            .iter()
            .filter(|(cell, _)| cell.column.is_some())
            .map(|(a, b)| a.value() / b.map_or(1.0, |b| b.value()))
            .collect();
        if figures.len() != values.len() {
            wrong.push(format!("[{names}] has {} cells for {} numbers", values.len(), figures.len()));
        }
        for (figure, value) in figures.iter().zip(values) {
            let value = if figure.after.starts_with(" %") { 100.0 * value } else { value };
            if rounded(value, figure.text) != figure.text {
                wrong.push(format!("{} is {value} in [{names}]", figure.text));
            }
        }
        let others = cells.iter().filter(|cell| !cell.row.name.contains(k_over_m));
        wrong.extend(others.map(|cell| format!("row {} is not of k/m {k_over_m}", cell.row.number)));
    }
    wrong
}

/// Paragraphs and list items of a section, each on one line, without what stands in code.
fn paragraphs(section: &str) -> Vec<String> {
    let prose: Vec<&str> = section.split("```").step_by(2).collect();
    let prose = prose.join("\n\n").replace("\n- ", "\n\n- ");
    let line = |text: &str| {
        let words: Vec<&str> = text.split_whitespace().collect();
        words.join(" ").split('`').step_by(2).collect::<Vec<_>>().join("")
    };
    prose.split("\n\n").map(line).filter(|line| !line.is_empty()).collect()
}

/// The numbers of the rows that a text names.
pub(super) fn named_rows(text: &str) -> Vec<&str> {
    let brackets = text.split('[').skip(1).filter_map(|rest| rest.split_once(']'));
    let cells = brackets.flat_map(|(inside, _)| inside.split([',', '/', ' ']));
    cells.map(|cell| cell.trim_end_matches(char::is_alphabetic)).filter(|row| !row.is_empty()).collect()
}

#[test]
fn every_figure_in_the_text_is_that_of_the_cell_that_it_names() {
    let (text, rows) = page();
    let mut found = Vec::new();
    for section in text.split("\n## ").skip(1) {
        for paragraph in paragraphs(section) {
            found.extend(wrong(&paragraph, &rows).into_iter().map(|wrong| format!("{wrong}: {paragraph}")));
        }
    }
    assert!(found.is_empty(), "{}", found.join("\n"));
    let sections = text.split_once("\n## ").unwrap().1;
    for row in &rows {
        assert!(named_rows(sections).contains(&row.number.as_str()), "nothing is said of {row:?}");
    }
}

/// The check above finds every kind of wrong number, citation and condition.
#[test]
fn a_wrong_figure_is_found() {
    let (text, rows) = page();
    let first = paragraphs(text.split("\n## ").nth(1).unwrap()).remove(1);
    assert_eq!(wrong(&first, &rows), Vec::<String>::new());
    for (right, other) in [
        ("3.65e-5 m", "3.66e-5 m"),
        ("8.7 times", "8.6 times"),
        ("8.7 times", "6.8 times"),
        ("[24e/2e]", "[2e/24e]"),
        ("[24e/2e]", "[24b/2e]"),
        ("[2b]", "[2a]"),
        ("[2b]", "[4b]"),
        ("[2b]", "[2]"),
        ("[2b]", "[2b, 2e]"),
        ("[2b]", "[99b]"),
        (" [1b]", ""),
        ("600 steps/s", "540 steps/s"),
        ("at 0.5 s", "at 0.1 s"),
        ("at 0.5 s", "at 0.4 s"),
        ("k/m 8.33e4", "k/m 8.33e7"),
    ] {
        assert!(first.contains(right), "{right} in {first}");
        assert_ne!(wrong(&first.replace(right, other), &rows), Vec::<String>::new(), "{other}");
    }
}

#[test]
fn numbers_are_told_from_words() {
    let found = |text| numbers(text).into_iter().map(|number| number.text).collect::<Vec<_>>();
    assert_eq!(
        found("f32 is 7.1e-6 m, 31 times. BDF2: 1e4, 2.9; 8.3e7."),
        ["7.1e-6", "31", "1e4", "2.9", "8.3e7"]
    );
    assert_eq!(
        [rounded(3.656e-5, "3.7e-5"), rounded(30.6, "31"), rounded(0.5, "0.50")],
        ["3.7e-5", "31", "0.50"]
    );
}
