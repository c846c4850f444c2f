//! No dependency declares that it needs a newer Rust than this project does; each has its reason in
//! `docs/dependencies.md`; none of our crates has a build script.

use std::collections::BTreeSet;
use std::process::Command;

use serde_json::Value;

/// What `program` prints.
fn printed(program: &str, arguments: &[&str]) -> Vec<u8> {
    let top = crate::repository::path("");
    let output = Command::new(program).args(arguments).current_dir(top).output().unwrap();
    assert!(output.status.success(), "{program}: {}", String::from_utf8_lossy(&output.stderr));
    output.stdout
}

/// `1.89` and `1.89.0` as numbers; what is missing is 0.
fn version(text: &str) -> [u32; 3] {
    let mut numbers = text.split('.').map(|number| number.parse().unwrap());
    [(); 3].map(|()| numbers.next().unwrap_or(0))
}

/// The packages of this repository.
fn ours() -> Vec<Value> {
    let arguments = ["metadata", "--locked", "--format-version=1", "--no-deps"];
    let mut metadata: Value = serde_json::from_slice(&printed(env!("CARGO"), &arguments)).unwrap();
    serde_json::from_value(metadata["packages"].take()).unwrap()
}

#[test]
fn every_direct_dependency_has_its_reason() {
    let mut named = BTreeSet::new();
    for package in ours() {
        let dependencies = package["dependencies"].as_array().unwrap().iter();
        named.extend(dependencies.filter_map(|d| d["name"].as_str().map(str::to_owned)));
    }
    named.retain(|name| !name.starts_with("drape"));
    let page = std::fs::read_to_string(crate::repository::path("docs/dependencies.md")).unwrap();
    let rows = page.lines().filter_map(|line| line.strip_prefix("| ")?.split(" | ").next());
    let told: BTreeSet<String> = rows.skip(1).map(str::to_owned).collect();
    assert!(named.len() > 20, "{named:?}");
    assert_eq!(named, told, "the manifests and docs/dependencies.md");
}

#[test]
fn no_package_has_a_build_script() {
    let packages = ours();
    assert!(packages.len() >= 5, "{packages:?}");
    for package in &packages {
        let mut kinds =
            package["targets"].as_array().unwrap().iter().map(|target| target["kind"].to_string());
        assert!(kinds.all(|kind| !kind.contains("custom-build")), "{}", package["name"]);
    }
}

#[test]
fn no_dependency_declares_a_newer_rust() {
    let host = String::from_utf8(printed("rustc", &["--print", "host-tuple"])).unwrap();
    let arguments = ["metadata", "--locked", "--format-version=1", "--filter-platform", host.trim()];
    let metadata: Value = serde_json::from_slice(&printed(env!("CARGO"), &arguments)).unwrap();
    let packages: Vec<(&str, &str)> = metadata["packages"]
        .as_array()
        .unwrap()
        .iter()
        .filter_map(|package| Some((package["name"].as_str()?, package["rust_version"].as_str()?)))
        .collect();
    let ours = packages.iter().find(|(name, _)| *name == "drape").map(|(_, rust)| version(rust)).unwrap();
    assert!(packages.len() > 60, "few packages declare a version: {packages:?}");
    let newer: Vec<_> = packages.iter().filter(|(_, rust)| version(rust) > ours).collect();
    assert!(newer.is_empty(), "newer than {ours:?}: {newer:?}");
}

#[test]
fn versions_are_compared_as_numbers() {
    assert!(version("1.9") < version("1.89"), "not as text");
    assert_eq!(version("1.89"), version("1.89.0"));
}
