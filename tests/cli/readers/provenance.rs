//! What files say of themselves, as other programs read it.

use serde_json::{Value, json};

use super::python;
use crate::scratch::Scratch;

#[test]
fn other_programs_read_what_files_say_of_themselves() {
    let scratch = Scratch::new();
    let hash = |arguments: &[&str]| {
        let text = String::from_utf8(scratch.succeed(arguments)).unwrap();
        Value::from(text.split_whitespace().last().unwrap())
    };
    let state = hash(&["simulate", "small.json", "--frames", "3", "--hash"]);
    let look = ["--frame", "3", "--size", "64x50"];
    let picture = hash(&[&["render", "small.json", "--hash"], &look[..]].concat());
    scratch.succeed(&[&["render", "small.json", "a.png"], &look[..]].concat());
    for out in ["a.apng", "a.gif"] {
        scratch.succeed(&[
            "animate",
            "small.json",
            out,
            "--frames",
            "0..3",
            "--fps",
            "30",
            "--size",
            "64x50",
        ]);
    }
    scratch.succeed(&["export", "small.json", "a.glb", "--frame", "3"]);
    let positions = ["simulate", "small.json", "--frames", "3", "--positions", "a.npy", "--json"];
    scratch.succeed(&[&positions[..], &["--provenance", "scene"]].concat());
    let Some(found) = python(&scratch, "provenance", &[]) else { return };
    let png = &found["a.png"];
    assert_eq!((&png["drape:picture"], &png["drape:state"]), (&picture, &state));
    for moving in ["a.apng", "a.gif"] {
        let said = &found[moving];
        assert_eq!(said["drape:scene-json"], png["drape:scene-json"], "{moving}");
        let arguments: Value = serde_json::from_str(said["drape:arguments"].as_str().unwrap()).unwrap();
        assert_eq!((&arguments["frames"], &arguments["fps"]), (&json!([0, 3]), &30.into()), "{moving}");
        let hash = said["drape:picture"].as_str().unwrap();
        assert!(hash.len() == 16 && hash != "0".repeat(16), "{moving}: {hash}");
    }
    for numbers in ["a.glb", "a.npy"] {
        let said = &found[numbers];
        assert_eq!((&said["state"], &said["arguments"]["frame"]), (&state, &3.into()), "{numbers}");
        assert_eq!(said["scene-json"]["cloth"]["ks"], 5000, "{numbers}");
        assert_eq!(said["content"].as_str().unwrap().len(), 16, "{numbers}");
    }
    assert_eq!(found["shape"], json!([5, 5, 3]));
}
