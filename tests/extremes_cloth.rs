//! At the extremes every scene keeps an exact law, a stated bound, or stops with its message.

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
    command.args(["simulate", "scenes/pinned2.json", "--json", "--frames", &frames, "--positions"]);
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

/// Runs what must stop with `code` and a message that holds `part`.
fn stops(frames: u64, sets: &[&str], code: i32, part: &str) {
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

/// That every point fell by `drop` from y = 1, up to `bound` of it.
fn all_fell(run: &Run, drop: f64, bound: f64, what: &str) {
    for (p, [_, y, _]) in run.points.iter().enumerate() {
        let error = (1.0 - y - drop).abs() / drop;
        assert!(error <= bound, "{what}: point {p} fell {}, not {drop}: off by {error:e}", 1.0 - y);
    }
}

const H: f64 = 1.0 / 2700.0;

#[test]
fn stiffness() {
    // Without stiffness and limit every free point falls by itself, and the pinned ones stay.
    let run = ran(30, &["cloth.ks=0", "sim.stretch_limit=null", "sim.self_collision=\"off\""]);
    let drop = fall(9.8, H, 0.002, 900);
    for (p, [_, y, _]) in run.points.iter().enumerate() {
        let expected = if p == 0 || p == 49 { 0.0 } else { drop };
        assert!((1.0 - y - expected).abs() < 1e-10, "point {p}: {}", 1.0 - y);
    }
    stops(30, &["cloth.ks=1e12"], 5, "unstable before the first step: dt·ω = ");
    stops(30, &["cloth.ks=-1"], 3, "cloth.ks");
}

#[test]
fn density() {
    stops(30, &["cloth.density=1e-6"], 5, "unstable before the first step: dt·ω = ");
    // A mass of 4e8 kg a point: the springs do nothing, the limit still holds the pinned corners.
    let heavy = ["cloth.density=1e12"];
    let run = ran(30, &[&heavy[..], &FREE].concat());
    all_fell(&run, fall(9.8, H, 0.002, 900), 1e-9, "density 1e12");
    let run = ran(30, &heavy);
    assert!(run.points.iter().all(|p| p.iter().all(|c| c.abs() < 3.0)), "the limit holds it");
    stops(30, &["cloth.density=0"], 3, "cloth.density");
}

#[test]
fn damping() {
    // Undamped, the energy stays that of the start to the error of the step, 1 %.
    let run = ran(45, &["cloth.damping=0", "sim.stretch_limit=null", "sim.self_collision=\"off\""]);
    let energy = &run.summary["energy"];
    let total: f64 =
        ["kinetic", "spring", "gravitational"].iter().map(|name| energy[name].as_f64().unwrap()).sum();
    assert!((total - 1470.0).abs() < 14.7, "{total} J of 1470 J");
    // At 100 % a point forgets how it moved: it falls by g h² in every step.
    let run = ran(30, &[&["cloth.damping=100"][..], &FREE].concat());
    all_fell(&run, 900.0 * 9.8 * H * H, 1e-9, "damping 100");
    for damping in ["cloth.damping=100.001", "cloth.damping=-1e-9"] {
        stops(30, &[damping], 3, "cloth.damping");
    }
}

#[test]
fn gravity() {
    // Without weight nothing ever moves.
    let still = ["sim.gravity=[0,0,0]"];
    let [start, end] = [0, 30].map(|frames| ran(frames, &still));
    assert_eq!(start.points, end.points);
    let strong = ["sim.gravity=[0,-1e6,0]"];
    let run = ran(30, &[&strong[..], &FREE].concat());
    all_fell(&run, fall(1e6, H, 0.002, 900), 1e-9, "gravity 1e6");
    // Held at two corners the cloth is pulled beyond what its springs hold; the run either stays
    // within its energy or says that it does not.
    let run = simulate(30, &strong);
    assert!(matches!(run.code, Some(0 | 5)), "{}", run.stderr);
    assert!(run.code == Some(0) || run.stderr.contains("unstable: "), "{}", run.stderr);
}

#[test]
fn thickness() {
    let run = ran(30, &["cloth.thickness=0"]);
    assert_eq!(run.summary["counters"]["pairs_tested"], 0, "nothing is looked for");
    // More than the spacing of 0.0204 m: a warning, and no point faster than what pushes it allows.
    let run = ran(60, &["cloth.thickness=0.05"]);
    assert!(run.stderr.contains("self-collision pushes the cloth apart"), "{}", run.stderr);
    assert!(run.points.iter().all(|p| p.iter().all(|c| c.abs() < 5.0)), "it stays in one place");
}

#[test]
fn points() {
    let two = ["cloth.num_width_points=2", "cloth.num_height_points=2", "cloth.pinned=[[0,0],[1,0]]"];
    let run = ran(180, &two);
    assert_eq!(run.points.len(), 4);
    assert_eq!(run.points[..2], [[0.0, 1.0, 0.0], [1.0, 1.0, 0.0]], "pinned");
    let large = ["cloth.num_width_points=2000", "cloth.num_height_points=2000", "cloth.thickness=0"];
    stops(1, &large, 5, "raise steps_per_frame from 30 to at least 182");
    // Two steps of a 1/20000 s, each one frame, held nowhere: a free fall of four million points.
    let steps = ["sim.fps=20000", "sim.steps_per_frame=1", "sim.stretch_limit=null"];
    let run = ran(2, &[&large[..], &steps, &FREE].concat());
    assert_eq!(run.points.len(), 4_000_000);
    all_fell(&run, fall(9.8, 1.0 / 20000.0, 0.002, 2), 1e-7, "2000 x 2000");
    stops(1, &["cloth.num_width_points=1"], 3, "num_width_points");
    stops(1, &["cloth.num_width_points=4000", "cloth.num_height_points=4000"], 3, "too large");
}

#[test]
fn size() {
    let nano = ["cloth.width=1e-9", "cloth.height=1e-9", "cloth.thickness=0"];
    stops(30, &nano, 5, "unstable before the first step: dt·ω = ");
    // As many springs over masses as in the stock cloth: it falls as that one does.
    let run = ran(30, &[&nano[..], &["cloth.ks=5e-15"], &FREE].concat());
    all_fell(&run, fall(9.8, H, 0.002, 900), 1e-9, "1e-9 m");
    let giga = ["cloth.width=1e9", "cloth.height=1e9"];
    let run = ran(30, &[&giga[..], &FREE].concat());
    all_fell(&run, fall(9.8, H, 0.002, 900), 1e-9, "1e9 m");
}

#[test]
fn step() {
    let nano = ["sim.fps=1e9", "sim.steps_per_frame=1"];
    // In the 5e-8 s of 50 such steps a cloth falls by 1.2e-14 m, which would show.
    stops(50, &nano, 5, "stuck before the first step: gravity moves point (1, 0) by 9.800e-18 m along y");
    let run = ran(5, &nano);
    assert!(run.points.iter().all(|p| p[1] == 1.0), "5 steps move it by 1.2e-16 m, which no number shows");
    stops(1, &["sim.fps=1", "sim.steps_per_frame=1"], 5, "raise steps_per_frame from 1 to at least 409");
    // So soft that a step of 1 s is stable: a free fall in few steps.
    let run = ran(20, &[&["sim.fps=1", "sim.steps_per_frame=1", "cloth.ks=1e-3"][..], &FREE].concat());
    all_fell(&run, fall(9.8, 1.0, 0.002, 20), 1e-12, "dt 1 s");
}
