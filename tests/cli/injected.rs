//! Every single write, sync, rename and creation of a file that a command makes is made to fail once: the command ends
//! with exit code 6, each file is the old one or the whole new one, no temporary file stays, and the next run succeeds.
//!
//! The faults are injected by `strace`, between the program and the system; where it is missing or may not trace, this
//! is said, unless `DRAPE_REQUIRE_STRACE` is set.
#![cfg(target_os = "linux")]

use std::collections::BTreeMap;
use std::fs;
use std::process::{Command, Output};

use crate::scratch::Scratch;

/// The calls that fail, and how.
const FAULTS: [(&str, &str); 4] = [
    ("write,pwrite64,writev", "ENOSPC"),
    ("fsync,fdatasync", "EIO"),
    ("rename,renameat,renameat2", "EACCES"),
    ("mkdir,mkdirat", "EACCES"),
];

/// What was there before, in place of an output.
const OLD: &[u8] = b"old";

/// A command and the files that it writes besides a folder `out`.
const COMMANDS: [(&str, &[&str]); 13] = [
    (
        "render small.json a.png --depth a.depth --ids a.ids --frame 1 --size 16x16",
        &["a.png", "a.depth", "a.ids"],
    ),
    ("render small.json a.png --frame 1 --size 16x16 --save-state a.state --json", &["a.png", "a.state"]),
    ("animate small.json out/%d.png --frames 0..3 --size 16x16", &[]),
    ("animate small.json a.apng --frames 0..3 --size 16x16", &["a.apng"]),
    ("animate small.json a.gif --frames 0..3 --size 16x16 --fps 50", &["a.gif"]),
    ("simulate small.json --frames 2 --positions a.npy --csv a.csv", &["a.npy", "a.csv"]),
    ("simulate small.json --frames 3 --positions out/%d.bin", &[]),
    ("export small.json a.obj --objects --materials --frame 1", &["a.obj", "a.mtl"]),
    ("export small.json a.glb --frames 0..3", &["a.glb"]),
    ("compare one.png two.png --diff a.png --html a.html", &["a.png", "a.html"]),
    ("horizon small.json a.html --frame 2", &["a.html"]),
    ("sweep run spec.json out", &[]),
    ("gallery out --only part1-all", &[]),
];

/// A folder in which the command can run, with old outputs.
fn prepared(outputs: &[&str]) -> Scratch {
    let scratch = Scratch::new();
    let spec = r#"{"scene": "small.json", "set": {"cloth.ks": [100, 200]}, "frames": 1, "measure": ["hash"],
        "render": {"size": [8, 8]}}"#;
    fs::write(scratch.path("spec.json"), spec).unwrap();
    for (name, background) in [("one.png", "0"), ("two.png", "1")] {
        let set = format!("render.background=[{background},0,0]");
        scratch.succeed(&[
            "render",
            "small.json",
            name,
            "--frame",
            "0",
            "--size",
            "8x8",
            "-q",
            "--set",
            &set,
        ]);
    }
    outputs.iter().for_each(|name| fs::write(scratch.path(name), OLD).unwrap());
    scratch
}

/// Runs the command under `strace` with `options`.
fn traced(scratch: &Scratch, options: &[&str], arguments: &str) -> Output {
    let mut command = Command::new("strace");
    command.args(["-f", "-qq", "-o", "trace"]).args(options);
    command.arg(assert_cmd::cargo::cargo_bin!("drape")).args(arguments.split(' ')).args(["--threads", "1"]);
    command.current_dir(scratch.path("")).output().expect("strace starts")
}

/// How often a thread of the command makes one of `calls`, at most.
fn count(arguments: &str, outputs: &[&str], calls: &str) -> usize {
    let scratch = prepared(outputs);
    traced(&scratch, &["-e", &format!("trace={calls}")], arguments);
    let trace = fs::read_to_string(scratch.path("trace")).unwrap();
    let mut counts = BTreeMap::new();
    for line in trace.lines().filter(|line| line.contains('(') && !line.contains("resumed>")) {
        *counts.entry(line.split(' ').next().unwrap().to_owned()).or_insert(0) += 1;
    }
    counts.into_values().max().unwrap_or(0)
}

fn can_trace() -> bool {
    let traces = Command::new("strace").args(["-qq", "-o", "/dev/null", "true"]).status();
    let can = traces.is_ok_and(|status| status.success());
    assert!(can || std::env::var_os("DRAPE_REQUIRE_STRACE").is_none(), "strace is missing or may not trace");
    can
}

/// The exit code of the command where nothing fails: the pictures that are compared differ.
fn done(arguments: &str) -> i32 {
    i32::from(arguments.starts_with("compare"))
}

/// The command with its k-th call of a kind failing. Returns whether it failed.
fn faulted(arguments: &str, outputs: &[&str], fault: [&str; 2], right: &BTreeMap<String, Vec<u8>>) -> bool {
    let scratch = prepared(outputs);
    let [calls, how] = fault;
    let trace = format!("trace={calls}");
    let output = traced(&scratch, &["-e", &trace, "-e", &format!("inject={calls}:{how}")], arguments);
    let message = String::from_utf8_lossy(&output.stderr);
    fs::remove_file(scratch.path("trace")).unwrap();
    let found = scratch.tree("");
    let what = format!("{arguments}: {fault:?}: {message}");
    for (name, bytes) in &found {
        let old = outputs.contains(&name.as_str()) && bytes == OLD;
        let hint = name.contains("claims/");
        assert!(old || hint || Some(bytes) == right.get(name), "{what}: {name}");
    }
    match output.status.code() {
        Some(code) if code == done(arguments) => assert_eq!(&found, right, "{what}"),
        Some(6) => {
            assert!(message.is_empty() || message.contains("error"), "{what}");
            // It is repeated where it has stopped.
            let words: Vec<&str> = arguments.split(' ').collect();
            let again = scratch.run(&[&words[..], &["-q"]].concat());
            assert_eq!(again.code, Some(done(arguments)), "{what}: {}", again.stderr);
            assert_eq!(&scratch.tree(""), right, "{what}");
        }
        code => panic!("{what}: {code:?}"),
    }
    output.status.code() == Some(6)
}

#[test]
fn every_call_that_fails_is_reported_and_no_file_is_torn() {
    if !can_trace() {
        return;
    }
    let (mut tried, mut unnoticed) = (0, Vec::new());
    for (arguments, outputs) in COMMANDS {
        let scratch = prepared(outputs);
        let words: Vec<&str> = arguments.split(' ').collect();
        let run = scratch.run(&[&words[..], &["-q"]].concat());
        assert_eq!(run.code, Some(done(arguments)), "{arguments}: {}", run.stderr);
        let right = scratch.tree("");
        for (calls, error) in FAULTS {
            for k in 1..=count(arguments, outputs, calls) {
                tried += 1;
                let failed = faulted(arguments, outputs, [calls, &format!("error={error}:when={k}")], &right);
                unnoticed.extend((!failed).then_some(calls));
            }
        }
    }
    println!("{tried} faults injected, {} of them failed the command", tried - unnoticed.len());
    // What cannot be written is the last message on standard error, and nothing else may go unnoticed.
    let [(writes, _), ..] = FAULTS;
    assert!(unnoticed.iter().all(|&calls| calls == writes), "{unnoticed:?}");
    assert!(unnoticed.len() <= COMMANDS.len() + 3, "{unnoticed:?}");
    assert!(tried >= 10 * COMMANDS.len(), "{tried}");
}
