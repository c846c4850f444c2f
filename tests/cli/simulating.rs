//! What `simulate`, `info` and `export` give.

use crate::scratch::{Scratch, scene};

#[test]
fn positions_are_the_points_row_by_row() {
    let scratch = Scratch::new();
    scratch.succeed(&["simulate", "small.json", "--frames", "0", "--positions", "p"]);
    let numbers: Vec<f64> =
        scratch.read("p").chunks(8).map(|chunk| f64::from_le_bytes(chunk.try_into().unwrap())).collect();
    let expected: Vec<f64> =
        (0..25).flat_map(|p| [f64::from(p % 5) * 0.25, 1.0, f64::from(p / 5) * 0.25]).collect();
    assert_eq!(numbers, expected);
    let stdout = scratch.succeed(&["simulate", "small.json", "--frames", "0", "--positions", "-"]);
    assert_eq!(stdout, scratch.read("p"));
}

#[test]
fn hashes_are_a_line_a_frame_and_the_last_is_the_summary_s() {
    let scratch = Scratch::new();
    let text =
        String::from_utf8(scratch.succeed(&["simulate", "small.json", "--frames", "4", "--hash"])).unwrap();
    let lines: Vec<_> = text.lines().map(|line| line.split_once(' ').unwrap()).collect();
    let frames: Vec<_> = lines.iter().map(|(frame, _)| *frame).collect();
    assert_eq!(frames, ["0", "1", "2", "3", "4"]);
    let summary = scratch.json(&["simulate", "small.json", "--frames", "4", "--hash", "--json"]);
    let hashes: Vec<_> = lines.iter().map(|(_, hash)| *hash).collect();
    assert_eq!(summary["hashes"], serde_json::json!(hashes));
    assert_eq!(summary["state_hash"], hashes[4]);
    let distinct: std::collections::BTreeSet<_> = hashes.iter().collect();
    assert_eq!(distinct.len(), 5);
}

#[test]
fn export_is_the_simulated_mesh() {
    let scratch = Scratch::new();
    scratch.succeed(&["export", "small.json", "out.obj", "--frame", "7"]);
    scratch.succeed(&["simulate", "small.json", "--frames", "7", "--positions", "p"]);
    let text = String::from_utf8(scratch.read("out.obj")).unwrap();
    let rows = |key: &str| -> Vec<Vec<f64>> {
        let rows = text.lines().filter_map(|line| line.strip_prefix(key));
        rows.map(|row| row.split(' ').map(|n| n.parse().unwrap()).collect()).collect()
    };
    let bytes: Vec<u8> = rows("v ").concat().into_iter().flat_map(f64::to_le_bytes).collect();
    assert_eq!(bytes, scratch.read("p"), "the positions to the last bit");
    assert_eq!((rows("vt ").len(), rows("vn ").len()), (25, 25));
    assert_eq!((rows("vt ")[0].clone(), rows("vt ")[24].clone()), (vec![0.0, 1.0], vec![1.0, 0.0]));
    for normal in rows("vn ") {
        assert!((normal.iter().map(|c| c * c).sum::<f64>() - 1.0).abs() < 1e-6, "{normal:?}");
    }
    assert_eq!(text.lines().filter(|line| line.starts_with("f ")).count(), 32);
    assert!(text.contains("\nf 1/1/1 6/6/6 2/2/2\n"), "the first cell's (A, C, B)");
}

#[test]
fn export_tells_people_what_it_wrote() {
    let scratch = Scratch::new();
    let run = |quiet: &[&str]| {
        scratch.run(&[&["export", "small.json", "out.obj", "--time", "0.1"], quiet].concat()).stderr
    };
    assert_eq!(run(&[]), "out.obj: 25 points, 32 triangles, frame 9, 0.1 s\n");
    assert_eq!(run(&["-q"]), "");
}

#[test]
fn export_tells_programs_what_it_wrote() {
    let scratch = Scratch::new();
    let summary = scratch.json(&["export", "small.json", "out.obj", "--frame", "3", "--json"]);
    assert_eq!(summary["mesh"], "out.obj");
    assert_eq!(
        (&summary["frame"], &summary["points"], &summary["triangles"]),
        (&3.into(), &25.into(), &32.into())
    );
}

#[test]
fn numbered_meshes_are_a_file_for_each_frame() {
    let scratch = Scratch::new();
    for ending in ["obj", "ply"] {
        let pattern = format!("m/%03d.{ending}");
        let out = scratch.json(&["export", "small.json", &pattern, "--frames", "4..7", "--json"]);
        assert_eq!((&out["frames"], &out["frame"]), (&3.into(), &6.into()));
        scratch.succeed(&["export", "small.json", &format!("one.{ending}"), "--frame", "5"]);
        assert_eq!(scratch.read(&format!("m/001.{ending}")), scratch.read(&format!("one.{ending}")));
        let again = scratch.run(&["export", "small.json", &pattern, "--frames", "4..6"]);
        assert!(again.stderr.contains("1 numbered files from"), "{}", again.stderr);
    }
    for (arguments, part) in [
        (&["m/%03d.obj"][..], "--frames"),
        (&["one.obj", "--frames", "0..3"], "%04d"),
        (&["m/%03d.glb", "--frames", "0..3"], "one file"),
        (&["one.stl"], ".obj, .ply or .glb"),
        (&["one.ply", "--materials"], "--materials"),
    ] {
        let run = scratch.run(&[&["export", "small.json"], arguments].concat());
        assert_eq!(run.code, Some(2), "{arguments:?}: {}", run.stderr);
        assert!(run.stderr.contains(part), "{arguments:?}: {}", run.stderr);
    }
}

/// An integrator without a largest step says so, is not refused, and is stopped when it gains energy.
#[test]
fn only_verlets_scheme_has_a_largest_step() {
    let scratch = Scratch::new();
    let path = scene("pinned2.json");
    // The stretch limit takes out what one pass a step puts into the springs.
    let coarse = ["sim.steps_per_frame=1", "cloth.ks=50000", "sim.stretch_limit=null"];
    let coarse = coarse.map(|set| ["--set", set]).concat();
    let run =
        |more: &[&str]| scratch.run(&[&["simulate", &path, "--frames", "40"], &coarse[..], more].concat());
    let verlet = run(&[]);
    assert!(verlet.code == Some(5) && verlet.stderr.contains("unstable before the first step"));
    let xpbd = ["--set", "sim.integrator=xpbd"];
    let stopped = run(&xpbd);
    assert_eq!(stopped.code, Some(5), "{}", stopped.stderr);
    assert!(stopped.stderr.contains("motion, height and springs hold"), "{}", stopped.stderr);
    assert_eq!(run(&[&xpbd[..], &["--allow-unstable"]].concat()).code, Some(0));
    let info = scratch.json(&[&["info", &path, "--json"], &xpbd[..]].concat());
    assert_eq!(
        (&info["cloth"]["integrator"], &info["cloth"]["stable"]),
        (&"xpbd".into(), &"no step bound".into())
    );
    assert!(info["cloth"].get("dt_omega_rest").is_none());
}

#[test]
fn info_counts_what_a_simulation_then_uses() {
    let scratch = Scratch::new();
    for name in ["pinned2", "pinned4", "sphere", "plane", "selfCollision"] {
        let path = scene(&format!("{name}.json"));
        let info = scratch.json(&["info", &path, "--json"]);
        let run = scratch.json(&["simulate", &path, "--frames", "1", "--json"]);
        let kinds = ["structural", "shearing", "bending"].map(|kind| info["cloth"][kind].as_u64().unwrap());
        assert_eq!(kinds, [4900, 4802, 4800]);
        assert_eq!(run["springs"], 14_502);
        assert_eq!(run["counters"]["springs_evaluated"], 30 * 14_502, "30 steps a frame");
        assert_eq!(info["cloth"]["stable"], "stable");
        assert_eq!(info["frames"], 180);
        assert!(info["needs"].as_array().unwrap().iter().any(|item| item["needed"] == false));
    }
    let odd = [
        "--set",
        "cloth.num_width_points=3",
        "--set",
        "cloth.num_height_points=8",
        "--set",
        "cloth.pinned=[]",
        "--set",
        "cloth.enable_shearing=false",
        "--json",
    ];
    let info = scratch.json(&[&["info", "small.json"], &odd[..]].concat());
    let run = scratch.json(&[&["simulate", "small.json", "--frames", "1"], &odd[..]].concat());
    assert_eq!((&info["cloth"]["structural"], &info["cloth"]["bending"]), (&37.into(), &26.into()));
    assert_eq!(info["cloth"]["shearing"], 0);
    assert_eq!(run["counters"]["springs_evaluated"], 30 * 63);
    let text = String::from_utf8(scratch.succeed(&["info", "small.json"])).unwrap();
    assert!(text.contains("5 x 5 = 25 points, pinned 2") && text.contains("left out  "), "{text}");
}

/// Both cures are named only where they help: a side that faces away from the light stays dark when it is lit from both.
#[test]
fn info_says_when_most_of_what_is_seen_is_unlit() {
    let scratch = Scratch::new();
    let hint = |name: &str, sets: &[&str]| {
        let sets: Vec<&str> = sets.iter().flat_map(|set| ["--set", set]).collect();
        let text = scratch.succeed(&[&["info", &scene(name)], &sets[..]].concat());
        let text = String::from_utf8(text).unwrap();
        text.lines().find(|line| line.starts_with("hint")).map(str::to_owned)
    };
    let stock = hint("selfCollision.json", &[]).expect("the cloth shows its unlit side");
    assert!(stock.contains("material.two_sided=true") && stock.contains("move light.position"), "{stock}");
    assert_eq!(hint("selfCollision.json", &["material.two_sided=true"]), None);
    assert_eq!(hint("sphere.json", &[]), None);
    let below = ["light.position=[0.5,3,0.5]", "camera.polar=179"];
    let seen_below = hint("sphere.json", &[&below[..], &["material.two_sided=true"]].concat()).unwrap();
    let lit_behind = hint("sphere.json", &["cloth=null", "light.position=[0.5,0.5,-5]"]).unwrap();
    for hint in [seen_below, lit_behind] {
        assert!(!hint.contains("two_sided") && hint.ends_with(": move light.position"), "{hint}");
    }
}

#[test]
fn a_table_has_a_row_a_frame_whose_entries_sum_to_the_change_of_energy() {
    let scratch = Scratch::new();
    let arguments = ["simulate", "small.json", "--frames", "40", "--csv", "out.csv", "--json"];
    let summary = scratch.json(&arguments);
    let text = String::from_utf8(scratch.read("out.csv")).unwrap();
    let mut lines = text.lines();
    let names: Vec<&str> = lines.next().unwrap().split(',').collect();
    let rows: Vec<Vec<f64>> =
        lines.map(|line| line.split(',').map(|field| field.parse().unwrap()).collect()).collect();
    assert_eq!((names.len(), rows.len()), (16, 41), "frames 0 to 40");
    let column = |name: &str| names.iter().position(|&n| n == name).unwrap();
    for (frame, pair) in rows.windows(2).enumerate() {
        let put_in: f64 = pair[1][column("by_gravity")..=column("by_stretch_limit")].iter().sum();
        let change = pair[1][column("total")] - pair[0][column("total")];
        assert!((put_in - change).abs() < 1e-8, "frame {}: {put_in} J, not {change} J", frame + 1);
        assert!(pair[1][column("largest_speed")] > 0.0 && pair[1][column("smallest_distance")] > 0.1);
        assert!((pair[1][column("time")] - (frame + 1) as f64 / 90.0).abs() < 1e-12);
    }
    assert!(rows.iter().any(|row| row[column("by_stretch_limit")] != 0.0), "the limit takes part");
    let damping: f64 = rows.iter().map(|row| row[column("by_damping")]).sum();
    assert!((summary["ledger"]["damping"].as_f64().unwrap() - damping).abs() < 1e-8 * damping.abs());
    assert_eq!(summary["energy"]["kinetic"].as_f64().unwrap(), rows[40][column("kinetic")]);
}

/// A run that blows up on the way leaves the table of its good frames, and nothing else.
#[test]
fn a_run_that_fails_leaves_its_table_up_to_the_last_good_frame() {
    let scratch = Scratch::new();
    let unstable = ["--set", "sim.steps_per_frame=1", "--set", "sim.stretch_limit=null", "--allow-unstable"];
    let outputs = ["--csv", "out.csv", "--positions", "out", "--json", "--set", "cloth.density=25"];
    let run =
        scratch.run(&[&["simulate", "small.json", "--frames", "2000"], &unstable[..], &outputs].concat());
    assert_eq!(run.code, Some(5), "{}", run.stderr);
    let message = run.error()["error"].as_str().unwrap().to_owned();
    let last_good: usize = message.rsplit(' ').next().unwrap().parse().unwrap();
    let text = String::from_utf8(scratch.read("out.csv")).unwrap();
    assert!(last_good > 10 && text.lines().count() == last_good + 2, "a header, frames 0 to {last_good}");
    assert!(text.lines().all(|line| line.split(',').count() == 16) && text.ends_with('\n'), "whole rows");
    assert!(!scratch.path("out").exists() && run.stdout.is_empty(), "nothing else is written");

    let moving = ["simulate", "small.json", "--until-rest", "--frames", "3", "--csv", "moving.csv"];
    assert_eq!(scratch.run(&moving).code, Some(1));
    assert_eq!(String::from_utf8(scratch.read("moving.csv")).unwrap().lines().count(), 5);
    let refused = ["simulate", "small.json", "--set", "cloth.ks=1e12", "--csv", "refused.csv"];
    assert_eq!(scratch.run(&refused).code, Some(5));
    assert!(!scratch.path("refused.csv").exists(), "no frame, no table");
}

/// The summary has a ledger if it was asked for, or if one was kept because the cloth may blow up.
#[test]
fn the_summary_tells_what_each_phase_put_in_when_asked() {
    let scratch = Scratch::new();
    let run = |more: &[&str]| {
        scratch.json(&[&["simulate", "small.json", "--frames", "40", "--json"], more].concat())
    };
    let (plain, asked) = (run(&[]), run(&["--ledger"]));
    assert!(plain.get("ledger").is_none(), "{plain}");
    assert!(asked["ledger"]["damping"].as_f64().unwrap() < -1.0, "{asked}");
    assert_eq!(plain["state_hash"], asked["state_hash"], "it moves as without");
    let text = String::from_utf8(scratch.succeed(&["simulate", "small.json", "--frames", "40", "--ledger"]))
        .unwrap();
    assert!(text.contains("by damping"), "{text}");
    // Stable at rest, perhaps not when deformed.
    let doubtful = ["--set", "cloth.ks=2.2e7", "--frames", "1"];
    let kept = scratch.json(&[&["simulate", "small.json", "--json"], &doubtful[..]].concat());
    assert!(kept.get("ledger").is_some(), "{kept}");
}

/// Rest ends a run early; a limit that is too short is exit code 1 with what still moves.
#[test]
fn until_rest_ends_at_rest_or_says_what_still_moves() {
    let scratch = Scratch::new();
    let damped = ["--set", "cloth.damping=1", "--until-rest"];
    let run = scratch.json(&[&["simulate", "small.json", "--json"], &damped[..]].concat());
    let frames = run["frames"].as_u64().unwrap();
    assert!((90..5400).contains(&frames), "{frames} frames");
    assert!(run["energy"]["kinetic"].as_f64().unwrap() < 1e-4, "{run}");

    let limit = |frames: u64| {
        let frames = frames.to_string();
        scratch.run(&[&["simulate", "small.json", "--json", "--frames", &frames], &damped[..]].concat())
    };
    assert_eq!(limit(frames).object()["frames"], frames, "the limit may be the frame itself");
    let early = limit(frames - 1);
    assert_eq!(early.code, Some(1), "{}", early.stderr);
    assert_eq!(early.object()["frames"], frames - 1, "what was found is there");
    let message = early.error()["error"].as_str().unwrap().to_owned();
    assert!(message.contains(&format!("not at rest after {} frames", frames - 1)), "{message}");
    assert!(message.contains("residual force"), "{message}");

    let early = scratch.run(&["render", "small.json", "out.png", "--until-rest", "--time", "0.1"]);
    assert_eq!(early.code, Some(1), "{}", early.stderr);
    assert!(scratch.path("out.png").exists(), "the picture shows where it is by then");
    let picture = ["render", "small.json", "out.png", "--size", "16x16"];
    scratch.succeed(&[&picture, &damped[..]].concat());
    let at = ["--set", "cloth.damping=1", "--frame", &frames.to_string()];
    scratch.succeed(&[&["render", "small.json", "at.png", "--size", "16x16"], &at[..]].concat());
    assert_eq!(scratch.read("out.png"), scratch.read("at.png"), "the picture at rest");
}
