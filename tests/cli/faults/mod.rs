//! Every check is seen to fail: `faults.json` lists faults, each as an expression in a function or
//! constant and what stands there instead, with the one test that must catch it. Run all of them with `cargo test --release --test cli faults -- --ignored`,
//! or those whose name contains a word with the variable `FAULT`.

#![expect(clippy::unwrap_used, reason = "a helper that fails is a test that fails")]

mod patch;

use std::{
    fs,
    path::{Path, PathBuf},
    process::Command,
};

use serde::Deserialize;

/// A change of one place in the sources, and who must notice.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Fault {
    /// What is wrong, in words.
    fault: String,
    /// The name of the function, constant or GLSL file that is changed.
    item: String,
    /// An expression or statement that stands in one item of this name exactly once.
    old: String,
    /// What stands there instead.
    new: String,
    /// `target::test`: one of the test binaries `engine`, `lab`, `cli` and `step_cost`, or the unit tests of a
    /// crate, `engine-unit` and so on, and the path of the test in it.
    caught_by: String,
}

/// What the tests need of the package.
const PARTS: [&str; 16] = [
    "Cargo.toml",
    "Cargo.lock",
    "README.md",
    "src",
    "lab",
    "cli",
    "web",
    "examples",
    "tests",
    "benches",
    "scenes",
    "textures",
    "docs",
    "golden",
    "fuzz/bodies",
    "fuzz/corpus",
];

fn package() -> PathBuf {
    crate::repository::path("")
}

fn faults() -> Vec<Fault> {
    serde_json::from_str(&fs::read_to_string(package().join("tests/cli/faults/faults.json")).unwrap())
        .unwrap()
}

#[test]
fn every_fault_has_its_place_and_its_test() {
    let wrong: Vec<String> = faults().iter().filter_map(|fault| place(fault).err()).collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    for Fault { fault, old, new, caught_by, .. } in faults() {
        assert_ne!(old, new, "{fault}");
        let (path, test) = caught_by.rsplit_once("::").unwrap();
        let path = path.trim_end_matches("::tests").replace("::", "/");
        let path = match path.split_once("-unit/") {
            Some(("engine", module)) => format!("src/{module}"),
            Some((package, module)) => format!("{package}/src/{module}"),
            None => format!("tests/{path}"),
        };
        let files =
            ["", "/mod", "/tests"].map(|end| format!("{path}{end}.rs")).map(|file| package().join(file));
        let declares =
            |file: &PathBuf| fs::read_to_string(file).is_ok_and(|text| text.contains(&format!("fn {test}(")));
        assert!(files.iter().any(declares), "{caught_by}");
    }
}

/// Where the fault is put.
fn place(Fault { fault, item, old, .. }: &Fault) -> Result<patch::Place, String> {
    patch::find(&package(), item, old).map_err(|e| format!("{fault}: {e}"))
}

#[test]
#[ignore = "compiles the library once a fault"]
fn every_fault_is_caught() {
    let wanted = std::env::var("FAULT").unwrap_or_default();
    let faults: Vec<Fault> = faults().into_iter().filter(|f| f.fault.contains(&wanted)).collect();
    let copy = package().join("target/faults/package");
    let copied = |fault: Option<&Fault>| {
        let change = fault.map(|fault| (place(fault).unwrap(), &*fault.new));
        PARTS.iter().for_each(|part| copy_changed(Path::new(part), &copy, change.as_ref()));
    };
    copied(None);
    for Fault { caught_by, .. } in &faults {
        let (passed, output) = run(&copy, caught_by);
        assert!(passed && output.contains(" 1 passed;"), "{caught_by} without a fault:\n{output}");
    }
    let mut missed = Vec::new();
    for fault in &faults {
        copied(Some(fault));
        let (passed, output) = run(&copy, &fault.caught_by);
        let caught = !passed && output.contains("test result: FAILED. 0 passed; 1 failed;");
        println!("{} {}: {}", if caught { "caught" } else { "MISSED" }, fault.fault, fault.caught_by);
        if !caught {
            missed.push(format!("{}: {}\n{output}", fault.fault, fault.caught_by));
        }
    }
    copied(None);
    assert!(missed.is_empty(), "missed:\n{}", missed.join("\n"));
}

#[test]
fn every_package_is_a_part() {
    let manifest = fs::read_to_string(package().join("Cargo.toml")).unwrap();
    let members = manifest.lines().find(|line| line.starts_with("members")).unwrap();
    let folders: Vec<&str> = members.split('"').skip(1).step_by(2).collect();
    assert!(folders.len() > 2, "{members}");
    for folder in folders {
        assert!(PARTS.contains(&folder.split('/').next().unwrap()), "{folder} is not copied");
    }
}

/// Copies a file or folder of the package, with the fault applied; writes only what changes, so
/// that only that is compiled again.
fn copy_changed(path: &Path, copy: &Path, change: Option<&(patch::Place, &str)>) {
    let (from, to) = (package().join(path), copy.join(path));
    if from.is_dir() {
        let mut entries: Vec<PathBuf> =
            fs::read_dir(from).unwrap().map(|entry| path.join(entry.unwrap().file_name())).collect();
        entries.sort();
        entries.iter().for_each(|entry| copy_changed(entry, copy, change));
        let gone = |file: &PathBuf| !package().join(path).join(file.file_name().unwrap()).exists();
        let copied = fs::read_dir(to).into_iter().flatten().map(|entry| entry.unwrap().path());
        copied
            .filter(gone)
            .for_each(|file| fs::remove_file(&file).or_else(|_| fs::remove_dir_all(file)).unwrap());
        return;
    }
    let mut bytes = fs::read(from).unwrap();
    if let Some((place, new)) = change.filter(|(place, _)| place.file == path) {
        bytes = place.replaced(&String::from_utf8(bytes).unwrap(), new).into_bytes();
    }
    if fs::read(&to).ok().as_ref() != Some(&bytes) {
        fs::create_dir_all(to.parent().unwrap()).unwrap();
        fs::write(to, bytes).unwrap();
    }
}

/// Runs one test of the copy: whether it passed, and what it said. The profile is the quickest to
/// compile that still runs fast.
fn run(copy: &Path, caught_by: &str) -> (bool, String) {
    let (target, test) = caught_by.split_once("::").unwrap();
    let target = match target {
        "engine-unit" => ["--package", "drape", "--lib"].to_vec(),
        "lab-unit" => ["--package", "drape-lab", "--lib"].to_vec(),
        "cli-unit" => ["--package", "drape-cli", "--lib"].to_vec(),
        test => ["--test", test].to_vec(),
    };
    let output = Command::new(env!("CARGO"))
        .arg("test")
        .args(target)
        .args([test, "--", "--exact"])
        .current_dir(copy)
        .env("CARGO_TARGET_DIR", copy.with_file_name("build"))
        .env("CARGO_INCREMENTAL", "1")
        .env("CARGO_PROFILE_DEV_DEBUG", "0")
        .env("RUST_BACKTRACE", "0")
        .env("DRAPE_REQUIRE_GL", "1")
        .env("DRAPE_REQUIRE_BROWSER", "1")
        .output()
        .unwrap();
    let text = [output.stdout, output.stderr].concat();
    (output.status.success(), String::from_utf8_lossy(&text).into_owned())
}
