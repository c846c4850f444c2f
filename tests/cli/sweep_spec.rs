//! A mistake in the file of a sweep is shown where it is.

use std::fs;

use serde_json::json;

use crate::scratch::Scratch;

fn scratch(spec: &str) -> Scratch {
    let scratch = Scratch::new();
    fs::write(scratch.path("spec.json"), spec).unwrap();
    scratch
}

#[test]
fn a_mistake_in_a_spec_is_shown_where_it_is() {
    let spec =
        |set: &str, rest: &str| format!("{{\"scene\": \"small.json\",\n \"set\": {{{set}}},\n {rest}}}");
    let measure = "\"measure\": [\"hash\"]";
    let ks = "\"cloth.ks\": [1, 2]";
    for (text, line, key, message) in [
        (spec("\"cloth.kd\": [1]", measure), 2, "set.cloth.kd", "there is no key `cloth.kd` in a scene"),
        (
            spec("\"cloth.ks\": 5", measure),
            2,
            "set.cloth.ks",
            "`set.cloth.ks` is a number but must be a list of values",
        ),
        (
            spec("\"cloth.ks\": []", measure),
            2,
            "set.cloth.ks",
            "`set.cloth.ks` is [] but must be a list of values",
        ),
        (
            spec("\"cloth.ks\": {\"from\": 0, \"to\": 1, \"count\": 2, \"scale\": \"log\"}", measure),
            2,
            "set.cloth.ks",
            "must be a range above 0 where `scale` is \"log\"",
        ),
        (
            spec("\"cloth.ks\": {\"from\": 0, \"to\": 1}", measure),
            2,
            "set.cloth.ks.count",
            "`set.cloth.ks` is missing `count`",
        ),
        (
            spec(ks, "\"measure\": [\"hsh\"]"),
            3,
            "measure.0",
            "`measure.0` is \"hsh\" but must be one of time,",
        ),
        (spec(ks, "\"mesure\": [\"hash\"]"), 3, "mesure", "unknown key `mesure`"),
        (
            spec(ks, &format!("{measure}, \"time\": 1, \"frames\": 2")),
            3,
            "frames",
            "`time` and `frames` both say",
        ),
        (
            spec("\"cloth.ks\": [1, 2], \"cloth.density\": [1]", &format!("{measure}, \"zip\": true")),
            3,
            "zip",
            "`zip` asks for as many values of each key, but `cloth.ks` has 2, `cloth.density` has 1",
        ),
        (
            spec(ks, &format!("{measure}, \"render\": {{\"material\": {{\"shade\": 1}}}}")),
            3,
            "render.material.shade",
            "there is no key `material.shade`",
        ),
        ("[]".to_owned(), 1, "", "the sweep is a list but must be an object"),
        (spec(ks, "\"frames\": 1"), 1, "measure", "the sweep is missing `measure`"),
    ] {
        let scratch = scratch(&text);
        let run = scratch.run(&["sweep", "plan", "spec.json", "out", "--json"]);
        assert_eq!(run.code, Some(3), "{text}");
        let error = run.error();
        let found = error["diagnostics"].as_array().unwrap().iter().find(|found| found["key"] == key);
        let found = found.unwrap_or_else(|| panic!("{text}: {error}"));
        assert_eq!((&found["line"], &found["file"]), (&json!(line), &json!("spec.json")), "{found}");
        assert!(found["message"].as_str().unwrap().contains(message), "{found}");
        assert!(!scratch.path("out").exists(), "nothing is written");
    }
}

#[test]
fn a_plan_that_no_disk_holds_is_refused() {
    let axis = r#"{"from": 1, "to": 2, "count": 100000}"#;
    let scratch = scratch(&format!(
        r#"{{"scene": "small.json", "set": {{"cloth.ks": {axis}, "cloth.density": {axis}}}, "measure": ["hash"]}}"#
    ));
    let run = scratch.run(&["sweep", "plan", "spec.json", "out"]);
    assert_eq!(run.code, Some(3));
    assert!(run.stderr.contains("the sweep has 10000000000 cases, more than 1000000000"), "{}", run.stderr);
}

#[test]
fn ranges_that_no_memory_holds_are_refused() {
    let axis = |i: usize| format!(r#""sphere.{i}.radius": {{"from": 1, "to": 2, "count": 1000000}}"#);
    let set = (0..6).map(axis).collect::<Vec<_>>().join(", ");
    let spec = format!(r#"{{"scene": "small.json", "zip": true, "set": {{{set}}}, "measure": ["hash"]}}"#);
    let run = scratch(&spec).run(&["sweep", "plan", "spec.json", "out"]);
    assert_eq!(run.code, Some(3));
    let message = "must be shorter: all ranges together have at most 4000000 values";
    assert!(run.stderr.contains("sphere.4.radius") && run.stderr.contains(message), "{}", run.stderr);
}

/// The text of the first block of `docs/cluster.md` that starts with `start`.
fn block(start: &str) -> String {
    let page = fs::read_to_string(crate::repository::path("docs/cluster.md")).unwrap();
    let mut blocks = page.split("```").skip(1).step_by(2).filter_map(|block| block.split_once('\n'));
    blocks.find(|(_, text)| text.starts_with(start)).unwrap().1.to_owned()
}

#[test]
fn the_page_about_clusters_has_a_sweep_that_can_be_planned() {
    let scratch = scratch(&block("{"));
    fs::copy(crate::scratch::scene("sphere.json"), scratch.path("sphere.json")).unwrap();
    assert_eq!(scratch.json(&["sweep", "plan", "spec.json", "out", "--json"])["cases"], json!(27));
}

#[test]
fn the_page_about_clusters_has_the_script_that_is_checked_on_slurm() {
    let check = fs::read_to_string(crate::repository::path(".ci/check-cluster")).unwrap();
    let script = block("#!/bin/bash");
    assert!(script.contains("srun drape") && check.contains(&script), "{script}");
}
