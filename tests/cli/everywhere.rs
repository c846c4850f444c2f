//! The states and pictures of all stock scenes, integrators, contacts and shaders have the hashes of `everywhere.txt`,
//! which are those of every platform: `.ci/cross-isa` runs this test on the program of other builds and processors.

use std::fmt::Write;
use std::process::Command;

use drape::scene::Shader;
use rayon::prelude::*;

use crate::repository;
use crate::scratch::scene;

const FILE: &str = "tests/cli/everywhere.txt";

/// How the program is run, where it is not the one that was built for the tests: a command and its first arguments,
/// separated by spaces.
const RUN: &str = "DRAPE_RUN";

const SCENES: [&str; 6] = ["pinned2", "pinned4", "sphere", "plane", "selfCollision", "table"];

/// The frames whose states are kept, of the chain that `simulate --hash` prints.
const FRAMES: [usize; 8] = [0, 1, 2, 5, 10, 30, 60, 90];

/// What the program prints.
fn printed(arguments: &[&str]) -> String {
    let other = std::env::var(RUN).unwrap_or_default();
    let mut words = other.split_whitespace();
    let mut command = match words.next() {
        Some(program) => Command::new(program),
        None => Command::new(assert_cmd::cargo::cargo_bin!("drape")),
    };
    let output = command.args(words).args(arguments).arg("-q").output().expect("the program starts");
    assert!(output.status.success(), "{arguments:?}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).expect("text")
}

/// The hashes of the states of `FRAMES` up to the last that is asked for, a line each.
fn states(name: &str, last: usize, sets: &[&str]) -> String {
    let scene = scene(&format!("{name}.json"));
    let last_text = last.to_string();
    let sets_text: Vec<&str> = sets.iter().flat_map(|set| ["--set", set]).collect();
    let chain = printed(&[&["simulate", &scene, "--hash", "--frames", &last_text], &sets_text[..]].concat());
    let lines: Vec<&str> = chain.lines().collect();
    assert_eq!(lines.len(), last + 1, "{name}: a hash a frame");
    let mut text = String::new();
    for frame in FRAMES.into_iter().filter(|&frame| frame <= last) {
        writeln!(text, "state {} {}", [&[name], sets].concat().join(" "), lines[frame]).expect("a string");
    }
    text
}

/// The hash of the picture of a scene, a line.
fn picture(name: &str, options: &[&str]) -> String {
    let scene = scene(&format!("{name}.json"));
    let size = ["--frame", "10", "--size", "160x125", "--hash"];
    let hash = printed(&[&["render", &scene], options, &size].concat());
    format!("picture {} {hash}", [&[name], options].concat().join(" "))
}

/// Something that gives lines of hashes.
type Job = Box<dyn Fn() -> String + Sync + Send>;

fn jobs() -> Vec<Job> {
    let mut jobs: Vec<Job> = Vec::new();
    for name in SCENES {
        jobs.push(Box::new(move || states(name, 90, &[])));
        jobs.push(Box::new(move || {
            states(name, 30, &["sim.contact=\"coulomb\"", "sim.damping=\"per_second\""])
        }));
        for &(shader, _) in Shader::NAMES {
            jobs.push(Box::new(move || picture(name, &["--shader", shader])));
        }
    }
    for integrator in ["rk4", "xpbd", "implicit_euler", "bdf2"] {
        jobs.push(Box::new(move || states("sphere", 5, &[&format!("sim.integrator=\"{integrator}\"")])));
    }
    // Springs that are stiff for the step, so that multigrid preconditions it.
    for integrator in ["implicit_euler", "bdf2"] {
        let own = format!("sim.integrator=\"{integrator}\"");
        let stiff = move |own: &str| states("pinned2", 5, &[own, "sim.steps_per_frame=1", "cloth.ks=500000"]);
        jobs.push(Box::new(move || stiff(&own)));
    }
    for set in ["sim.precision=\"f32\"", "sim.start=\"half_step\"", "sim.self_collision=\"neighbors\""] {
        jobs.push(Box::new(move || states("pinned2", 10, &[set])));
    }
    for samples in ["4", "8", "16"] {
        jobs.push(Box::new(move || picture("sphere", &["--samples", samples])));
    }
    jobs
}

#[test]
fn states_and_pictures_have_the_hashes_of_every_platform() {
    let lines: Vec<String> = jobs().par_iter().map(|job| job()).collect();
    let actual = lines.concat();
    let file = repository::path(FILE);
    let expected = std::fs::read_to_string(&file).unwrap_or_default();
    if actual == expected {
        return;
    }
    if std::env::var_os("DRAPE_BLESS").is_some() && std::env::var_os("CI").is_none() {
        std::fs::write(&file, &actual).expect("the file of hashes");
        panic!("{FILE}: blessed; look at what has changed and run again without DRAPE_BLESS");
    }
    let changed: Vec<&str> = actual.lines().filter(|line| !expected.contains(line)).collect();
    panic!("{} of {} hashes differ from {FILE}: {changed:#?}", changed.len(), actual.lines().count());
}
