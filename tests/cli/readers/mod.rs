//! What this program writes is read by other programs: Pillow, ffmpeg, trimesh, the Khronos glTF validator, and
//! Blender where it is there.
//!
//! `.ci/install-readers` installs them in `target/readers`. Without them a test says what it did not check; it fails
//! if `DRAPE_REQUIRE_READERS` is set. Blender (`bpy` from PyPI, 300 MB) is never required.

#![allow(clippy::print_stdout, reason = "a test says what it did not check, and what it measured")]

mod animations;
mod meshes;
mod pictures;
mod provenance;
mod recipes;

use std::path::PathBuf;
use std::process::Command;

use crate::repository;
use crate::scratch::Scratch;

/// Something that was not checked; a failure where everything is required.
fn not_checked(what: &str, why: &str) {
    println!("not checked: {what}: {why}");
    assert!(std::env::var_os("DRAPE_REQUIRE_READERS").is_none(), "{what}: {why}");
}

fn installed(path: &str) -> PathBuf {
    repository::path("target/readers").join(path)
}

/// What the Python program `tests/cli/readers/NAME.py` prints when it runs in the folder; nothing if Python has not the
/// modules that it needs.
fn python(scratch: &Scratch, name: &str, arguments: &[&str]) -> Option<serde_json::Value> {
    let script = repository::path("tests/cli/readers").join(format!("{name}.py"));
    let interpreter = installed("venv/bin/python");
    if !interpreter.exists() {
        not_checked(name, ".ci/install-readers has not run");
        return None;
    }
    let output = Command::new(interpreter)
        .arg(script)
        .args(arguments)
        .current_dir(scratch.path("."))
        .output()
        .expect("Python starts");
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(output.status.success(), "{name}: {}\n{text}", String::from_utf8_lossy(&output.stderr));
    let last = text.lines().last().expect("a result");
    Some(serde_json::from_str(last).unwrap_or_else(|e| panic!("{name}: {e}: {text}")))
}

/// What a program of the system prints; nothing if it is not there.
fn program(scratch: &Scratch, name: &str, arguments: &[&str]) -> Option<Vec<u8>> {
    let Ok(output) = Command::new(name).args(arguments).current_dir(scratch.path(".")).output() else {
        not_checked(name, "it is not installed");
        return None;
    };
    assert!(output.status.success(), "{name}: {}", String::from_utf8_lossy(&output.stderr));
    Some(output.stdout)
}
