//! No dependency declares that it needs a newer Rust than this project does.

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
