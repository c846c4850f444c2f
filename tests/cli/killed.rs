//! Runs that are killed at random moments go on from their checkpoints, and leave the bytes of a run that never stopped.

use std::fs;
use std::time::Duration;

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

/// The names and the bytes of the files in a folder, without those that were being written when a run was killed.
fn files(scratch: &Scratch, folder: &str) -> Vec<(String, Vec<u8>)> {
    let entries = fs::read_dir(scratch.path(folder)).unwrap().map(|entry| entry.unwrap());
    let mut files: Vec<_> = entries
        .map(|entry| (entry.file_name().into_string().unwrap(), fs::read(entry.path()).unwrap()))
        .filter(|(name, _)| !name.starts_with(".drape-"))
        .collect();
    files.sort();
    files
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
    let [whole, parts] = ["whole", "parts"].map(|folder| files(&scratch, folder));
    assert_eq!(whole.len(), parts.len(), "{words:?}");
    for (whole, parts) in whole.iter().zip(&parts) {
        assert!(whole == parts, "{words:?}: {} and {}", whole.0, parts.0);
    }
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
