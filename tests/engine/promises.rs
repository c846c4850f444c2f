//! `tests/README.md` has a line for each file with tests, and a file for each line.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

/// The Rust files with tests under `folder`, relative to `top`.
fn files_with_tests(top: &Path, folder: &Path, found: &mut BTreeSet<String>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            files_with_tests(top, &path, found);
        } else if path.extension().is_some_and(|extension| extension == "rs")
            && fs::read_to_string(&path).unwrap().contains("#[test]\n")
        {
            found.insert(path.strip_prefix(top).unwrap().to_string_lossy().into_owned());
        }
    }
}

/// The files that `page` names first in a row of a table, each with a promise.
fn files_of_rows(page: &str) -> Vec<String> {
    let rows = page.lines().filter_map(|line| line.strip_prefix("| `"));
    let row = |row: &str| {
        let (file, promise) = row.split_once("` | ").unwrap_or_else(|| panic!("not a row of two: {row}"));
        assert!(promise.trim_matches([' ', '|']).len() > 20, "{file}: {promise}");
        file.to_owned()
    };
    rows.map(row).collect()
}

#[test]
fn every_file_with_tests_has_its_line() {
    let top = crate::repository::path("tests");
    let mut files = BTreeSet::new();
    files_with_tests(&top, &top, &mut files);
    let rows = files_of_rows(&fs::read_to_string(top.join("README.md")).unwrap());
    let named: BTreeSet<String> = rows.iter().cloned().collect();
    assert!(files.len() > 40, "found only {files:?}");
    assert_eq!(rows.len(), named.len(), "a file has two lines");
    let without_line: Vec<_> = files.difference(&named).collect();
    let without_file: Vec<_> = named.difference(&files).collect();
    assert!(without_line.is_empty(), "no line in tests/README.md for {without_line:?}");
    assert!(without_file.is_empty(), "no file with tests for the lines {without_file:?}");
}
