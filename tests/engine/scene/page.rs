//! Promise: the tables of `docs/scene.md` have every key with what the code says of it.
//!
//! `DRAPE_BLESS="reason" cargo test --release --test engine scene::page` writes them anew, and fails.

use std::fs;

use drape::scene::{Key, Shape, keys};

/// The page with every table as the code has it. A table stands below the heading of its object.
fn with_tables(page: &str) -> String {
    let mut lines: Vec<String> = Vec::new();
    let (mut object, mut replaced) = (None, false);
    for line in page.lines() {
        if let Some(title) = line.strip_prefix("## ").or(line.strip_prefix("### ")) {
            (object, replaced) = (Some(title.trim_matches('`').to_owned()), false);
        }
        if !line.starts_with('|') || object.is_none() {
            lines.push(line.to_owned());
        } else if !replaced {
            lines.extend(table(object.as_deref().unwrap_or_default(), page));
            replaced = true;
        }
    }
    lines.join("\n") + "\n"
}

/// The lines of the table below the heading `title`: of an object, or of a key whose values have a table.
fn table(title: &str, page: &str) -> Vec<String> {
    let keys = keys();
    let (head, rows): (_, Vec<String>) =
        match keys.iter().find(|key| key.path() == title).map(|key| &key.shape) {
            Some(Shape::Value { choices, .. }) => {
                let row = |(value, meaning): &(String, String)| format!("| `{value}` | {meaning} |");
                (["| value | meaning |", "|---|---|"], choices.iter().map(row).collect())
            }
            _ => {
                let object = if title == "The scene" { "" } else { title };
                let rows = keys.iter().filter(|key| key.object == object).map(|key| row(key, &keys, page));
                (["| key | meaning | left out | must be |", "|---|---|---|---|"], rows.collect())
            }
        };
    assert!(!rows.is_empty(), "no table belongs below the heading {title}");
    head.map(str::to_owned).into_iter().chain(rows).collect()
}

fn row(key: &Key, keys: &[Key], page: &str) -> String {
    let inner = |inner: &&Key| inner.object == key.path();
    let left_out = match (&key.shape, key.default()) {
        (_, Some(default)) => format!("`{default}`").replace(',', ", "),
        _ if key.required() => "required".to_owned(),
        // An object of which every key may be left out may be left out itself.
        (Shape::Object, _) if !keys.iter().filter(inner).any(Key::required) => "`{}`".to_owned(),
        _ => "none".to_owned(),
    };
    let has_table = page.contains(&format!("\n### `{}`\n", key.path()));
    let meaning = if has_table { key.meaning.clone() } else { key.full_meaning() };
    format!("| `{}` | {meaning} | {left_out} | {} |", key.name, key.rule())
}

#[test]
fn the_page_has_every_key_as_the_code_has_it() {
    let path = crate::repository::path("docs/scene.md");
    let page = fs::read_to_string(&path).unwrap();
    for object in keys().iter().map(|key| key.object.clone()).filter(|object| !object.contains('.')) {
        let heading =
            if object.is_empty() { "\n## The scene\n".to_owned() } else { format!("\n## `{object}`\n") };
        assert!(page.contains(&heading), "docs/scene.md needs the heading {heading:?} and a table below it");
    }
    let made = with_tables(&page);
    if made == page {
        return;
    }
    if std::env::var("DRAPE_BLESS").is_ok_and(|reason| !reason.is_empty()) {
        fs::write(path, made).unwrap();
        panic!("docs/scene.md: blessed; look at it and run again without DRAPE_BLESS");
    }
    let changed: Vec<_> = made.lines().filter(|line| !page.contains(line)).collect();
    panic!("docs/scene.md: DRAPE_BLESS=\"reason\" writes these lines:\n{}", changed.join("\n"));
}

/// A table that is not there is not one that agrees.
#[test]
fn every_object_has_its_table_on_the_page() {
    let page = fs::read_to_string(crate::repository::path("docs/scene.md")).unwrap();
    for key in keys().iter().filter(|key| !key.object.contains('.')) {
        let row = format!("| `{}` | {}", key.name, key.meaning);
        assert!(page.contains(&row), "{row}");
    }
}
