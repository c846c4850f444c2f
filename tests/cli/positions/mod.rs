//! `compare-positions` finds where another program parts from the method, and names its mistake.
//! The other program is the textbook cloth, which can make the mistakes.

mod chaos;
mod frames;
mod mistaken;
mod rounding;

use std::fs;

use drape::scene::{Overrides, Scene, load_text};
use serde_json::Value;

use crate::mistakes::{self, Mistakes};
use crate::scratch::Scratch;
use crate::textbook_cloth::Cloth;

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
    run(&scene, &mut mistakes::cloth(&scene, mistakes), frames, Cloth::step)
}

/// The positions of frames 0 up to, without, `frames`, of a cloth whose step is `step`.
fn run<'a>(
    scene: &Scene,
    cloth: &mut Cloth<'a>,
    frames: usize,
    mut step: impl FnMut(&mut Cloth<'a>),
) -> Vec<f64> {
    let mut numbers: Vec<f64> = cloth.x.as_flattened().to_vec();
    for _ in 1..frames {
        (0..scene.sim.steps_per_frame).for_each(|_| step(cloth));
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
