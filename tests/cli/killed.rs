//! Runs that are killed at random moments go on from their checkpoints, and leave the bytes of a run that never stopped.

use std::fs;
use std::process::Stdio;
use std::time::{Duration, Instant};

use drape::math::splitmix64;

use crate::scratch::Scratch;

/// Runs `words` until they are through; before that they are killed again and again, later from time to time. Returns
/// what the last run printed, and how often runs were killed after they had saved a state.
fn killed(scratch: &Scratch, words: &[&str]) -> (String, u64) {
    let (mut rounds, mut kills) = (0, 0);
    loop {
        let state = scratch.path("state").exists();
        let from: &[&str] = if state { &["--from-state", "state"] } else { &[] };
        let saving = ["--save-state", "state", "--checkpoint", "0.005"];
        let mut command = scratch.command(&[words, &saving, from].concat());
        command.stdout(fs::File::create(scratch.path("printed")).unwrap());
        command.stderr(fs::File::create(scratch.path("said")).unwrap());
        let mut run = command.spawn().unwrap();
        std::thread::sleep(Duration::from_millis(splitmix64(rounds) % (10 * (rounds + 2))));
        run.kill().unwrap();
        let status = run.wait().unwrap();
        if let Some(code) = status.code() {
            assert_eq!(code, 0, "{words:?}: {}", String::from_utf8_lossy(&scratch.read("said")));
            return (String::from_utf8(scratch.read("printed")).unwrap(), kills);
        }
        rounds += 1;
        kills += u64::from(scratch.path("state").exists());
    }
}

/// Checks that `words`, which write into the folder OUT, give the same whether they are killed or not.
fn check(words: &[&str]) {
    let scratch = Scratch::new();
    let within = |folder: &str| -> Vec<String> {
        fs::create_dir(scratch.path(folder)).unwrap();
        words.iter().map(|word| word.replace("OUT", folder)).collect()
    };
    let [whole, parts] = ["whole", "parts"].map(within);
    let [whole, parts] = [&whole, &parts].map(|words| words.iter().map(String::as_str).collect::<Vec<_>>());
    let expected = scratch.succeed(&[&whole[..], &["--save-state", "end"]].concat());
    let (printed, kills) = killed(&scratch, &parts);
    assert!(kills > 1, "{words:?}: killed {kills} times");
    assert_eq!(printed, String::from_utf8(expected).unwrap(), "{words:?}");
    assert!(scratch.read("state") == scratch.read("end"), "{words:?}");
    // What was being written when a run was killed, the next has removed.
    let [whole, parts] = ["whole", "parts"].map(|folder| scratch.tree(folder));
    assert_eq!(whole.keys().collect::<Vec<_>>(), parts.keys().collect::<Vec<_>>(), "{words:?}");
    assert!(whole == parts, "{words:?}: other bytes");
}

/// A cloth that takes a while.
const SETS: [&str; 4] = ["--set", "cloth.damping=2", "--set", "sim.steps_per_frame=200"];

#[test]
fn a_simulation_that_is_killed_goes_on() {
    let words = ["simulate", "small.json", "--frames", "900", "--positions", "OUT/%04d.npy", "--every", "90"];
    check(&[&words[..], &SETS].concat());
    let words = ["simulate", "small.json", "--frames", "900", "--positions", "OUT/end.npy", "--set"];
    check(&[&words[..], &["sim.integrator=bdf2"]].concat());
}

#[test]
fn a_run_until_rest_that_is_killed_rests_at_the_same_frame() {
    let words = ["simulate", "small.json", "--until-rest", "--positions", "OUT/end.bin"];
    check(&[&words[..], &["--set", "cloth.damping=0.75", "--set", "sim.steps_per_frame=200"]].concat());
}

#[test]
fn a_picture_and_a_mesh_of_a_run_that_is_killed_are_the_same() {
    for words in [
        ["render", "small.json", "OUT/end.png", "--frame", "900", "--size", "40x30"],
        ["export", "small.json", "OUT/end.obj", "--frame", "900", "--set", "cloth.ks=400"],
    ] {
        check(&[&words[..], &SETS].concat());
    }
}

/// Drawing takes longer than simulating, which is ahead by some pictures when the run is killed.
#[test]
fn an_animation_that_is_killed_goes_on_behind_the_pictures_that_are_there() {
    let size = ["--size", "640x480", "--samples", "16", "--shader", "phong"];
    check(&[&["animate", "small.json", "OUT/%04d.png", "--frames", "0..40"], &size[..]].concat());
}

/// Commands that write into the folder `out`, on which they go on.
const LONG: [&str; 8] = [
    "animate small.json out/%04d.png --frames 0..60 --size 320x240",
    "animate small.json out/a.apng --frames 0..60 --size 320x240",
    "animate small.json out/a.gif --frames 0..60 --size 320x240 --fps 50",
    "simulate small.json --frames 200 --positions out/%04d.npy",
    "export small.json out/a.glb --frames 0..90",
    "sweep run spec.json out",
    "stability small.json out --quick --part 1/200",
    "gallery out --only part1",
];

/// A folder in which each of [`LONG`] can run.
fn prepared() -> Scratch {
    let scratch = Scratch::new();
    let spec = r#"{"scene": "small.json", "set": {"cloth.ks": {"from": 100, "to": 200, "count": 60}}, "frames": 5,
        "measure": ["hash"], "render": {"size": [32, 24]}}"#;
    fs::write(scratch.path("spec.json"), spec).unwrap();
    fs::create_dir(scratch.path("out")).unwrap();
    scratch
}

/// Whether a file may be there or not: one that was being written, and a worker's note of what it has begun.
fn is_passing(name: &str) -> bool {
    name.contains(".drape-") || name.starts_with("cells/claims/") || name.starts_with("claims/")
}

#[test]
#[ignore = "takes minutes"]
fn two_hundred_kills_tear_no_file() {
    let mut kills = 0;
    for (number, arguments) in LONG.into_iter().enumerate() {
        let words: Vec<&str> = arguments.split(' ').chain(["-q"]).collect();
        let started = Instant::now();
        let whole = prepared();
        whole.succeed(&words);
        let longest = started.elapsed().as_millis().max(20) as u64;
        let right = whole.tree("out");
        let scratch = prepared();
        for round in 0..25 {
            let mut run =
                scratch.command(&words).stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
            let moment = splitmix64(1000 * number as u64 + round) % longest;
            std::thread::sleep(Duration::from_millis(moment));
            run.kill().unwrap();
            kills += u64::from(run.wait().unwrap().code().is_none());
            for (name, bytes) in scratch.tree("out") {
                let known = is_passing(&name) || right.get(&name) == Some(&bytes);
                assert!(known, "{arguments}: {name} after {moment} ms");
            }
            // From time to time all begins anew.
            if round % 5 == 4 {
                scratch.succeed(&words);
                let mut done = scratch.tree("out");
                done.retain(|name, _| !name.contains("claims/"));
                let mut expected = right.clone();
                expected.retain(|name, _| !name.contains("claims/"));
                assert_eq!(
                    done.keys().collect::<Vec<_>>(),
                    expected.keys().collect::<Vec<_>>(),
                    "{arguments}"
                );
                assert!(done == expected, "{arguments}: other bytes");
                fs::remove_dir_all(scratch.path("out")).unwrap();
                fs::create_dir(scratch.path("out")).unwrap();
            }
        }
    }
    println!("{kills} runs were killed");
    assert!(kills > 100, "{kills}");
}

#[test]
fn two_runs_on_one_file_leave_the_file_of_one_of_them() {
    let scratch = Scratch::new();
    let words =
        |frame: &'static str| ["render", "small.json", "a.png", "--size", "64x48", "-q", "--frame", frame];
    let right = ["3", "4"].map(|frame| {
        scratch.succeed(&words(frame));
        scratch.read("a.png")
    });
    assert_ne!(right[0], right[1]);
    for _ in 0..20 {
        let runs = ["3", "4"].map(|frame| scratch.command(&words(frame)).spawn().unwrap());
        for mut run in runs {
            assert_eq!(run.wait().unwrap().code(), Some(0));
        }
        assert!(right.contains(&scratch.read("a.png")));
        assert_eq!(scratch.names(), ["a.png", "small.json"]);
    }
}
