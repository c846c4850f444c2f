//! Every file and folder that a page names exists, so that pages follow when code is moved.

use std::fs;
use std::path::Path;

/// The folders of the repository in which a page may name a file.
const FOLDERS: [&str; 13] = [
    "src/",
    "lab/",
    "cli/",
    "tests/",
    "docs/",
    "examples/",
    "benches/",
    "fuzz/",
    "golden/",
    "scenes/",
    "textures/",
    "web/",
    ".ci/",
];

fn top() -> std::path::PathBuf {
    crate::repository::path("")
}

/// The pages about the code as it is, from the top folder.
fn pages() -> Vec<String> {
    let entries = fs::read_dir(top().join("docs")).unwrap().map(|entry| entry.unwrap().file_name());
    let names = entries.map(|name| format!("docs/{}", name.to_string_lossy()));
    let others = ["README.md", "CONTRIBUTING.md"].map(str::to_owned);
    names.filter(|name| name.ends_with(".md")).chain(others).collect()
}

/// The paths between backticks in a text.
fn paths(text: &str) -> Vec<&str> {
    let code = text.lines().flat_map(|line| line.split('`').skip(1).step_by(2));
    code.filter(|path| FOLDERS.iter().any(|folder| path.starts_with(folder)) && !path.contains(' ')).collect()
}

/// The targets of the links of a text that stay in the repository.
fn links(text: &str) -> Vec<&str> {
    let targets = text.split("](").skip(1).filter_map(|rest| Some(rest.split_once(')')?.0));
    targets.filter(|target| !target.contains("://")).collect()
}

/// The entries of the tree in `docs/architecture.md`, each as a path. Deeper entries are indented by two more
/// spaces, and only names with a `/` at their end have entries.
fn tree(text: &str) -> Vec<String> {
    let (_, section) = text.split_once("## The tree").unwrap();
    let block = section.split("```text\n").nth(1).unwrap().split("```").next().unwrap();
    let mut above: Vec<&str> = Vec::new();
    let entries = block.lines().filter(|line| !line.trim_start().starts_with('#')).map(|line| {
        let name = line.split_whitespace().next().unwrap();
        above.truncate((line.len() - line.trim_start().len()) / 2);
        above.push(name);
        above.concat()
    });
    entries.collect()
}

#[test]
fn every_path_in_a_page_exists() {
    let mut missing = Vec::new();
    let mut found = 0;
    for page in pages() {
        let text = fs::read_to_string(top().join(&page)).unwrap();
        let folder = top().join(Path::new(&page).parent().unwrap());
        let named = paths(&text).into_iter().map(|path| (path, top().join(path)));
        for (path, place) in named.chain(links(&text).into_iter().map(|link| (link, folder.join(link)))) {
            found += 1;
            if !place.exists() {
                missing.push(format!("{page}: {path}"));
            }
        }
    }
    assert!(found > 40, "found only {found} paths");
    assert!(missing.is_empty(), "there is no\n{}", missing.join("\n"));
}

#[test]
fn the_tree_is_that_of_the_repository() {
    let entries = tree(&fs::read_to_string(top().join("docs/architecture.md")).unwrap());
    assert!(entries.len() > 25, "found only {entries:?}");
    let exists = |entry: &&String| top().join(entry).exists() || top().join(format!("{entry}.rs")).exists();
    let missing: Vec<_> = entries.iter().filter(|entry| !exists(entry)).collect();
    assert!(missing.is_empty(), "docs/architecture.md has {missing:?}");
    // And every public module of the engine is in it.
    let lib = fs::read_to_string(top().join("src/lib.rs")).unwrap();
    let modules = lib.lines().filter_map(|line| line.strip_prefix("pub mod "));
    for module in modules.filter_map(|module| module.strip_suffix(';')) {
        let entry = format!("src/{module}");
        assert!(entries.iter().any(|path| path.trim_end_matches('/') == entry), "no {entry}");
    }
}
