//! The parts of a stability map and of a study are the whole, and damaged results are made again.

use std::fs;
use std::path::PathBuf;

use crate::scratch::Scratch;

/// A small map and a small study, with OUT as their folder.
const MAP: [&str; 9] = [
    "stability",
    "small.json",
    "OUT",
    "--ks=500,5000",
    "--density=150",
    "--steps=10,30",
    "--time=0.05",
    "--threads",
    "2",
];
const STUDY: [&str; 6] = ["study", "small.json", "OUT", "--quick", "--time=0.1", "--only=rk4"];

/// Runs `words` in the folder `out`, and returns what was said.
fn run(scratch: &Scratch, words: &[&str], out: &str, more: &[&str]) -> String {
    let words = words.iter().map(|&word| if word == "OUT" { out } else { word });
    let run = scratch.run(&words.chain(more.iter().copied()).collect::<Vec<_>>());
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    run.stderr
}

/// The files of results in a folder, in order.
fn cells(scratch: &Scratch, out: &str) -> Vec<PathBuf> {
    let within = |path: PathBuf| fs::read_dir(path).unwrap().map(|entry| entry.unwrap().path());
    let mut cells: Vec<PathBuf> = within(scratch.path(out).join("cells")).flat_map(within).collect();
    cells.sort();
    cells
}

/// Changes a byte of a result.
fn damage(file: &PathBuf) {
    let mut bytes = fs::read(file).unwrap();
    bytes[7] ^= 1;
    fs::write(file, bytes).unwrap();
}

/// How many results a run says that it made and found.
fn counts(said: &str) -> [u64; 2] {
    let line = said.lines().last().unwrap();
    let numbers: Vec<u64> = line.split([' ', ',']).filter_map(|word| word.parse().ok()).collect();
    numbers.try_into().unwrap_or_else(|_| panic!("{said}"))
}

#[test]
fn the_parts_of_a_map_are_the_whole() {
    let scratch = Scratch::new();
    run(&scratch, &MAP, "whole", &[]);
    // Two columns and four cells.
    let parts = ["2/4", "4/4", "1/4", "3/4"];
    let made = parts.map(|part| counts(&run(&scratch, &MAP, "parts", &["--part", part])));
    assert_eq!(made, [[2, 0], [1, 0], [2, 0], [1, 0]]);
    assert_eq!(counts(&run(&scratch, &MAP, "parts", &["--part", "1/4"])), [0, 2], "nothing is run again");
    let files = cells(&scratch, "parts");
    damage(&files[3]);
    let said = run(&scratch, &MAP, "parts", &[]);
    let warning =
        format!("{}` was damaged\n  = help: it was made again", files[3].file_name().unwrap().display());
    assert!(said.contains(&warning) && said.matches("warning").count() == 1, "{said}");
    for file in ["index.html", "results.json"] {
        let [whole, parts] = ["whole", "parts"].map(|out| scratch.read(&format!("{out}/{file}")));
        assert!(whole == parts, "{file}");
    }
}

#[test]
fn the_parts_of_a_study_are_the_whole() {
    let scratch = Scratch::new();
    for part in ["3/3", "1/3", "2/3"] {
        assert!(counts(&run(&scratch, &STUDY, "out", &["--part", part]))[0] > 0);
    }
    let files = cells(&scratch, "out");
    let made = |said: &str| {
        let results: serde_json::Value = serde_json::from_slice(&scratch.read("out/results.json")).unwrap();
        (results["runs_made"].as_u64().unwrap(), said.matches("was damaged").count())
    };
    assert_eq!(made(&run(&scratch, &STUDY, "out", &[])), (0, 0), "nothing is run again");
    damage(&files[0]);
    let (runs, warnings) = made(&run(&scratch, &STUDY, "out", &[]));
    assert!(runs > 0 && warnings == 1, "{runs}, {warnings}");
    assert_eq!(cells(&scratch, "out"), files);
}
