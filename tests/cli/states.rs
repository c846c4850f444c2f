//! States on the command line: what goes on from a file has the bytes of what never stopped.

use std::fs;

use crate::scratch::Scratch;

/// What a cloth with a memory of its own needs.
const BDF2: [&str; 2] = ["--set", "sim.integrator=bdf2"];

fn with<'a>(words: &[&'a str]) -> Vec<&'a str> {
    [words, &BDF2[..]].concat()
}

#[test]
fn every_command_goes_on_from_a_state() {
    let scratch = Scratch::new();
    scratch.succeed(&with(&["simulate", "small.json", "--frames", "7", "--save-state", "seven"]));
    let from = ["--from-state", "seven"];

    let whole = scratch.succeed(&with(&[
        "simulate",
        "small.json",
        "--frames",
        "20",
        "--positions",
        "a",
        "--save-state",
        "x",
    ]));
    let words = ["simulate", "small.json", "--frames", "20", "--positions", "b", "--save-state", "y"];
    let second = scratch.succeed(&[&with(&words)[..], &from].concat());
    assert_eq!(second, whole, "the summary, counters too");
    assert!(scratch.read("a") == scratch.read("b") && scratch.read("x") == scratch.read("y"));

    let size = ["--size", "40x30", "-q"];
    for (name, words) in [
        ("png", vec!["render", "small.json", "OUT.png", "--frame", "12", "--samples", "4"]),
        ("obj", vec!["export", "small.json", "OUT.obj", "--frame", "12"]),
        ("apng", vec!["animate", "small.json", "OUT.apng", "--frames", "9..14"]),
    ] {
        let picture: &[&str] = if name == "obj" { &["-q"] } else { &size };
        let [a, b] = [("first", &[][..]), ("second", &from[..])].map(|(file, from)| {
            let file = format!("{file}.{name}");
            let words: Vec<&str> = with(&words)
                .into_iter()
                .map(|word| if word.starts_with("OUT") { &file } else { word })
                .collect();
            scratch.succeed(&[&words[..], picture, from].concat());
            scratch.read(&file)
        });
        assert!(a == b, "{name}");
    }
    let rest =
        ["simulate", "small.json", "--until-rest", "--set", "cloth.damping=5", "--save-state", "r", "--json"];
    let rest = |more: &[&str]| scratch.json(&[&rest[..], more].concat());
    let whole = rest(&[]);
    // A state knows for how long the cloth has been quiet.
    let frames = whole["frames"].as_u64().unwrap();
    let damped = ["--set", "cloth.damping=5", "--save-state", "m"];
    for before in [1, 20, 60] {
        let last = (frames - before).to_string();
        scratch.succeed(&[&["simulate", "small.json", "--frames", &last], &damped[..]].concat());
        assert_eq!(rest(&["--from-state", "m"]), whole, "from {before} frames before the end");
    }
    // A picture is not watched for rest: its state does not know what the state that it came from knew.
    let [before, frame] = [frames - 5, frames].map(|frame| frame.to_string());
    let render = ["render", "small.json", "p.png", "--frame", &frame, "--set", "cloth.damping=5", "-q"];
    scratch.succeed(&[&render[..], &["--save-state", "far"]].concat());
    scratch.succeed(&[&["simulate", "small.json", "--frames", &before], &damped[..]].concat());
    scratch.succeed(&[&render[..], &["--from-state", "m", "--save-state", "near"]].concat());
    assert!(scratch.read("far") == scratch.read("near"));
}

#[test]
fn a_run_that_is_killed_goes_on_from_its_checkpoint() {
    let scratch = Scratch::new();
    let words = ["simulate", "small.json", "--save-state", "state", "--checkpoint", "0.02", "--frames"];
    let mut run = scratch.command(&[&words[..], &["100000000", "-q"]].concat()).spawn().unwrap();
    while !scratch.path("state").exists() {
        std::thread::sleep(std::time::Duration::from_millis(5));
    }
    std::thread::sleep(std::time::Duration::from_millis(100));
    run.kill().unwrap();
    run.wait().unwrap();
    let line = scratch.read("state").split(|&byte| byte == b'\n').next().unwrap().to_vec();
    let header: serde_json::Value = serde_json::from_slice(&line).unwrap();
    let frames = (header["frame"].as_u64().unwrap() + 10).to_string();
    let second = scratch.succeed(&[&words[..], &[&frames, "--from-state", "state"]].concat());
    assert_eq!(second, scratch.succeed(&["simulate", "small.json", "--frames", &frames]));
}

#[test]
fn the_parts_of_an_animation_are_the_whole() {
    let scratch = Scratch::new();
    let words =
        |out: &'static str| ["animate", "small.json", out, "--frames", "0..11", "--size", "24x20", "-q"];
    fs::create_dir(scratch.path("whole")).unwrap();
    fs::create_dir(scratch.path("parts")).unwrap();
    scratch.succeed(&words("whole/%04d.png"));
    scratch.succeed(&["simulate", "small.json", "--frames", "7", "--save-state", "seven"]);
    scratch.succeed(&[&words("parts/%04d.png")[..], &["--part", "3/3", "--from-state", "seven"]].concat());
    for part in ["2/3", "1/3"] {
        scratch.succeed(&[&words("parts/%04d.png")[..], &["--part", part]].concat());
    }
    for number in 0..11 {
        let [whole, parts] =
            ["whole", "parts"].map(|folder| scratch.read(&format!("{folder}/{number:04}.png")));
        assert!(whole == parts, "picture {number}");
    }
    let late =
        scratch.run(&[&words("late%04d.png")[..], &["--part", "1/3", "--from-state", "seven"]].concat());
    assert_eq!(late.code, Some(2));
    assert!(
        late.stderr.contains("the state is at frame 7, after frame 0, which is asked for"),
        "{}",
        late.stderr
    );
    let one = scratch.run(&[&words("one.apng")[..], &["--part", "1/3"]].concat());
    assert_eq!(one.code, Some(2), "{}", one.stderr);
}

#[test]
fn a_state_that_does_not_fit_is_refused() {
    let scratch = Scratch::new();
    scratch.succeed(&["simulate", "small.json", "--frames", "3", "--save-state", "three"]);
    let run = |more: &[&str]| {
        let run = scratch.run(&[&["simulate", "small.json", "--frames", "9", "--from-state"], more].concat());
        (run.code, run.stderr)
    };
    let (code, message) = run(&["three", "--set", "cloth.ks=400", "--set", "sim.fps=60"]);
    assert_eq!(code, Some(3));
    assert!(
        message.contains("`cloth.ks` is 5000 in the state and 400 in the scene; `sim.fps` is 90"),
        "{message}"
    );
    let (code, message) = run(&["small.json"]);
    assert_eq!((code, message.contains("small.json: this is no state file")), (Some(6), true), "{message}");
    let (code, message) = run(&["none"]);
    assert_eq!((code, message.contains("cannot read none")), (Some(6), true), "{message}");
    let (code, _) = run(&["three", "--checkpoint", "3"]);
    assert_eq!(code, Some(2), "there is no file to save to");
    assert_eq!(run(&["three", "--save-state", "three"]).0, Some(0), "a run may save to where it came from");
}
