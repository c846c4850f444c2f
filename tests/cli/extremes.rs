//! At the extremes every scene keeps an exact law, a stated bound, or stops with its message: what
//! `docs/extremes.md` says, row by row. Each row has the test that its last column names, and each
//! test holds what it measures against its row.

#![expect(clippy::unwrap_used, reason = "a test may panic")]

use std::process::Command;

use serde_json::Value;

/// What a run of `simulate` gave.
struct Run {
    code: Option<i32>,
    summary: Value,
    stderr: String,
    /// x, y, z of each point.
    points: Vec<[f64; 3]>,
}

/// A cloth that hangs from nothing and touches nothing.
const FREE: [&str; 2] = ["cloth.pinned=[]", "sim.self_collision=\"off\""];

/// Runs `simulate scenes/pinned2.json` for so many frames with `sets`.
fn simulate(frames: u64, sets: &[&str]) -> Run {
    let folder = tempfile::tempdir().unwrap();
    let (positions, frames) = (folder.path().join("positions"), frames.to_string());
    let mut command = Command::new(assert_cmd::cargo::cargo_bin!("drape"));
    command.args([
        "simulate",
        &crate::scratch::scene("pinned2.json"),
        "--json",
        "--frames",
        &frames,
        "--positions",
    ]);
    command.arg(&positions).args(sets.iter().flat_map(|set| ["--set", set]));
    let output = command.output().unwrap();
    let bytes = std::fs::read(&positions).unwrap_or_default();
    let numbers: Vec<f64> =
        bytes.chunks_exact(8).map(|b| f64::from_le_bytes(b.try_into().unwrap())).collect();
    Run {
        code: output.status.code(),
        summary: serde_json::from_slice(&output.stdout).unwrap_or(Value::Null),
        stderr: String::from_utf8(output.stderr).unwrap(),
        points: numbers.chunks_exact(3).map(|p| [p[0], p[1], p[2]]).collect(),
    }
}

fn ran(frames: u64, sets: &[&str]) -> Run {
    let run = simulate(frames, sets);
    assert_eq!(run.code, Some(0), "{sets:?}: {}", run.stderr);
    assert!(!run.points.is_empty(), "{sets:?}: points");
    run
}

/// Runs what must stop with `code` and the message that the row of `test` has, `part`.
fn stops(test: &str, frames: u64, sets: &[&str], code: i32, part: &str) {
    page_says(test, part);
    let run = simulate(frames, sets);
    assert_eq!(run.code, Some(code), "{sets:?}: {}", run.stderr);
    assert!(run.stderr.contains(part), "{sets:?}: {part}: {}", run.stderr);
    assert!(run.points.is_empty(), "{sets:?}: nothing is written");
}

/// How far a point has fallen after `steps` steps of `h` seconds, by the closed form of the scheme
/// with the part `d` of the displacement lost per step.
fn fall(g: f64, h: f64, d: f64, steps: u32) -> f64 {
    let (mut speed, mut drop) = (0.0, 0.0);
    for _ in 0..steps {
        speed = speed * (1.0 - d) + g * h * h;
        drop += speed;
    }
    drop
}

/// That every point fell by `drop` from y = 1, up to `bound` of it; the largest error as the page
/// has it.
fn all_fell(run: &Run, drop: f64, bound: f64) -> String {
    let error = |[_, y, _]: &[f64; 3]| (1.0 - y - drop).abs() / drop;
    let largest = run.points.iter().map(error).fold(0.0, f64::max);
    assert!(largest <= bound, "not all fell {drop} m: off by {largest:e}, at most {bound:e}");
    format!("off by {largest:.1e}")
}

/// The largest coordinate, in metres.
fn largest(run: &Run) -> f64 {
    run.points.iter().flatten().fold(0.0, |largest, c| c.abs().max(largest))
}

/// The lines of the table of `docs/extremes.md`, each with the test that it names.
fn rows() -> Vec<(String, String)> {
    let page = std::fs::read_to_string(crate::repository::path("docs/extremes.md")).unwrap();
    // The second table, of contact, is that of `tests/engine/contact/extremes.rs`.
    let table = page.split("\n## Contact\n").next().unwrap();
    let lines = table.lines().filter(|line| line.starts_with("| ") && line.ends_with("` |"));
    let test = |line: &str| line.trim_end_matches("` |").rsplit('`').next().unwrap().to_owned();
    lines.map(|line| (test(line), line.to_owned())).collect()
}

/// That the row of `test` says `happened`.
fn page_says(test: &str, happened: &str) {
    let row = rows().into_iter().find(|(name, _)| name == test).unwrap_or_else(|| panic!("a row for {test}"));
    assert!(row.1.contains(happened), "{happened}, not in {}", row.1);
}

/// Every row names a test of this file, and every other test of this file has a row.
#[test]
fn the_table_names_every_test() {
    let mut named: Vec<String> = rows().into_iter().map(|(test, _)| test).collect();
    let source = std::fs::read_to_string(crate::repository::path("tests/cli/extremes.rs")).unwrap();
    let tests = source.split("#[test]\nfn ").skip(1).map(|rest| rest.split('(').next().unwrap().to_owned());
    let mut tests: Vec<String> = tests.filter(|test| test != "the_table_names_every_test").collect();
    named.sort();
    tests.sort();
    assert!(tests.len() > 20, "found {} tests", tests.len());
    assert_eq!(named, tests);
}

const H: f64 = 1.0 / 2700.0;

#[test]
fn stiffness_0() {
    // Without stiffness and limit every free point falls by itself, and the pinned ones stay.
    let run = ran(30, &["cloth.ks=0", "sim.stretch_limit=null", "sim.self_collision=\"off\""]);
    let drop = fall(9.8, H, 0.002, 900);
    let error =
        |(p, [_, y, _]): (usize, &[f64; 3])| (1.0 - y - if p == 0 || p == 49 { 0.0 } else { drop }).abs();
    let largest = run.points.iter().enumerate().map(error).fold(0.0, f64::max);
    assert!(largest < 1e-10, "off by {largest} m");
    page_says("stiffness_0", &format!("off by {largest:.1e} m"));
}

#[test]
fn stiffness_1e12() {
    let message = "unstable before the first step: dt·ω = 4273.94 > 2.00";
    stops("stiffness_1e12", 30, &["cloth.ks=1e12"], 5, message);
}

#[test]
fn stiffness_below_0() {
    stops("stiffness_below_0", 30, &["cloth.ks=-1"], 3, "must be from 0 to 1e15 N/m");
}

#[test]
fn density_1e_minus_6() {
    let message = "unstable before the first step: dt·ω = 3701.34 > 2.00";
    stops("density_1e_minus_6", 30, &["cloth.density=1e-6"], 5, message);
}

#[test]
fn density_1e12_free() {
    // A mass of 4e8 kg a point: the springs do nothing.
    let run = ran(30, &[&["cloth.density=1e12"][..], &FREE].concat());
    page_says("density_1e12_free", &all_fell(&run, fall(9.8, H, 0.002, 900), 1e-9));
}

#[test]
fn density_1e12_held() {
    let run = ran(30, &["cloth.density=1e12"]);
    assert!(largest(&run) < 3.0, "the stretch limit holds it");
    page_says("density_1e12_held", &format!("{:.2} m", largest(&run)));
}

#[test]
fn density_0() {
    stops("density_0", 30, &["cloth.density=0"], 3, "must be above 0");
}

#[test]
fn damping_0() {
    let run = ran(45, &["cloth.damping=0", "sim.stretch_limit=null", "sim.self_collision=\"off\""]);
    let energy = &run.summary["energy"];
    let total: f64 =
        ["kinetic", "spring", "gravitational"].iter().map(|name| energy[name].as_f64().unwrap()).sum();
    assert!((total - 1470.0).abs() < 14.7, "{total} J of 1470 J");
    page_says("damping_0", &format!("{total:.2} J"));
}

#[test]
fn damping_100() {
    // A point forgets how it moved: it falls by g h² in every step.
    let run = ran(30, &[&["cloth.damping=100"][..], &FREE].concat());
    page_says("damping_100", &all_fell(&run, 900.0 * 9.8 * H * H, 1e-9));
}

#[test]
fn damping_beyond() {
    for damping in ["cloth.damping=100.001", "cloth.damping=-1e-9"] {
        stops("damping_beyond", 30, &[damping], 3, "must be from 0 to 100 %");
    }
}

#[test]
fn gravity_0() {
    let still = ["sim.gravity=[0,0,0]"];
    let [start, end] = [0, 30].map(|frames| ran(frames, &still));
    assert_eq!(start.points, end.points, "nothing ever moves");
    page_says("gravity_0", "not a bit moved");
}

/// Strong gravity along -y.
const STRONG: [&str; 1] = ["sim.gravity=[0,-1e6,0]"];

#[test]
fn gravity_1e6_free() {
    let run = ran(30, &[&STRONG[..], &FREE].concat());
    page_says("gravity_1e6_free", &all_fell(&run, fall(1e6, H, 0.002, 900), 1e-9));
}

#[test]
fn gravity_1e6_held() {
    // A step moves a point by 0.14 m, seven times the spacing; the limit alone holds the cloth.
    let run = ran(30, &STRONG);
    assert!(largest(&run) < 1e3, "within a thousand sides");
    page_says("gravity_1e6_held", &format!("{:.1} m", largest(&run)));
}

#[test]
fn thickness_0() {
    let run = ran(30, &["cloth.thickness=0"]);
    assert_eq!(run.summary["counters"]["pairs_tested"], 0, "nothing is looked for");
    page_says("thickness_0", "0 pairs");
}

#[test]
fn thickness_beyond_spacing() {
    // More than the spacing of 0.0204 m: a warning, and no point faster than what pushes it allows.
    let run = ran(60, &["cloth.thickness=0.05"]);
    let warning = "self-collision pushes the cloth apart";
    assert!(run.stderr.contains(warning), "{}", run.stderr);
    assert!(largest(&run) < 5.0, "it stays in one place");
    page_says("thickness_beyond_spacing", warning);
    page_says("thickness_beyond_spacing", &format!("{:.2} m", largest(&run)));
}

#[test]
fn points_2_x_2() {
    let two = ["cloth.num_width_points=2", "cloth.num_height_points=2", "cloth.pinned=[[0,0],[1,0]]"];
    let run = ran(180, &two);
    assert_eq!(run.points.len(), 4);
    assert_eq!(run.points[..2], [[0.0, 1.0, 0.0], [1.0, 1.0, 0.0]], "pinned");
    let furthest =
        run.points[2..].iter().map(|[_, y, z]| ((y - 1.0) * (y - 1.0) + z * z).sqrt()).fold(0.0, f64::max);
    assert!(furthest < 1.11, "{furthest} m below the pins: the limit of a side of 1 m");
    page_says("points_2_x_2", &format!("{furthest:.4} m"));
}

const LARGE: [&str; 3] = ["cloth.num_width_points=2000", "cloth.num_height_points=2000", "cloth.thickness=0"];

#[test]
fn points_2000_x_2000() {
    stops("points_2000_x_2000", 1, &LARGE, 5, "raise steps_per_frame from 30 to at least 182");
}

#[test]
fn points_2000_x_2000_free() {
    // Two steps of a 1/20000 s, each one frame, held nowhere: a free fall of four million points.
    let steps = ["sim.fps=20000", "sim.steps_per_frame=1", "sim.stretch_limit=null"];
    let run = ran(2, &[&LARGE[..], &steps, &FREE].concat());
    assert_eq!(run.points.len(), 4_000_000);
    page_says("points_2000_x_2000_free", &all_fell(&run, fall(9.8, 1.0 / 20000.0, 0.002, 2), 1e-7));
}

#[test]
fn points_too_few() {
    stops("points_too_few", 1, &["cloth.num_width_points=1"], 3, "must be a whole number from 2");
}

#[test]
fn points_too_many() {
    let many = ["cloth.num_width_points=4000", "cloth.num_height_points=4000"];
    stops("points_too_many", 1, &many, 3, "too large");
}

const NANO: [&str; 3] = ["cloth.width=1e-9", "cloth.height=1e-9", "cloth.thickness=0"];

#[test]
fn size_1e_minus_9() {
    let message = "unstable before the first step: dt·ω = 302213089.27 > 2.00";
    stops("size_1e_minus_9", 30, &NANO, 5, message);
}

#[test]
fn size_1e_minus_9_soft() {
    // As many springs over masses as in the stock cloth: it falls as that one does.
    let run = ran(30, &[&NANO[..], &["cloth.ks=5e-15"], &FREE].concat());
    page_says("size_1e_minus_9_soft", &all_fell(&run, fall(9.8, H, 0.002, 900), 1e-9));
}

#[test]
fn size_1e9() {
    let giga = ["cloth.width=1e9", "cloth.height=1e9"];
    let run = ran(30, &[&giga[..], &FREE].concat());
    page_says("size_1e9", &all_fell(&run, fall(9.8, H, 0.002, 900), 1e-9));
}

/// A frame of one step of 1 ns.
const NANOSECOND: [&str; 2] = ["sim.fps=1e9", "sim.steps_per_frame=1"];

#[test]
fn step_1e_minus_9() {
    // In the 5e-8 s of 50 such steps a cloth falls by 1.2e-14 m, which would show.
    let message = "stuck before the first step: gravity moves point (1, 0) by 9.800e-18 m along y";
    stops("step_1e_minus_9", 50, &NANOSECOND, 5, message);
}

#[test]
fn step_1e_minus_9_few() {
    let run = ran(5, &NANOSECOND);
    assert!(run.points.iter().all(|p| p[1] == 1.0), "5 steps move it by 1.2e-16 m, which no number shows");
    page_says("step_1e_minus_9_few", "not a bit moved");
}

/// A frame of one step of 1 s.
const SECOND: [&str; 2] = ["sim.fps=1", "sim.steps_per_frame=1"];

#[test]
fn step_1() {
    stops("step_1", 1, &SECOND, 5, "raise steps_per_frame from 1 to at least 409");
}

#[test]
fn step_1_soft() {
    // So soft that a step of 1 s is stable: a free fall in few steps.
    let run = ran(20, &[&SECOND[..], &["cloth.ks=1e-3"], &FREE].concat());
    page_says("step_1_soft", &all_fell(&run, fall(9.8, 1.0, 0.002, 20), 1e-12));
}
