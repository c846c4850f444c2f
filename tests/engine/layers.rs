//! Data flows one way: in each crate a module uses only modules that `lib.rs` or `main.rs` declares above it.

#![allow(clippy::unwrap_used, reason = "a test that cannot read the sources fails")]

use std::{fs, path::PathBuf};

/// The modules in the order of `lib.rs`.
fn modules() -> Vec<String> {
    let text = fs::read_to_string(source().join("lib.rs")).unwrap();
    text.lines()
        .filter_map(|line| line.strip_prefix("pub mod ").or_else(|| line.strip_prefix("mod ")))
        .filter_map(|rest| rest.strip_suffix(';').map(str::to_owned))
        .collect()
}

fn source() -> PathBuf {
    crate::repository::path("src")
}

/// Every Rust file of a module.
fn files(module: &str) -> Vec<PathBuf> {
    let mut found = vec![source().join(format!("{module}.rs"))];
    let mut folders = vec![source().join(module)];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).into_iter().flatten() {
            let path = entry.unwrap().path();
            if path.is_dir() { folders.push(path) } else { found.push(path) }
        }
    }
    found.retain(|path| path.extension().is_some_and(|extension| extension == "rs") && path.exists());
    found
}

/// The modules that a file names after `crate::`, also within `use crate::{a::.., b::..}`.
fn used(text: &str, modules: &[String]) -> Vec<String> {
    let code: String =
        text.lines().filter(|line| !line.trim_start().starts_with("//")).collect::<Vec<_>>().join("\n");
    let mut used = Vec::new();
    for (at, _) in code.match_indices("crate::") {
        let rest = &code[at + "crate::".len()..];
        let names = if let Some(group) = rest.strip_prefix('{') {
            top_level_names(group)
        } else {
            vec![first_word(rest)]
        };
        used.extend(names.into_iter().filter(|name| modules.contains(name)));
    }
    used
}

/// The first word of every item of a brace group, nested groups passed over.
fn top_level_names(group: &str) -> Vec<String> {
    let (mut depth, mut names, mut start) = (0, Vec::new(), 0);
    for (i, c) in group.char_indices() {
        match c {
            '{' => depth += 1,
            '}' if depth == 0 => {
                names.push(first_word(&group[start..i]));
                break;
            }
            '}' => depth -= 1,
            ',' if depth == 0 => {
                names.push(first_word(&group[start..i]));
                start = i + 1;
            }
            _ => {}
        }
    }
    names
}

fn first_word(text: &str) -> String {
    text.trim_start().chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect()
}

#[test]
fn a_module_uses_only_modules_above_it() {
    let modules = modules();
    assert!(modules.len() > 10, "found only {modules:?}");
    let mut wrong = Vec::new();
    for (place, module) in modules.iter().enumerate() {
        let files = files(module);
        assert!(!files.is_empty(), "no file of {module}");
        for file in files {
            for other in used(&fs::read_to_string(&file).unwrap(), &modules) {
                if !modules[..=place].contains(&other) {
                    wrong.push(format!("{} uses {other}, which stands below {module}", file.display()));
                }
            }
        }
    }
    assert_eq!(wrong, Vec::<String>::new());
}

#[test]
fn the_reader_of_uses_sees_what_it_must() {
    let modules: Vec<String> = ["scene", "cloth", "mesh"].map(str::to_owned).into();
    assert_eq!(used("use crate::scene::Scene;", &modules), ["scene"]);
    assert_eq!(used("use crate::{\n    cloth::{Points, grid},\n    mesh,\n};", &modules), ["cloth", "mesh"]);
    assert_eq!(used("let x = crate::mesh::f();", &modules), ["mesh"]);
    assert_eq!(used("// use crate::scene;", &modules), Vec::<String>::new());
}

/// Files stay short enough to be read in one go.
#[test]
fn no_source_file_is_long() {
    let long: Vec<_> = modules()
        .iter()
        .flat_map(|module| files(module))
        .filter(|file| fs::read_to_string(file).unwrap().lines().count() > 350)
        .collect();
    assert_eq!(long, Vec::<PathBuf>::new());
}
