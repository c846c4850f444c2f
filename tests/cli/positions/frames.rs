//! Frames, orders and starts are recognised, and the place of a difference is told.

use std::fs;

use serde_json::Value;

use super::{HANGING, compared, positions, raw, run, scene};
use crate::mistakes::{self, Mistakes};
use crate::scratch::Scratch;
use crate::textbook_cloth::Cloth;

#[test]
fn other_frames_and_orders_are_recognised() {
    let numbers = positions(HANGING, Mistakes::default(), 10);
    let state = |frame: usize| &numbers[3 * 99 * frame..3 * 99 * (frame + 1)];
    let says = |bytes: Vec<u8>, more: &[&str]| compared(HANGING, bytes, more, 1)["verdict"].to_string();
    let wrong = says(raw(state(5)), &["--frame", "7"]);
    assert!(wrong.contains("state 0 of the file is that of frame 5, not 7"), "{wrong}");
    let shifted = says(raw(&numbers[3 * 99..3 * 99 * 8]), &["--frames", "0..7"]);
    assert!(shifted.contains("compare with --frames 1..8"), "{shifted}");
    let points = state(5).as_chunks::<3>().0;
    let columns: Vec<f64> = (0..99).flat_map(|p| points[(p % 9) * 11 + p / 9]).collect();
    let by_columns = says(raw(&columns), &["--frame", "5"]);
    assert!(by_columns.contains("written column by column"), "{by_columns}");
    let swapped: Vec<f64> = points.iter().flat_map(|&[x, y, z]| [x, z, y]).collect();
    let swapped = says(raw(&swapped), &["--frame", "5"]);
    assert!(swapped.contains("as x z y"), "{swapped}");
    let mut broken = state(5).to_vec();
    broken[3 * 16] = f64::NAN;
    let broken = says(raw(&broken), &["--frame", "5"]);
    assert!(broken.contains("column 5, row 1 is no number at frame 5"), "{broken}");
}

/// The depths at which a vertical cloth starts are random in every program but ours.
#[test]
fn a_vertical_cloth_starts_where_the_file_says() {
    let text = HANGING.replace("\"orientation\": 0", "\"orientation\": 1");
    let started = |mistakes| {
        let scene = scene(&text);
        let mut cloth = mistakes::cloth(&scene, mistakes);
        let start = cloth.x.iter().map(|&[x, y, z]| [x, y, -0.5 * z]).collect();
        mistakes::start_at(&mut cloth, start);
        raw(&run(&scene, &mut cloth, 6, Cloth::step))
    };
    compared(&text, started(Mistakes::default()), &[], 0);
    let stiff = started(Mistakes { stiff_bending: true, ..Mistakes::default() });
    let verdict = compared(&text, stiff, &[], 1)["verdict"].to_string();
    assert!(verdict.contains("behaves like the mistake: bending springs as stiff"), "{verdict}");
}

#[test]
fn frames_are_found_by_their_number_or_given() {
    let numbers = positions(HANGING, Mistakes::default(), 10);
    let state = 3 * 99;
    let first = |from: usize, to: usize, more: &[&str]| {
        compared(HANGING, raw(&numbers[from * state..to * state]), more, 0)["first_frame"].clone()
    };
    // The scene shows 9 frames.
    assert_eq!(first(0, 10, &[]), 0);
    assert_eq!(first(1, 10, &[]), 1);
    assert_eq!(first(9, 10, &[]), 9);
    assert_eq!(first(0, 4, &[]), 0);
    assert_eq!(first(4, 5, &["--frame", "4"]), 4);
    assert_eq!(first(2, 6, &["--frames", "2..6"]), 2);
    let text: String = numbers[..2 * state]
        .chunks(3)
        .map(|point| format!("{} {} {}\n", point[0], point[1], point[2]))
        .collect();
    assert_eq!(compared(HANGING, text.into_bytes(), &[], 0)["states"], 2);
    let scratch = Scratch::new();
    fs::write(scratch.path("scene.json"), HANGING).expect("a file");
    fs::write(scratch.path("theirs"), raw(&numbers)).expect("a file");
    for (more, code) in
        [(&["--frame", "4"][..], 2), (&["--frames", "0..9"], 2), (&["--set", "cloth.num_width_points=12"], 6)]
    {
        let run = scratch.run(&[&["compare-positions", "scene.json", "theirs"], more].concat());
        assert_eq!((run.code, run.stdout.len()), (Some(code), 0), "{more:?}: {}", run.stderr);
    }
    // The help names what was not given, or what would do.
    let help = |file: &str, more: &[&str]| {
        let run = scratch.run(&[&["compare-positions", "scene.json", file], more].concat());
        run.stderr.split_once("= help: ").map(|(_, help)| help.trim().to_owned()).unwrap_or_default()
    };
    assert_eq!(help("theirs", &["--frame", "4"]), "give the frames of the states with --frames A..B");
    assert_eq!(help("theirs", &["--frames", "2..9"]), "from frame 2 on they are --frames 2..12");
    fs::write(scratch.path("0000.bin"), raw(&numbers[..state])).expect("a file");
    assert_eq!(help("%04d.bin", &["--frame", "0"]), "leave out --frame and --frames");
    let wrong = ["--set", "cloth.ks=4000", "--no-diagnosis"];
    let tolerant = "--tolerance 1e-6 accepts differences that come from rounding";
    assert_eq!(help("theirs", &wrong), tolerant);
    assert_eq!(help("theirs", &[&wrong[..], &["--tolerance", "1e-12"]].concat()), "");
}

#[test]
fn the_place_and_the_size_of_the_difference_are_told() {
    let mut numbers = positions(HANGING, Mistakes::default(), 5);
    let point = 4 * 11 + 7;
    for frame in [3, 4] {
        numbers[3 * (frame * 99 + point) + 2] += 0.5;
    }
    let found = &compared(HANGING, raw(&numbers), &[], 1)["difference"];
    assert_eq!((&found["frame"], &found["point"]), (&3.into(), &serde_json::json!([7, 4])));
    assert!((found["distance"].as_f64().expect("a distance") - 0.5).abs() < 1e-12, "{found}");
    assert_eq!(found["distance"], found["largest"]);
    numbers[0] = f64::NAN;
    let found = &compared(HANGING, raw(&numbers), &["--tolerance", "1"], 1)["difference"];
    assert_eq!(
        (&found["frame"], &found["theirs"][0], &found["largest"]),
        (&0.into(), &Value::Null, &Value::Null)
    );
}
