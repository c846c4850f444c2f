//! Contact at the ends of every range: what the second table of `docs/extremes.md` says, row by row.

use std::fs;

use drape::error::Kind;
use drape::scene::{Overrides, Scene, Vec3, load_text};

use crate::scenes::colliders::depth_in_any;

use super::{after, farthest, middle, scene, simulation};

const SLOPE: &str = "sim.gravity=[4.9,-8.487,0]";

/// The rows of the table, each with the test that its last column names.
fn rows() -> Vec<(String, String)> {
    let page = fs::read_to_string(crate::repository::path("docs/extremes.md")).unwrap();
    let (_, table) = page.split_once("\n## Contact\n").unwrap();
    let lines = table.lines().filter(|line| line.starts_with("| ") && line.ends_with("` |"));
    let test = |line: &str| line.trim_end_matches("` |").rsplit('`').next().unwrap().to_owned();
    lines.map(|line| (test(line), line.to_owned())).collect()
}

/// That a row of `test` says `happened`.
fn page_says(test: &str, happened: &str) {
    let rows: Vec<String> = rows().into_iter().filter(|(name, _)| name == test).map(|(_, row)| row).collect();
    assert!(
        rows.iter().any(|row| row.contains(&format!("| {happened} |"))),
        "{test}: {happened}, not in {rows:?}"
    );
}

#[test]
fn the_table_names_every_test() {
    let mut named: Vec<String> = rows().into_iter().map(|(test, _)| test).collect();
    let source = fs::read_to_string(crate::repository::path("tests/engine/contact/extremes.rs")).unwrap();
    let tests = source.split("#[test]\nfn ").skip(1).map(|rest| rest.split('(').next().unwrap().to_owned());
    let mut tests: Vec<String> = tests.filter(|test| test != "the_table_names_every_test").collect();
    named.sort();
    named.dedup();
    tests.sort();
    assert_eq!(named, tests);
}

#[test]
fn friction_from_0_to_1e15() {
    for (friction, expected) in [("0", 9.8), ("1", 0.0), ("1e15", 0.0)] {
        let floor = format!(r#"plane={{"point":[0,1,0],"normal":[0,1,0],"friction":{friction}}}"#);
        let scene = scene(&[SLOPE, &floor, "sim.start=half_step"]);
        let moved = farthest(&after(&scene, 2.0), &scene);
        assert!((moved - expected).abs() < 1e-9, "friction {friction}: {moved} m");
        page_says("friction_from_0_to_1e15", &format!("slides {expected:.6} m in 2 s"));
    }
}

#[test]
fn friction_beyond() {
    let refused = |contact: &str, friction: &str, code: &str| {
        let text = format!(
            r#"{{"plane": {{"point": [0, 0, 0], "normal": [0, 1, 0], "friction": {friction}}}, "sim": {{"contact": "{contact}"}}}}"#
        );
        let error = load_text("a.json", &text, &Overrides::default()).unwrap_err();
        assert_eq!((error.kind, error.diagnostics[0].code), (Kind::Scene, code), "{error}");
        error.diagnostics[0].message.clone()
    };
    assert!(refused("coulomb", "-1", "scene::out_of_range").contains("must be from 0 to 1e15"));
    page_says("friction_beyond", "must be from 0 to 1e15");
    for contact in ["report", "outside"] {
        assert!(refused(contact, "1.5", "scene::friction").contains("must be from 0 to 1"));
    }
    page_says("friction_beyond", "must be from 0 to 1");
}

/// A corner of the cloth flies at the middle of a ball: it stops at its near side.
#[test]
fn a_fast_cloth_and_a_small_ball() {
    let ball = r#"sphere={"origin":[0.5,-7,0.5],"radius":0.005,"friction":1e15}"#;
    let speed = [
        "cloth.velocity=[0,-10000,0]",
        "cloth.width=0.5",
        "cloth.height=0.5",
        "cloth.ks=0",
        "sim.gravity=[0,0,0]",
    ];
    let end = after(&scene(&[&speed[..], &[ball]].concat()), 0.1);
    let x = end.positions().get(15);
    let off = (x - Vec3::new(0.5, -6.995, 0.5)).norm();
    assert!(off < 1e-9, "{off:e} m");
    page_says("a_fast_cloth_and_a_small_ball", "the point that meets it stops on it");
}

/// The deepest that a point is inside one of the objects of a scene in its first `frames`, in metres.
fn deepest(scene: &Scene, frames: u64) -> f64 {
    let (mut simulation, mut deepest) = (simulation(scene), 0.0_f64);
    for _ in 0..frames {
        simulation.advance_frame().unwrap();
        let x = simulation.positions();
        for x in (0..x.len()).map(|p| x.get(p)) {
            deepest = deepest.max(depth_in_any(&scene.colliders, x));
        }
    }
    deepest
}

#[test]
fn a_ball_and_a_plane_that_overlap() {
    let objects = [
        r#"plane={"point":[0,0,0],"normal":[0,1,0],"friction":0.2}"#,
        r#"sphere={"origin":[0.5,0.1,0.5],"radius":0.3,"friction":0.3}"#,
    ];
    for velocity in ["cloth.velocity=[0,-1,0]", "cloth.velocity=[3000,-10000,0]"] {
        let size = ["cloth.num_width_points=16", "cloth.num_height_points=16", "cloth.damping=0.2", velocity];
        let deep = deepest(&scene(&[&objects[..], &size].concat()), 90);
        assert!(deep < 1e-12, "{velocity}: {deep:e} m");
    }
    page_says("a_ball_and_a_plane_that_overlap", "no point is inside of either");
}

#[test]
fn a_corner_of_a_box() {
    let cube = r#"box={"origin":[0.75,0.5,0.75],"size":[0.5,0.5,0.5],"friction":0.3}"#;
    let floor = r#"plane={"point":[0,0,0],"normal":[0,1,0],"friction":0.2}"#;
    for velocity in ["cloth.velocity=[0,-1,0]", "cloth.velocity=[5000,-10000,5000]"] {
        let size = ["cloth.num_width_points=16", "cloth.num_height_points=16", "cloth.damping=0.2", velocity];
        let deep = deepest(&scene(&[&[cube, floor], &size[..]].concat()), 90);
        assert!(deep < 1e-12, "{velocity}: {deep:e} m");
    }
    page_says("a_corner_of_a_box", "no point is inside");
}

/// A ball of 1e9 m has a surface that is known to 1e-7 m: what lies on it stays within that.
#[test]
fn a_ball_of_1e9_m() {
    let floor = r#"sphere={"origin":[0,-999999999,0],"radius":1e9,"friction":0.6}"#;
    let scene = scene(&[floor, "sim.start=half_step"]);
    let end = after(&scene, 2.0);
    let moved = farthest(&end, &scene);
    assert!(moved < 1e-6 && end.energy().kinetic < 1e-9, "{moved:e} m, {:?}", end.energy());
    page_says("a_ball_of_1e9_m", &format!("moved by {moved:.1e} m"));
}

/// Far from the origin a position has few digits: a slide is right to the rounding of its steps.
#[test]
fn far_from_the_origin() {
    for (far, bound) in [(1e3, 1e-6), (1e6, 1e-4), (1e9, 1.0)] {
        let floor = format!(r#"plane={{"point":[{far},{far},0],"normal":[0,1,0],"friction":0.5}}"#);
        let offset = format!("cloth.offset=[{far},{},0]", far - 1.0);
        let scene = scene(&[SLOPE, &floor, &offset, "sim.start=half_step", "sim.steps_per_frame=3"]);
        let off = (middle(after(&scene, 2.0).positions()).x - far - 0.5 - 1.313).abs();
        assert!(off < bound, "at {far} m: {off} m");
        page_says("far_from_the_origin", &format!("off by {off:.1e} m"));
    }
}
