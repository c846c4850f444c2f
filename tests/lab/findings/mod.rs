//! `docs/findings.md`: its table is what the program computes, and its text says what the table has.

#![expect(clippy::unwrap_used, reason = "a test may panic")]

mod citations;

use drape::scene::Overrides;
use drape::texture_source::TextureSource;
use drape_lab::accuracy::source::Source;
use drape_lab::store::Store;
use drape_lab::study::extent::Extent;
use drape_lab::study::reference::Difference;
use drape_lab::study::runs::Measured;
use drape_lab::study::{self, PanelStudy};

use citations::named_rows;

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

/// Every implicit row is worse than a row of Verlet's scheme that visits fewer springs, but for rough answers on stiff cloth:
/// these visit fewer than every row of Verlet's scheme, and all of those are more accurate.
#[test]
fn only_rough_answers_on_stiff_cloth_are_on_the_front() {
    let (text, rows) = page();
    assert!(
        text.contains(
            "**No implicit method is on the Pareto front** of speed and accuracy on the stock cloth"
        )
    );
    assert!(text.contains("**On stiff cloth a rough answer by BDF2 visits fewer springs**"));
    let panel = |row: &Row| row.name.split(':').next().unwrap().to_owned();
    let implicit: Vec<&Row> =
        rows.iter().filter(|row| ["implicit", "BDF2"].iter().any(|name| row.name.contains(name))).collect();
    assert!(implicit.len() > 10, "{} rows", implicit.len());
    let mut rough = 0;
    for row in implicit {
        let is_more_accurate = |other: &Row| {
            let mut moments = (0..2).filter(|&moment| !row.value(moment).is_nan());
            moments.all(|moment| other.value(moment) < row.value(moment))
        };
        let is_cheaper = |other: &Row| other.value(4) < row.value(4);
        let mut verlet = rows
            .iter()
            .filter(|other| panel(other) == panel(row) && other.name.contains("Verlet, half-step start"));
        if row.name.contains("loose") && !row.name.contains("8.33e4") {
            rough += 1;
            assert!(verlet.all(|other| is_more_accurate(other) && !is_cheaper(other)), "{row:?}");
        } else {
            assert!(verlet.any(|other| is_more_accurate(other) && is_cheaper(other)), "{row:?}");
        }
    }
    assert_eq!(rough, 2);
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
