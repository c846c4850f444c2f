//! Changes that options make are checked like the file, and named as they were given.

use drape::scene::{Flag, Overrides, check_value, load_text};

use super::values::refuses;
use super::{error, summary};

#[test]
fn a_set_cannot_go_through_a_value() {
    refuses("cloth.ks.x=1", &["scene::no_such_place cloth.ks.x"]);
    refuses("sphere.1.radius=1", &["scene::unknown_key sphere.1"]);
    let two = "{\"sphere\": [{\"origin\": [0, 0, 0], \"radius\": 1, \"friction\": 0}, {}]}";
    let found = error(two, &["sphere.2.radius=1", "sphere.radius=1"]);
    let summary = summary(&found);
    // What is wrong in the file comes first.
    let (file, sets) = summary.split_at(summary.len() - 2);
    assert!(
        !file.is_empty() && file.iter().all(|found| found.starts_with("scene::missing_key 1:")),
        "{file:?}"
    );
    assert_eq!(sets, ["scene::no_such_place 1:8 sphere.2", "scene::no_such_place 1:8 sphere.radius"]);
    let last = found.diagnostics.last().unwrap();
    assert_eq!(last.message, "there is no `sphere.radius`: `sphere` is a list");
}

#[test]
fn a_set_that_is_nearly_a_number_says_what_to_write() {
    let error = error("{}", &["cloth.ks=5k"]);
    assert_eq!(summary(&error), ["scene::syntax 1:10 cloth.ks"]);
    let found = &error.diagnostics[0];
    assert_eq!(found.message, "`5k` is neither a number nor another JSON value");
    assert_eq!(found.help, "write `--set cloth.ks=5000`");
}

#[test]
fn a_flag_is_named_by_its_errors() {
    let flag = Flag { name: "--size", set: "render.size=[0,1]".to_owned() };
    let overrides = Overrides { flags: vec![flag], ..Overrides::default() };
    let error = load_text("scene.json", "{}", &overrides).unwrap_err();
    let found = &error.diagnostics[0];
    assert_eq!((found.file.as_str(), found.key.as_str()), ("--size render.size=[0,1]", "render.size.0"));
}

#[test]
fn a_value_alone_is_checked_by_the_rule_of_its_key() {
    assert_eq!(check_value("render.samples", "4"), Ok(()));
    assert_eq!(check_value("sphere.resolution.0", "16"), Ok(()));
    let wrong = |path: &str, json: &str| check_value(path, json).unwrap_err();
    assert_eq!(wrong("render.samples", "3"), "`render.samples` is 3 but must be 1, 4, 8 or 16");
    assert_eq!(
        wrong("sphere.resolution.0", "1"),
        "`sphere.resolution.0` is 1 but must be a whole number from 2 to 1000"
    );
    assert_eq!(wrong("render.time", "1s"), "`1s` is neither a number nor another JSON value");
    assert_eq!(wrong("render.time", "{"), "not valid JSON: this object is never closed");
}
