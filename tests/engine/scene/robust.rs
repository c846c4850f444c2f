//! Promise: whatever text is read, it gives a scene that is finite and in range or errors with
//! their places, and never a panic.

use std::sync::LazyLock;

use drape::scene::Overrides;
use proptest::prelude::*;
use serde_json::json;

use super::schema::{base, insert, leaves};

/// Whether a text gives a scene; a panic if that is not in range, or an error has no place.
fn loads_or_explains(text: &str, sets: &[String]) -> bool {
    let overrides = Overrides { sets: sets.to_vec(), ..Overrides::default() };
    crate::corpora::scene::loads_or_explains(text.as_bytes(), &overrides).is_some()
}

/// Any JSON value, with numbers at the edges of ranges.
fn json() -> impl Strategy<Value = String> {
    let number = prop_oneof![
        any::<f64>()
            .prop_filter("JSON has no such numbers", |x| x.is_finite())
            .prop_map(|x| format!("{x:e}")),
        (-2..60_i32).prop_map(|x| x.to_string()),
        prop::sample::select(vec![
            "1e999",
            "-1e999",
            "-0",
            "1e15",
            "1e-15",
            "5e-324",
            "0.5",
            "50.0",
            "2147483648"
        ])
        .prop_map(str::to_owned),
    ];
    let word = prop::sample::select(vec![
        "null",
        "true",
        "false",
        "\"\"",
        "\"phong\"",
        "\"off\"",
        "\"cube\"",
        "\"5\"",
    ]);
    let leaf = prop_oneof![3 => number, 1 => word.prop_map(str::to_owned)];
    leaf.prop_recursive(3, 24, 4, |inner| {
        prop_oneof![
            2 => prop::collection::vec(inner.clone(), 0..4).prop_map(|items| format!("[{}]", items.join(","))),
            1 => prop::collection::vec((key(), inner), 0..4).prop_map(|members| {
                let members: Vec<String> = members.iter().map(|(k, v)| format!("\"{k}\":{v}")).collect();
                format!("{{{}}}", members.join(","))
            }),
        ]
    })
}

/// Mostly keys that mean something somewhere.
fn key() -> impl Strategy<Value = String> {
    prop_oneof![9 => prop::sample::select(KEYS.clone()), 1 => "[a-zé]{0,6}"]
}

/// Every name in a path of the schema, and an index.
static KEYS: LazyLock<Vec<String>> = LazyLock::new(|| {
    let mut names: Vec<String> = leaves().into_iter().flat_map(|(path, _)| path).collect();
    names.push("0".to_owned());
    names.sort_unstable();
    names.dedup();
    names
});

/// A text with all keys in it, valid as it stands.
static FULL: LazyLock<String> = LazyLock::new(|| {
    let mut scene = base();
    for (path, leaf) in leaves() {
        if let Some(default) = leaf.get("default") {
            insert(&mut scene, &path, default.clone());
        }
    }
    scene["cloth"]["num_width_points"] = 5.into();
    scene["cloth"]["num_height_points"] = 5.into();
    scene["cloth"]["pinned"] = json!([[0, 0], [4, 0]]);
    scene.to_string()
});

/// Every path in [`FULL`] that leads to a value.
fn paths() -> Vec<String> {
    fn walk(value: &serde_json::Value, path: &str, found: &mut Vec<String>) {
        let join = |step: &str| if path.is_empty() { step.to_owned() } else { format!("{path}.{step}") };
        if !path.is_empty() {
            found.push(path.to_owned());
        }
        match value {
            serde_json::Value::Object(members) => members.iter().for_each(|(k, v)| walk(v, &join(k), found)),
            serde_json::Value::Array(items) => {
                items.iter().enumerate().for_each(|(i, v)| walk(v, &join(&i.to_string()), found));
            }
            _ => {}
        }
    }
    let mut found = Vec::new();
    walk(&serde_json::from_str(&FULL).expect("JSON"), "", &mut found);
    found
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_text_loads_or_is_explained(text in "\\PC*") {
        loads_or_explains(&text, &[]);
    }

    #[test]
    fn any_json_loads_or_is_explained(text in json()) {
        loads_or_explains(&text, &[]);
    }

    #[test]
    fn a_scene_with_bytes_changed_loads_or_is_explained(
        changes in prop::collection::vec((any::<prop::sample::Index>(), "[ -~\n\tä]{0,2}"), 1..4),
    ) {
        let mut text: Vec<char> = FULL.chars().collect();
        for (at, new) in changes {
            let at = at.index(text.len());
            text.splice(at..=at, new.chars());
        }
        loads_or_explains(&text.into_iter().collect::<String>(), &[]);
    }

    #[test]
    fn a_scene_with_values_changed_loads_or_is_explained(
        changes in prop::collection::vec((prop::sample::select(paths()), json()), 1..3),
    ) {
        let sets: Vec<String> = changes.iter().map(|(path, value)| format!("{path}={value}")).collect();
        loads_or_explains(&FULL, &sets);
    }

    #[test]
    fn any_set_applies_or_is_explained(set in "[a-z0-9.=\\[\\]{}\":, é-]{0,24}") {
        loads_or_explains(&FULL, &[set]);
    }
}

#[test]
fn the_full_scene_is_valid() {
    assert!(loads_or_explains(&FULL, &[]), "else the changed scenes above would all be refused");
}
