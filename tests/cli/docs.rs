//! The figures in `docs/` are what the program says.

#![expect(clippy::unwrap_used, reason = "a test may panic")]

use std::fs;
use std::process::Command;

use rayon::prelude::*;
use serde_json::Value;

/// A row of the table of `docs/restless.md`.
struct Row {
    figure: String,
    change: String,
    /// dt·ω, margin, kinetic energies, ledger, verdict.
    cells: Vec<String>,
}

fn page(name: &str) -> String {
    fs::read_to_string(crate::repository::path(&format!("docs/{name}.md"))).unwrap()
}

fn rows() -> Vec<Row> {
    let page = page("restless");
    let lines = page.lines().filter_map(|line| line.strip_prefix("| part2-"));
    let rows: Vec<Row> = lines
        .map(|line| {
            let mut cells = line.trim_end_matches(" |").split(" | ").map(str::to_owned);
            Row { figure: cells.next().unwrap(), change: cells.next().unwrap(), cells: cells.collect() }
        })
        .collect();
    assert_eq!(rows.len(), 11, "the figures of part 2 but the last");
    rows
}

/// What a command of `docs/restless.md` prints, for a change at so many frames a second.
fn run(command: &str, change: &str, fps: &str) -> Value {
    let page = page("restless");
    let line = page.lines().find(|line| line.starts_with(&format!("drape {command} "))).unwrap();
    printed(&line.replace("FPS", fps).replace("CHANGE", change))
}

/// What a line of a page prints.
fn printed(line: &str) -> Value {
    let mut command = Command::new(assert_cmd::cargo::cargo_bin!("drape"));
    let words = line.split(' ').map(|word| word.trim_matches('\''));
    let output = command.current_dir(crate::repository::path("")).args(words.skip(1)).output().unwrap();
    assert!(output.status.success(), "{line}: {}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&output.stdout).unwrap()
}

/// dt·ω and margin as the page has them.
fn vibration(row: &Row) -> [String; 2] {
    let info = run("info", &row.change, "30");
    let [rest, worst, limit] = ["dt_omega_rest", "dt_omega_worst", "dt_omega_limit"]
        .map(|name| info["cloth"][name].as_f64().unwrap());
    let margin = if rest > 0.0 { format!("{:.2}", limit / rest) } else { "–".to_owned() };
    [format!("{rest:.3}, {worst:.3}"), margin]
}

/// Kinetic energies and ledger as the page has them.
fn energies(row: &Row) -> Vec<String> {
    let [slow, fast] = ["30", "90"].map(|fps| run("simulate", &row.change, fps));
    let kinetic = [&slow, &fast].map(|run| &run["energy"]["kinetic"]);
    let entries = ["springs", "damping", "self_collision", "stretch_limit"].map(|name| &slow["ledger"][name]);
    kinetic.into_iter().chain(entries).map(|value| format!("{:.2e}", value.as_f64().unwrap())).collect()
}

fn check(rows: Vec<Row>, cells: impl Fn(&Row) -> Vec<String> + Sync, from: usize) {
    let wrong: Vec<String> = rows
        .par_iter()
        .filter_map(|row| {
            let cells = cells(row);
            let page = row.cells.get(from..from + cells.len());
            (page != Some(&cells[..])).then(|| format!("part2-{}: {}", row.figure, cells.join(" | ")))
        })
        .collect();
    assert!(wrong.is_empty(), "the program says\n{}", wrong.join("\n"));
}

#[test]
fn the_vibrations_are_those_of_the_page() {
    check(rows(), |row| vibration(row).to_vec(), 0);
}

/// The verdict follows from the figures: unstable are those with a margin below 1, and their
/// springs put in a hundred times what the cloth starts with.
#[test]
fn the_verdicts_follow_from_the_figures() {
    for row in rows() {
        let number = |cell: usize| row.cells[cell].parse::<f64>().unwrap_or(f64::INFINITY);
        let [margin, slow, fast, springs] = [1, 2, 3, 4].map(number);
        let density = row.change.strip_prefix("cloth.density=").map_or(150.0, |text| text.parse().unwrap());
        let start = 9.8 * density;
        match row.cells[8].as_str() {
            "unstable" => {
                assert!(margin < 1.0 && springs > 100.0 * start && fast < 1e-12 * start, "{}", row.figure)
            }
            "rest" => assert!(margin > 1.0 && slow < 1e-5 * start && fast < 1e-5 * start, "{}", row.figure),
            "method" => {
                assert!(margin > 1.0 && springs < 0.02 * start && fast > 1e-5 * start, "{}", row.figure)
            }
            "undamped" => assert!(margin > 1.0 && row.cells[5] == "0.00e0", "{}", row.figure),
            other => panic!("{}: no such verdict: {other}", row.figure),
        }
    }
}

#[test]
fn an_unstable_figure_has_the_energies_of_the_page() {
    check(rows().into_iter().filter(|row| row.figure == "low-density").collect(), energies, 2);
}

#[test]
#[ignore = "twenty-two runs of 10 s take minutes"]
fn every_figure_has_the_energies_of_the_page() {
    check(rows(), energies, 2);
}

#[test]
fn the_blow_up_that_the_second_check_misses_is_as_the_page_says() {
    let [motion, springs] = motion_and_springs(0);
    is_said(&format!("it holds {motion:.0} J in motion, and its springs have put in {springs:.0} J"));
}

#[test]
fn springs_that_answer_the_stretch_limit_put_in_what_the_page_says() {
    let [motion, springs] = motion_and_springs(1);
    is_said(&format!("it holds {motion:.1} J in motion, and its springs have put in {springs:.0} J"));
    let fewer = |rate: u32| {
        let fps = f64::from(rate) / 30.0;
        let sets = format!("--set cloth.ks=500 --set sim.fps={fps:?}");
        let run =
            format!("drape simulate scenes/pinned2.json --json --ledger --allow-unstable --frames 20 {sets}");
        printed(&run)["ledger"]["springs"].as_f64().unwrap()
    };
    let [a, b, c, d] = [180, 171, 156, 120].map(fewer);
    is_said(&format!(
        "{a:.0} J in 20 frames at 180 steps a second, {b:.0} J at 171, {c:.0} J at 156, {d:.0} J at 120"
    ));
}

/// Energy in motion and what the springs put in, in J, of a command of `docs/stability.md`.
fn motion_and_springs(command: usize) -> [f64; 2] {
    let page = page("stability");
    let run = printed(page.lines().filter(|line| line.starts_with("drape ")).nth(command).unwrap());
    [&run["energy"]["kinetic"], &run["ledger"]["springs"]].map(|energy| energy.as_f64().unwrap())
}

/// `docs/stability.md` has this, on one line or over several.
fn is_said(said: &str) {
    let page = page("stability");
    let words: Vec<&str> = page.split_whitespace().collect();
    assert!(words.join(" ").contains(said), "{said}");
}
