//! The GLSL files and the Rust beside them name the same things.

#![expect(clippy::unwrap_used, reason = "a helper that fails is a test that fails")]

use std::{fs, path::PathBuf};

fn folder() -> PathBuf {
    crate::repository::path("src/shader")
}

fn read(name: &str) -> String {
    fs::read_to_string(folder().join(name)).unwrap()
}

/// The words of a program without its comments.
fn words(text: &str) -> Vec<String> {
    let code = text.lines().map(|line| line.split("//").next().unwrap_or_default());
    code.flat_map(|line| line.split(|c: char| !c.is_alphanumeric() && c != '_').map(str::to_owned)).collect()
}

/// The words of a program's Rust, with those of the programs whose stages it takes over.
fn of_program(stem: &str) -> Vec<String> {
    let text = read(&format!("{stem}.rs"));
    let taken = text.lines().filter_map(|line| line.strip_prefix("pub use super::")?.split(':').next());
    taken.flat_map(of_program).chain(words(&text)).collect()
}

/// Every GLSL file: its name, its stem and its text.
fn programs() -> Vec<(String, String, String)> {
    let mut names: Vec<String> = fs::read_dir(folder())
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.retain(|name| name.ends_with(".vert") || name.ends_with(".frag"));
    names.sort();
    let stem = |name: &String| name.split('.').next().unwrap_or_default().to_owned();
    names.iter().map(|name| (name.clone(), stem(name), read(name))).collect()
}

#[test]
fn every_uniform_and_varying_of_the_glsl_is_named_in_the_rust() {
    let shared = [words(&read("mod.rs")), words(&read("default.rs"))].concat();
    let mut named = 0;
    for (file, stem, text) in programs() {
        let rust = [of_program(&stem), shared.clone()].concat();
        for line in text.lines() {
            let declared: Vec<&str> = line.trim_end_matches(';').split(' ').collect();
            let [kind @ ("uniform" | "in" | "out"), _, name] = declared[..] else { continue };
            // The colour is what the closure returns, and a sampler knows its size.
            let name = if name == "out_color" { "Vec3" } else { name.trim_end_matches("_size") };
            assert!(rust.iter().any(|word| word == name), "{kind} {name} of {file} is not in {stem}.rs");
            named += 1;
        }
    }
    assert!(named > 80, "only {named} declarations were found");
}

#[test]
fn every_function_of_the_glsl_is_in_the_rust() {
    let all: Vec<String> = fs::read_dir(folder())
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .filter(|name| name.ends_with(".rs"))
        .flat_map(|name| words(&read(&name)))
        .collect();
    let mut found = 0;
    for (file, _, text) in programs() {
        for line in text.lines().filter(|line| line.ends_with(") {") && !line.contains(" main(")) {
            let name = line.split('(').next().unwrap_or_default().split(' ').next_back().unwrap_or_default();
            assert!(all.iter().any(|word| word == name), "{name} of {file}");
            found += 1;
        }
    }
    assert!(found >= 8, "only {found} functions were found");
}

/// What a file says twice it says alike: `displacement.frag` is `bump.frag`, and so on.
#[test]
fn copies_are_copies() {
    assert_eq!(read("displacement.frag"), read("bump.frag"));
    assert_eq!(read("custom.vert"), read("displacement.vert"));
    let function = |file: &str, name: &str| {
        let text = read(file);
        let start = text.find(name).unwrap();
        text[start..].split("\n}\n").next().unwrap().to_owned()
    };
    assert_eq!(function("bump.frag", "vec3 blinn_phong"), function("phong.frag", "vec3 blinn_phong"));
    assert_eq!(function("custom.frag", "vec3 bumped_normal"), function("bump.frag", "vec3 bumped_normal"));
}
