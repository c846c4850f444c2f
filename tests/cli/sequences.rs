//! Positions of many frames, for numpy too, and two files of positions compared with each other.

use std::fs;

use serde_json::json;

use crate::scratch::Scratch;

#[test]
fn every_frame_has_a_file_and_numpy_reads_it() {
    let scratch = Scratch::new();
    scratch.succeed(&["simulate", "small.json", "--frames", "9", "--positions", "all/%03d.npy"]);
    scratch.succeed(&[
        "simulate",
        "small.json",
        "--frames",
        "9",
        "--positions",
        "some/%d.bin",
        "--every",
        "4",
    ]);
    let names = |folder: &str| {
        let entries = fs::read_dir(scratch.path(folder)).unwrap().map(|entry| entry.unwrap().file_name());
        let mut names: Vec<String> = entries.map(|name| name.into_string().unwrap()).collect();
        names.sort();
        names
    };
    assert_eq!(names("all"), (0..=9).map(|frame| format!("{frame:03}.npy")).collect::<Vec<_>>());
    assert_eq!(names("some"), ["0.bin", "4.bin", "8.bin"]);
    scratch.succeed(&["simulate", "small.json", "--frames", "8", "--positions", "eight.bin"]);
    let numbers = scratch.read("eight.bin");
    assert!(numbers == scratch.read("some/8.bin"), "the last frame of a shorter run");
    let numpy = scratch.read("all/008.npy");
    assert!(numpy.starts_with(b"\x93NUMPY\x01\x00") && numpy.ends_with(&numbers));
    assert_eq!(numpy.len() % 64, numbers.len() % 64, "the numbers start at a multiple of 64");
    assert!(String::from_utf8_lossy(&numpy[..128]).contains("'shape': (5, 5, 3)"));
    // They are the method's, from the first to the last.
    let report = scratch.json(&["compare-positions", "small.json", "all/%03d.npy", "--json", "-q"]);
    assert_eq!(
        (&report["states"], &report["first_frame"], &report["largest"]),
        (&json!(10), &json!(0), &json!(0.0))
    );
    let gaps = scratch.run(&["compare-positions", "small.json", "some/%d.bin"]);
    assert_eq!(gaps.code, Some(2));
    assert!(gaps.stderr.contains("not one after the other"), "{}", gaps.stderr);
    let none = scratch.run(&["compare-positions", "small.json", "some/%d.npy"]);
    assert_eq!(none.code, Some(6), "{}", none.stderr);
}

/// A program that reads all files of a dump would read those of a longer run with the others.
#[test]
fn files_of_an_earlier_run_are_warned_of() {
    let scratch = Scratch::new();
    let said = |frames: &str, every: &str| {
        let words =
            ["simulate", "small.json", "--frames", frames, "--positions", "p/%d.npy", "--every", every];
        let run = scratch.run(&words);
        assert_eq!(run.code, Some(0), "{}", run.stderr);
        run.stderr
    };
    assert_eq!(said("6", "2"), "");
    assert_eq!(said("6", "2"), "", "a run that writes them all again leaves none");
    let shorter = said("3", "2");
    assert!(shorter.contains("2 numbered files from p/4.npy on are of an earlier run"), "{shorter}");
    let sparser = said("6", "3");
    assert!(sparser.contains("2 numbered files from p/2.npy on"), "{sparser}");
}

#[test]
fn two_files_of_positions_are_compared_directly() {
    let scratch = Scratch::new();
    let write = |name: &str, frames: &str| {
        scratch.succeed(&["simulate", "small.json", "--frames", frames, "--positions", name]);
    };
    write("a.npy", "8");
    write("a.bin", "8");
    write("b.npy", "9");
    let same = scratch.run(&["compare-positions", "a.npy", "a.bin"]);
    assert_eq!((same.code, same.stderr.as_str()), (Some(0), ""));
    let text = String::from_utf8(same.stdout).unwrap();
    assert_eq!(text, "points      25, of which 0 differ\nlargest     0.000e0 m\nrms         0.000e0 m\n");
    let other = scratch.run(&["compare-positions", "a.npy", "b.npy", "--json"]);
    assert_eq!(other.code, Some(1));
    let pair = other.object();
    assert_eq!(
        (&pair["points"], &pair["first"]["column_row"]),
        (&json!(25), &json!([1, 0])),
        "pins stay: {pair}"
    );
    let largest = pair["largest"].as_f64().unwrap();
    assert!(largest > 1e-4 && pair["rms"].as_f64().unwrap() < largest);
    assert!(other.stderr.contains("--tolerance 1e-6 accepts"), "{}", other.stderr);
    let near = scratch.run(&["compare-positions", "a.npy", "b.npy", "--tolerance", "1e-9"]);
    assert_eq!(
        (near.code, near.stderr.contains("--tolerance")),
        (Some(1), false),
        "help that was not given alone"
    );
    assert_eq!(scratch.run(&["compare-positions", "a.npy", "b.npy", "--tolerance", "1"]).code, Some(0));
    assert_eq!(scratch.run(&["compare-positions", "a.npy", "small.json"]).code, Some(6), "no positions");
    assert_eq!(scratch.run(&["compare-positions", "a.npy", "b.npy", "--frame", "3"]).code, Some(2));
}

#[test]
fn without_a_diagnosis_no_mistake_is_run() {
    let scratch = Scratch::new();
    let sets = ["--set", "cloth.damping=0.7"];
    let words = ["simulate", "small.json", "--frames", "9", "--positions", "theirs/%d.npy"];
    scratch.succeed(&[&words[..], &sets].concat());
    let words = ["compare-positions", "small.json", "theirs/%d.npy", "--json"];
    let [with, without] =
        [&[][..], &["--no-diagnosis"]].map(|more| scratch.run(&[&words[..], more].concat()));
    assert_eq!((with.code, without.code), (Some(1), Some(1)));
    let (with, without) = (with.object(), without.object());
    assert!(with["verdict"].as_str().unwrap().contains("cloth.damping of 0.7 instead of 0.2"), "{with}");
    assert_eq!((&without["difference"], &without["largest"]), (&with["difference"], &with["largest"]));
    assert_eq!((&without["mistakes"], with["largest"].as_f64().unwrap() > 0.0), (&json!([]), true));
}
