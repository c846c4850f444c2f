//! Mistakes of other programs are named.

use super::{HANGING, compared, positions, raw, run, scene, verdict};
use crate::mistakes::{self, Fault, Mistakes};
use crate::textbook_cloth::Cloth;

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
    run(&scene, &mut cloth, frames, |cloth| mistakes::faulty_step(&scene, cloth, fault, &mut kept))
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
    let verdict =
        compared(HANGING, raw(&run(&scene, &mut cloth, 8, Cloth::step)), &[], 1)["verdict"].to_string();
    assert!(verdict.contains("bending springs with a part of ks of 0.5 instead of 0.2"), "{verdict}");
    let thick = HANGING.replace("0.0095", "0.055");
    let scene = super::scene(&thick);
    let mut cloth = mistakes::cloth(&scene, Mistakes::default());
    cloth.box_of = |[x, y, z]| {
        [(x * 10.0 / 11.0).floor() as i64, (y * 8.0 / 9.0).floor() as i64, (z * 10.0 / 11.0).floor() as i64]
    };
    let verdict =
        compared(&thick, raw(&run(&scene, &mut cloth, 8, Cloth::step)), &[], 1)["verdict"].to_string();
    assert!(verdict.contains("cells of 3 width / (W - 1)"), "{verdict}");
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
