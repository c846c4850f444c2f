//! `compare-positions` finds where another program parts from the method, and names its mistake.
//! The other program is the textbook cloth, which can make the mistakes.

use std::fs;

use drape::scene::{Overrides, Scene, load_text};
use serde_json::Value;

use crate::mistakes::{self, Fault, Mistakes};
use crate::scratch::Scratch;

/// A hanging cloth.
const HANGING: &str = r#"{"cloth": {"width": 1, "height": 0.8, "num_width_points": 11,
    "num_height_points": 9, "thickness": 0.0095, "orientation": 0, "pinned": [[1, 0], [8, 0], [3, 2]],
    "damping": 0.2, "density": 150, "ks": 5000, "enable_structural": true,
    "enable_shearing": true, "enable_bending": true}, "render": {"time": 0.1}}"#;

fn scene(text: &str) -> Scene {
    load_text("x.json", text, &Overrides::default()).expect("a scene").scene
}

/// The positions of frames 0 up to, without, `frames`, by a program that makes `mistakes`.
fn positions(text: &str, mistakes: Mistakes, frames: usize) -> Vec<f64> {
    let scene = scene(text);
    let mut cloth = mistakes::cloth(&scene, mistakes);
    let mut numbers: Vec<f64> = cloth.x.as_flattened().to_vec();
    for _ in 1..frames {
        (0..scene.sim.steps_per_frame).for_each(|_| cloth.step());
        numbers.extend(cloth.x.as_flattened());
    }
    numbers
}

fn raw(numbers: &[f64]) -> Vec<u8> {
    numbers.iter().flat_map(|number| number.to_le_bytes()).collect()
}

/// What the command says of `bytes`.
fn compared(text: &str, bytes: Vec<u8>, more: &[&str], code: i32) -> Value {
    let scratch = Scratch::new();
    fs::write(scratch.path("scene.json"), text).expect("a file");
    fs::write(scratch.path("theirs"), bytes).expect("a file");
    let run = scratch.run(&[&["compare-positions", "scene.json", "theirs", "--json"], more].concat());
    assert_eq!(run.code, Some(code), "{text}: {}{}", run.stderr, String::from_utf8_lossy(&run.stdout));
    run.object()
}

fn verdict(text: &str, mistakes: Mistakes, frames: usize) -> String {
    let report = compared(text, raw(&positions(text, mistakes, frames)), &[], 1);
    report["verdict"].as_str().expect("a verdict").to_owned()
}

#[test]
fn the_method_itself_has_equal_bits() {
    let report = compared(HANGING, raw(&positions(HANGING, Mistakes::default(), 10)), &[], 0);
    assert_eq!((&report["states"], &report["first_frame"]), (&10.into(), &0.into()));
    assert!(report.get("difference").is_none() && report["mistakes"].as_array().is_some_and(Vec::is_empty));
}

#[test]
fn mistakes_that_can_be_run_are_named() {
    let none = Mistakes::default();
    for (mistakes, name) in [
        (Mistakes { pitch: true, ..none }, "width / W"),
        (Mistakes { pins_are_rows: true, ..none }, "[row, column]"),
        (Mistakes { pins_are_lists: true, ..none }, "list of columns"),
        (Mistakes { stiff_bending: true, ..none }, "without the 0.2"),
        (Mistakes { soft_springs: true, ..none }, "0.2 ks for all springs"),
        (Mistakes { damping_is_a_fraction: true, ..none }, "damping not divided by 100"),
    ] {
        let verdict = verdict(HANGING, mistakes, 10);
        assert!(
            verdict.starts_with("this behaves like the mistake") && verdict.contains(name),
            "{name}: {verdict}"
        );
    }
}

/// The positions of frames 0 up to, without, `frames`, by a program with a fault in one phase.
fn faulty(text: &str, fault: Fault, frames: usize) -> Vec<f64> {
    let scene = scene(text);
    let (mut cloth, mut kept) = (mistakes::cloth(&scene, Mistakes::default()), Vec::new());
    let mut numbers: Vec<f64> = cloth.x.as_flattened().to_vec();
    for _ in 1..frames {
        (0..scene.sim.steps_per_frame)
            .for_each(|_| mistakes::faulty_step(&scene, &mut cloth, fault, &mut kept));
        numbers.extend(cloth.x.as_flattened());
    }
    numbers
}

#[test]
fn mistakes_that_no_scene_can_express_are_named() {
    let thick = HANGING.replace("0.0095", "0.055");
    // Soft enough for the limit to act at once.
    let loose = HANGING.replace(r#""ks": 5000"#, r#""ks": 50"#);
    // A little more than the distance of neighbours.
    let close = HANGING.replace("0.0095", "0.0502");
    for (text, frames, fault, name) in [
        (HANGING, 8, Fault::KeptForces, "forces that are not set to 0"),
        (&thick, 8, Fault::PushBoth, "pushes both points of each pair by the whole distance"),
        (&close, 4, Fault::WholePush, "not divided by the steps of a frame"),
        (&loose, 16, Fault::UnnormalisedLimit, "a stretch limit along the vector"),
    ] {
        let report = compared(text, raw(&faulty(text, fault, frames)), &[], 1);
        let verdict = report["verdict"].as_str().expect("a verdict");
        assert!(
            verdict.starts_with("this behaves like the mistake") && verdict.contains(name),
            "{fault:?}: {report}"
        );
    }
}

#[test]
fn a_wrong_part_of_the_bending_springs_and_wide_cells_are_found() {
    let scene = scene(HANGING);
    let mut cloth = mistakes::cloth(&scene, Mistakes::default());
    cloth
        .springs
        .iter_mut()
        .filter(|spring| spring.stiffness < 2000.0)
        .for_each(|spring| spring.stiffness = 2500.0);
    let run = |cloth: &mut crate::textbook_cloth::Cloth<'_>, frames: usize| {
        let mut numbers: Vec<f64> = cloth.x.as_flattened().to_vec();
        for _ in 1..frames {
            (0..30).for_each(|_| cloth.step());
            numbers.extend(cloth.x.as_flattened());
        }
        raw(&numbers)
    };
    let verdict = compared(HANGING, run(&mut cloth, 8), &[], 1)["verdict"].to_string();
    assert!(verdict.contains("bending springs with a part of ks of 0.5 instead of 0.2"), "{verdict}");
    let thick = HANGING.replace("0.0095", "0.055");
    let scene = self::scene(&thick);
    let mut cloth = mistakes::cloth(&scene, Mistakes::default());
    cloth.box_of = |[x, y, z]| {
        [(x * 10.0 / 11.0).floor() as i64, (y * 8.0 / 9.0).floor() as i64, (z * 10.0 / 11.0).floor() as i64]
    };
    let verdict = compared(&thick, run(&mut cloth, 8), &[], 1)["verdict"].to_string();
    assert!(verdict.contains("cells of 3 width / (W - 1)"), "{verdict}");
}

/// Programs that print six digits, as C++ does by default, or three decimals, or that write f32.
#[test]
fn rounding_to_few_digits_is_told_from_mistakes() {
    let right = positions(HANGING, Mistakes::default(), 10);
    let wrong = positions(HANGING, Mistakes { stiff_bending: true, ..Mistakes::default() }, 10);
    let text = |numbers: &[f64], write: &dyn Fn(f64) -> String| {
        numbers.iter().map(|&number| write(number) + " ").collect::<String>().into_bytes()
    };
    let six = |x: f64| format!("{x:.5e}");
    let three = |x: f64| format!("{x:.3}");
    let single = |x: f64| (x as f32).to_string();
    let writers: [(&dyn Fn(f64) -> String, &str); 3] =
        [(&six, "6 digits"), (&three, "3 d"), (&single, "32 bits")];
    for (write, digits) in writers {
        let verdict =
            |numbers: &[f64]| compared(HANGING, text(numbers, write), &[], 1)["verdict"].to_string();
        let found = verdict(&right);
        assert!(
            found.contains("every difference is rounding") && found.contains(digits),
            "{digits}: {found}"
        );
        let found = verdict(&wrong);
        assert!(found.contains("bending springs as stiff"), "{digits}: {found}");
    }
}

/// Where rounding has grown larger than what a mistake does, the verdict says so, and from when on.
#[test]
fn what_chaos_hides_is_said_to_be_hidden() {
    let text = fs::read_to_string(crate::scratch::scene("selfCollision.json")).expect("a scene");
    let small = ["cloth.num_width_points=14", "cloth.num_height_points=14", "cloth.thickness=0.03"];
    let loaded = load_text(
        "x.json",
        &text,
        &Overrides { sets: small.map(String::from).to_vec(), ..Overrides::default() },
    );
    let scene = loaded.expect("a scene").scene;
    let mut cloth = mistakes::cloth(&scene, Mistakes::default());
    // Another last bit, as sums in another order have.
    let start = cloth.x.iter().map(|&[x, y, z]| [x * (1.0 + f64::EPSILON), y, z]).collect();
    mistakes::start_at(&mut cloth, start);
    let mut numbers: Vec<f64> = cloth.x.as_flattened().to_vec();
    for _ in 1..150 {
        (0..scene.sim.steps_per_frame).for_each(|_| cloth.step());
        numbers.extend(cloth.x.as_flattened());
    }
    let sets = small.map(|set| ["--set", set]).concat();
    let verdict = compared(&text, raw(&numbers), &sets, 1)["verdict"].to_string();
    assert!(
        verdict.contains("operations in another order") && verdict.contains("nothing can be told"),
        "{verdict}"
    );
}

/// A program that reads another number than the scene's: its value is found, to the digits it was given in.
#[test]
fn wrong_numbers_are_found_by_their_values() {
    let gravity =
        |y: &str| HANGING.replace("\"render\"", &format!(r#""sim": {{"gravity": [0, {y}, 0]}}, "render""#));
    for (theirs, name) in [
        (HANGING.replace("\"damping\": 0.2", "\"damping\": 0.4"), "cloth.damping of 0.4 instead of 0.2"),
        (gravity("-10"), "gravity of 10 instead of 9.8"),
        (gravity("-4.905"), "gravity of 4.905 instead of 9.8"),
        (
            HANGING.replace("5000", "7000"),
            "cloth.ks (or density the other way round) of 7000 instead of 5000",
        ),
        (HANGING.replace("150", "100"), "cloth.ks (or density the other way round) of 7500 instead of 5000"),
        (HANGING.replace("\"render\"", r#""sim": {"fps": 60}, "render""#), "sim.fps of 60 instead of 90"),
    ] {
        let report = compared(HANGING, raw(&positions(&theirs, Mistakes::default(), 10)), &[], 1);
        let verdict = report["verdict"].as_str().expect("a verdict");
        assert_eq!(verdict, format!("this behaves like the mistake: {name}"));
    }
}

#[test]
fn a_missing_offset_of_the_plane_is_named() {
    let text = HANGING.replace(
        "\"cloth\"",
        r#""plane": {"point": [0, 0.97, 0], "normal": [0, 1, 0], "friction": 0.5}, "cloth""#,
    );
    let verdict = verdict(&text, Mistakes { no_plane_offset: true, ..Mistakes::default() }, 12);
    assert_eq!(verdict, "this behaves like the mistake: points put onto the plane, not 0.0001 m above it");
}

#[test]
fn cells_that_are_taken_for_one_are_named() {
    let text = HANGING.replace("\"orientation\": 0", "\"orientation\": 1").replace("0.0095", "0.06");
    let none = Mistakes::default();
    for (mistakes, name) in [
        (Mistakes { cut_boxes: true, ..none }, "cells by coordinates cut towards zero"),
        (Mistakes { float_hash: true, ..none }, "cells told apart by x² + y² + z³"),
    ] {
        let verdict = verdict(&text, mistakes, 10);
        assert!(verdict.starts_with(&format!("this behaves like the mistake: {name}")), "{verdict}");
    }
}

#[test]
fn collisions_that_acted_are_suspected_of_what_no_mistake_explains() {
    let text = HANGING.replace("0.0095", "0.06");
    let mut numbers = positions(&text, Mistakes::default(), 5);
    numbers[4 * 3 * 99 + 50] += 0.25;
    let verdict = compared(&text, raw(&numbers), &[], 1)["verdict"].clone();
    assert!(verdict.as_str().is_some_and(|v| v.contains("; self-collision")), "{verdict}");
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

#[test]
fn a_tolerance_lets_pass_and_rounding_is_told_from_mistakes() {
    let numbers: Vec<f64> =
        positions(HANGING, Mistakes::default(), 5).iter().map(|x| x * (1.0 + 4.0 * f64::EPSILON)).collect();
    let report = compared(HANGING, raw(&numbers), &[], 1);
    assert!(report["verdict"].as_str().is_some_and(|verdict| verdict.contains("rounding")), "{report}");
    compared(HANGING, raw(&numbers), &["--tolerance", "1e-12"], 0);
    compared(HANGING, raw(&numbers), &["--tolerance", "1e-17"], 1);
}

/// A program whose grid or sums are rounded otherwise differs from the first frame on, and may still make a
/// mistake.
#[test]
fn a_mistake_is_found_behind_rounding() {
    let none = Mistakes::default();
    let rounded = |mistakes| -> Vec<f64> {
        positions(HANGING, mistakes, 10).iter().map(|x| x * (1.0 + 4.0 * f64::EPSILON)).collect()
    };
    let says = |numbers: Vec<f64>| compared(HANGING, raw(&numbers), &[], 1)["verdict"].to_string();
    assert!(says(rounded(none)).contains("rounding"));
    let both = says(rounded(Mistakes { stiff_bending: true, ..none }));
    assert!(both.contains("behaves like the mistake: bending springs as stiff"), "{both}");
}

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
    let run = |mistakes| {
        let scene = scene(&text);
        let mut cloth = mistakes::cloth(&scene, mistakes);
        let start = cloth.x.iter().map(|&[x, y, z]| [x, y, -0.5 * z]).collect();
        mistakes::start_at(&mut cloth, start);
        let mut numbers: Vec<f64> = cloth.x.as_flattened().to_vec();
        for _ in 1..6 {
            (0..scene.sim.steps_per_frame).for_each(|_| cloth.step());
            numbers.extend(cloth.x.as_flattened());
        }
        raw(&numbers)
    };
    compared(&text, run(Mistakes::default()), &[], 0);
    let stiff = run(Mistakes { stiff_bending: true, ..Mistakes::default() });
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
fn the_text_names_frame_point_and_verdict() {
    let scratch = Scratch::new();
    fs::write(scratch.path("scene.json"), HANGING).expect("a file");
    let numbers = positions(HANGING, Mistakes { pitch: true, ..Mistakes::default() }, 3);
    fs::write(scratch.path("theirs"), raw(&numbers)).expect("a file");
    let run = scratch.run(&["compare-positions", "scene.json", "theirs"]);
    assert_eq!(run.code, Some(1), "{}", run.stderr);
    let text = String::from_utf8(run.stdout).expect("text");
    assert!(text.contains("parts at    frame 0, column 1, row 0"), "{text}");
    assert!(text.contains("verdict     this behaves like the mistake: points width / W apart"), "{text}");
}
