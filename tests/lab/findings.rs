//! `docs/findings.md`: its table is what the program computes, and its text says what the table has.

#![expect(clippy::unwrap_used, reason = "a test may panic")]

use drape::scene::Overrides;
use drape::texture_source::TextureSource;
use drape_lab::store::Store;
use drape_lab::study::extent::Extent;
use drape_lab::study::reference::Difference;
use drape_lab::study::runs::Measured;
use drape_lab::study::source::Source;
use drape_lab::study::{self, PanelStudy};

/// A row of the table: its number, then the cells as they stand there.
#[derive(Debug)]
struct Row {
    number: String,
    /// As `--only` takes it.
    name: String,
    /// Errors at 0.1 s and 0.5 s, drift, stretch, springs.
    cells: Vec<String>,
}

/// The parts of the table that the whole study has: of the stock cloth's mass.
const PARTS: [(&str, f64); 3] = [("8.33e4", 1.0), ("8.33e7", 1e-3), ("8.33e9", 1e-5)];

/// The page before its table, and the table.
fn page() -> (String, Vec<Row>) {
    let page = std::fs::read_to_string(crate::repository::path("docs/findings.md")).unwrap();
    let (text, table) = page.split_once("## The rows").unwrap();
    let rows = table.lines().filter(|line| line.starts_with("| ") && !line.starts_with("| row"));
    let row = |line: &str| {
        let cells: Vec<String> = line.trim_matches(['|', ' ']).split(" | ").map(str::to_owned).collect();
        Row { number: cells[0].clone(), name: cells[1].clone(), cells: cells[2..].to_vec() }
    };
    (text.to_owned(), rows.map(row).collect())
}

impl Row {
    /// The number in a cell; none where the study has none.
    fn value(&self, cell: usize) -> f64 {
        self.cells[cell].parse().unwrap_or(f64::NAN)
    }

    /// Every number that the text may take from the row.
    fn values(&self) -> Vec<f64> {
        let cells = (0..self.cells.len()).flat_map(|cell| [self.value(cell), 100.0 * self.value(cell)]);
        let named = numbers(&self.name).into_iter().map(|(number, _)| number.parse::<f64>().unwrap());
        cells.map(f64::abs).chain(named).collect()
    }
}

/// The rows called `names` as the program computes them.
fn computed(part: f64, names: Vec<String>) -> Vec<(String, Vec<String>)> {
    let folder = tempfile::tempdir().unwrap();
    let store = Store::new(folder.path(), crate::write).unwrap();
    let source =
        Source { path: crate::repository::path("scenes/pinned2.json"), overrides: Overrides::default() };
    let extent = Extent { densities: vec![part], only: names, repeats: 1, ..Extent::full() };
    let study = study::run(&source, &TextureSource::BuiltIn, &extent, &store, &|_| Ok(())).unwrap();
    study.panels.iter().flat_map(rows_of).collect()
}

/// What the page would have of `panel`, with a row for its reference.
fn rows_of(panel: &PanelStudy) -> Vec<(String, Vec<String>)> {
    let errors = |errors: &[Difference]| {
        [0, 2].map(|moment| errors.get(moment).map_or("–".to_owned(), |error| format!("{:.2e}", error.rms)))
    };
    let k_over_m = format!("k/m {:.2e}", panel.panel.k_over_m);
    let cell = |(i, cell): (usize, &Measured)| {
        let mut cells = errors(&cell.errors).to_vec();
        cells.push(cell.drift.map_or("–".to_owned(), |drift| format!("{drift:.2e}")));
        cells.push(format!("{:.3}", cell.stretch));
        cells.push(format!("{:.2e}", cell.springs));
        (format!("{k_over_m}: {}", panel.name(i)), cells)
    };
    let [coarse, fine] = panel.reference.rates;
    let mut floor = errors(&panel.reference.floor).to_vec();
    floor.resize(5, "–".to_owned());
    let reference = (format!("{k_over_m}: reference, {coarse} against {fine} steps/s"), floor);
    panel.cells.iter().enumerate().map(cell).chain([reference]).collect()
}

/// Holds the rows of one part of the table that `wanted` picks against the program.
fn check(k_over_m: &str, part: f64, wanted: impl Fn(&Row) -> bool) -> usize {
    let (_, rows) = page();
    let rows: Vec<Row> = rows.into_iter().filter(|row| row.name.contains(k_over_m) && wanted(row)).collect();
    let computed = computed(part, rows.iter().map(|row| row.name.clone()).collect());
    let line = |name: &str, cells: &[String]| format!("{name} | {}", cells.join(" | "));
    let says: Vec<String> = computed.iter().map(|(name, cells)| line(name, cells)).collect();
    let wrong: Vec<String> =
        rows.iter().map(|row| line(&row.name, &row.cells)).filter(|row| !says.contains(row)).collect();
    assert!(wrong.is_empty(), "the page says\n{}\nthe program\n{}", wrong.join("\n"), says.join("\n"));
    rows.len()
}

#[test]
fn cheap_rows_are_what_the_program_computes() {
    let [(k_over_m, part), ..] = PARTS;
    let checked = check(k_over_m, part, |row| row.value(4) < 8e7 || row.name.contains("reference"));
    assert!(checked > 12, "{checked} rows");
}

#[test]
#[ignore = "the implicit methods and short steps of stiff cloths take minutes"]
fn every_row_is_what_the_program_computes() {
    let checked: usize = PARTS.iter().map(|(k_over_m, part)| check(k_over_m, *part, |_| true)).sum();
    assert_eq!(checked, page().1.len());
}

/// The numbers in `text`, each with what follows it; those that are parts of words are none.
fn numbers(text: &str) -> Vec<(String, &str)> {
    let mut found = Vec::new();
    let mut before = ' ';
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let mut end = first.len_utf8();
        if first.is_ascii_digit() {
            let belongs = |(i, c): (usize, char)| {
                c.is_ascii_digit()
                    || (matches!(c, '.' | 'e') && rest[i + 1..].starts_with(|c: char| c.is_ascii_digit()))
                    || (c == 'e' && rest[i + 1..].starts_with('-'))
                    || (c == '-' && rest[..i].ends_with('e'))
            };
            end = rest.char_indices().find(|&found| !belongs(found)).map_or(rest.len(), |(i, _)| i);
            if !before.is_alphanumeric() {
                found.push((rest[..end].to_owned(), &rest[end..]));
            }
        }
        before = rest[..end].chars().last().unwrap();
        rest = &rest[end..];
    }
    found
}

/// `value` with as many digits as `like` has.
fn rounded(value: f64, like: &str) -> String {
    let mantissa = like.split('e').next().unwrap();
    let digits = mantissa.split_once('.').map_or(0, |(_, digits)| digits.len());
    if like.contains('e') { format!("{value:.digits$e}") } else { format!("{value:.digits$}") }
}

/// Whether `rows` have a number that rounds to `number`: one of theirs, or before `times` how many times
/// as much one has as another.
fn is_from(rows: &[&Row], number: &str, after: &str) -> bool {
    let unit = after.split(|c: char| !c.is_alphanumeric()).nth(1);
    if after.starts_with(' ') && unit == Some("s") {
        return ["0.1", "0.5"].contains(&number);
    }
    let ratios = || {
        let pairs = rows.iter().flat_map(|a| rows.iter().map(move |b| (a, b)));
        pairs.flat_map(|(a, b)| (0..5).map(move |cell| a.value(cell) / b.value(cell)))
    };
    let own = rows.iter().flat_map(|row| row.values());
    let values: Vec<f64> =
        if after.starts_with(" times") { own.chain(ratios()).collect() } else { own.collect() };
    values.iter().any(|value| rounded(*value, number) == number)
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

/// The numbers of the rows that a paragraph names: `[3, 4]`.
fn named_rows(paragraph: &str) -> Vec<&str> {
    let brackets = paragraph.split('[').skip(1).filter_map(|rest| rest.split_once(']'));
    brackets.flat_map(|(inside, _)| inside.split(", ")).collect()
}

#[test]
fn every_figure_in_the_text_is_that_of_a_row_that_it_names() {
    let (text, rows) = page();
    let mut named = Vec::new();
    for section in text.split("\n## ").skip(1) {
        for paragraph in paragraphs(section) {
            let numbers_of_rows = named_rows(&paragraph);
            let of = |number: &&str| rows.iter().find(|row| row.number == *number).expect("the row is there");
            let cited: Vec<&Row> = numbers_of_rows.iter().map(of).collect();
            let prose: String = paragraph.split('[').map(|part| part.rsplit(']').next().unwrap()).collect();
            for (number, after) in numbers(&prose) {
                assert!(is_from(&cited, &number, after), "{number} is in no row that is named: {paragraph}");
            }
            named.extend(cited.iter().map(|row| row.number.clone()));
        }
    }
    for row in &rows {
        assert!(named.contains(&row.number), "nothing is said of {row:?}");
    }
}

/// The command of a section makes the rows that it names.
#[test]
fn commands_make_the_rows_of_their_section() {
    let (text, rows) = page();
    let mut commands = 0;
    for section in text.split("\n## ").skip(1) {
        let Some(command) = section.lines().find(|line| line.starts_with("drape study ")) else { continue };
        commands += 1;
        assert!(crate::repository::path(command.split(' ').nth(2).unwrap()).exists(), "{command}");
        let only: Vec<&str> =
            command.split("--only \"").skip(1).map(|rest| rest.split_once('"').unwrap().0).collect();
        for number in named_rows(section) {
            let name = &rows.iter().find(|row| row.number == number).unwrap().name;
            let reference = name.split_once(": reference").map(|(panel, _)| panel);
            // Any run of a panel makes its reference.
            let of_panel =
                |part: &str| reference.is_some_and(|panel| !part.contains("k/m") || part.contains(panel));
            let is_made = only.iter().any(|part| name.contains(part) || of_panel(part));
            assert!(is_made, "{command} does not make {name}");
        }
    }
    assert!(commands >= 4, "{commands} commands");
}

#[test]
fn numbers_are_told_from_words() {
    let found = |text| numbers(text).into_iter().map(|(number, _)| number).collect::<Vec<_>>();
    assert_eq!(
        found("f32 is 7.1e-6 m, 31 times. BDF2: 1e4, 2.9; 8.3e7."),
        ["7.1e-6", "31", "1e4", "2.9", "8.3e7"]
    );
    assert_eq!(
        [rounded(3.656e-5, "3.7e-5"), rounded(30.6, "31"), rounded(0.5, "0.50")],
        ["3.7e-5", "31", "0.50"]
    );
}
