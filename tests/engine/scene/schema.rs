//! Promise: the JSON schema and the reader agree. What the reader accepts, the schema accepts; a
//! wrong key, type, length or range both refuse.

use std::fs;
use std::path::{Path, PathBuf};

use drape::scene::{ColliderKind, Overrides, load_text, schema};
use jsonschema::Validator;
use proptest::prelude::*;
use serde_json::{Value, json};

use crate::scenes::colliders;

fn validator() -> Validator {
    jsonschema::draft202012::new(&schema()).expect("a schema")
}

fn folder(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(name)
}

/// Every JSON file of a folder.
fn documents(name: &str) -> Vec<(String, Value)> {
    let files = fs::read_dir(folder(name)).expect("a folder").map(|entry| entry.expect("an entry").path());
    let read = |path: PathBuf| {
        let text = fs::read_to_string(&path).expect("a file");
        (path.display().to_string(), serde_json::from_str(&text).expect("JSON"))
    };
    files.filter(|path| path.extension().is_some_and(|ending| ending == "json")).map(read).collect()
}

/// RFC 7396.
fn merge(target: &mut Value, patch: &Value) {
    let Value::Object(changes) = patch else {
        *target = patch.clone();
        return;
    };
    if !target.is_object() {
        *target = json!({});
    }
    for (key, change) in changes {
        let members = target.as_object_mut().expect("an object");
        if change.is_null() {
            members.remove(key);
        } else {
            merge(members.entry(key).or_insert(Value::Null), change);
        }
    }
}

#[test]
fn stock_scenes_are_valid_and_so_they_are_with_the_patches() {
    let (validator, scenes, patches) = (validator(), documents("scenes"), documents("scenes/look"));
    assert!(scenes.len() >= 5 && patches.len() >= 3);
    for (name, scene) in &scenes {
        assert_eq!(validator.validate(scene).err().map(|e| e.to_string()), None, "{name}");
        for (patch_name, patch) in &patches {
            let mut changed = scene.clone();
            merge(&mut changed, patch);
            if changed["cloth"].as_object().is_none_or(|cloth| cloth.contains_key("ks")) {
                let wrong = validator.validate(&changed).err().map(|e| e.to_string());
                assert_eq!(wrong, None, "{name} with {patch_name}");
            }
        }
    }
    assert!(validator.is_valid(&json!({})), "every object may be left out");
}

#[test]
fn the_schema_is_one_and_names_what_users_know() {
    assert!(jsonschema::meta::is_valid(&schema()));
    let schema = schema();
    assert_eq!(schema["$schema"], "https://json-schema.org/draft/2020-12/schema");
    let cloth = &schema["properties"]["cloth"];
    assert_eq!(cloth["properties"]["damping"]["maximum"], 100.0);
    assert!(cloth["required"].as_array().is_some_and(|keys| keys.contains(&json!("ks"))));
    assert!(cloth["properties"]["material"]["properties"]["shader"]["enum"][0] == "wireframe");
}

#[test]
fn wrong_scenes_are_refused() {
    let validator = validator();
    let sphere = || json!({ "origin": [0, 0, 0], "radius": 1, "friction": 0 });
    assert!(
        validator.is_valid(&json!({ "sphere": sphere() })) && validator.is_valid(&json!({ "sphere": [] }))
    );
    assert!(validator.is_valid(&json!({ "sphere": [sphere(), sphere()] })));
    for wrong in [
        json!([]),
        json!({ "clot": {} }),
        json!({ "cloth": {} }),
        json!({ "sphere": { "origin": [0, 0, 0], "radius": 1 } }),
        json!({ "sphere": [sphere(), { "radius": 1 }] }),
        json!({ "sphere": { "origin": [0, 0], "radius": 1, "friction": 0 } }),
        json!({ "sphere": { "origin": [0, 0, 0], "radius": 0, "friction": 0 } }),
        json!({ "sphere": { "origin": [0, 0, 0], "radius": 1, "friction": -0.1 } }),
        json!({ "plane": { "point": [0, 0, 0], "normal": [0, 0, 0], "friction": 0 } }),
        json!({ "sim": { "steps_per_frame": 1.5 } }),
        json!({ "sim": { "gravity": "down" } }),
        json!({ "render": { "samples": 2 } }),
        json!({ "render": { "size": [0, 1] } }),
        json!({ "material": { "texture": "../secret" } }),
    ] {
        assert!(!validator.is_valid(&wrong), "{wrong}");
    }
}

/// A key of the schema: the way to it, and what it must be.
pub(super) type Leaf = (Vec<String>, Value);

/// Every key that holds no further keys.
pub(super) fn leaves() -> Vec<Leaf> {
    fn walk(schema: &Value, path: &[String], found: &mut Vec<Leaf>) {
        // The first form of an object that may be a list.
        let one = schema.get("anyOf").and_then(|forms| forms.get(0)).filter(|form| form["type"] == "object");
        match one.unwrap_or(schema).get("properties").and_then(Value::as_object) {
            Some(properties) => properties
                .iter()
                .for_each(|(name, inner)| walk(inner, &[path, std::slice::from_ref(name)].concat(), found)),
            None => found.push((path.to_vec(), schema.clone())),
        }
    }
    let mut found = Vec::new();
    walk(&schema(), &[], &mut found);
    found
}

/// Values that try the ends of every rule, and values of every type.
fn values(leaf: &Value) -> Vec<Value> {
    let mut values: Vec<Value> =
        ["null", "true", "\"bump\"", "\"a b\"", "\"\"", "{}", "[]", "[[0, 0]]", "[4, 5]"]
            .into_iter()
            .chain([
                "[1, 2, 3]",
                "[0, 0, 0]",
                "[-1, 0, 0]",
                "[1, 2]",
                "[1, 2, 3, 4]",
                "[1, \"2\", 3]",
                "[1e16, 0, 0]",
            ])
            .chain([
                "[2.5, 4]", "0", "1", "4", "-1", "0.5", "3.0", "1e15", "2e15", "1e-15", "1e-16", "16385",
                "1001",
            ])
            .map(|text| serde_json::from_str(text).expect("JSON"))
            .collect();
    values.extend(leaf["enum"].as_array().into_iter().flatten().cloned());
    for end in ["minimum", "maximum"] {
        if let Some(end) = leaf[end].as_f64() {
            values.extend([end, end - 1.0, end + 1.0, end.next_up(), end.next_down()].map(|x| json!(x)));
        }
    }
    values
}

/// Puts a value into a document, and objects on the way where there are none.
pub(super) fn insert(document: &mut Value, path: &[String], value: Value) {
    let mut place = document;
    for step in path {
        if !place[step].is_object() && Some(step) != path.last() {
            place[step] = json!({});
        }
        place = &mut place[step];
    }
    *place = value;
}

/// A scene with everything that must be there.
pub(super) fn base() -> Value {
    let mut scene =
        documents("scenes").into_iter().find(|(name, _)| name.ends_with("sphere.json")).expect("it").1;
    for &kind in ColliderKind::ALL {
        if scene.get(kind.key()).is_none() {
            scene[kind.key()] = colliders::example(kind);
        }
    }
    scene
}

/// Holds both verdicts on `document` against each other; whether it is accepted.
fn agree(validator: &Validator, document: &Value) -> Result<bool, String> {
    let loaded = load_text("x.json", &document.to_string(), &Overrides::default());
    let valid = validator.is_valid(document);
    let Err(error) = loaded else {
        return if valid { Ok(true) } else { Err(format!("only the schema refuses {document}")) };
    };
    let codes: Vec<&str> = error.diagnostics.iter().map(|d| d.code).collect();
    // Two values together, which the schema cannot see, or sees in part.
    let relations = [
        "near_far",
        "damping",
        "friction",
        "too_many_points",
        "too_many_objects",
        "pin_outside",
        "duplicate_pin",
    ];
    let alone = codes.iter().any(|code| !relations.contains(&code.trim_start_matches("scene::")));
    match (valid, alone) {
        (true, true) => Err(format!("only the reader refuses {document}: {codes:?}")),
        (false, false)
            if !codes.iter().any(|code| code.ends_with("_pin") || code.ends_with("pin_outside")) =>
        {
            Err(format!("the schema refuses {document}, the reader only says {codes:?}"))
        }
        _ => Ok(false),
    }
}

#[test]
fn reader_and_schema_agree_on_every_value_of_every_key() {
    let (validator, leaves, base) = (validator(), leaves(), base());
    assert!(leaves.len() > 80, "found only {} keys", leaves.len());
    assert_eq!(agree(&validator, &base), Ok(true));
    for (path, leaf) in leaves {
        let verdict = |value: Value| {
            let mut document = base.clone();
            insert(&mut document, &path, value);
            agree(&validator, &document).unwrap_or_else(|difference| panic!("{difference}"))
        };
        let verdicts: Vec<bool> = values(&leaf).into_iter().map(verdict).collect();
        assert!(verdicts.contains(&true) && verdicts.contains(&false), "{path:?} is not tried: {verdicts:?}");
    }
}

#[test]
fn every_default_is_the_value_of_a_key_that_is_left_out() {
    let load = |document: &Value| {
        load_text("x.json", &document.to_string(), &Overrides::default()).expect("a valid scene").scene
    };
    let (base, mut defaults) = (base(), 0);
    let scene = load(&base);
    for (path, leaf) in leaves() {
        let Some(default) = leaf.get("default") else {
            let given = path.iter().try_fold(&base, |value, step| value.get(step)).is_some();
            assert!(given || path[1] == "material", "{path:?} has no default");
            continue;
        };
        let mut document = base.clone();
        insert(&mut document, &path, default.clone());
        let mut given = load(&document);
        // A colour that is given is that of planes too, which are grey otherwise.
        if path == ["material", "color"] {
            for (given, collider) in given.colliders.iter_mut().zip(&scene.colliders) {
                given.material_mut().color = collider.material().color;
            }
        }
        assert!(given == scene, "{path:?} is not {default}");
        defaults += 1;
    }
    assert!(defaults > 40, "{defaults} defaults");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn reader_and_schema_agree_on_scenes_with_several_changes(
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<prop::sample::Index>(), 0..8), 1..6),
    ) {
        let (leaves, mut document) = (leaves(), base());
        for (leaf, value, kind) in changes {
            let (path, leaf) = leaf.get(&leaves);
            match kind {
                0 => insert(&mut document, &[path, &["extra".into()][..]].concat(), json!(1)),
                1 => insert(&mut document, &path[..1], json!([])),
                _ => {
                    let values = values(leaf);
                    insert(&mut document, path, value.get(&values).clone());
                }
            }
        }
        if let Err(difference) = agree(&validator(), &document) {
            prop_assert!(false, "{}", difference);
        }
    }
}
