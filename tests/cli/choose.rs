//! `choose` and `horizon` answer people and programs, and what they write is used by the other commands.

use std::fs;

use crate::scratch::Scratch;

#[test]
fn the_choice_is_a_patch_that_simulates() {
    let scratch = Scratch::new();
    let arguments =
        ["choose", "small.json", "--within", "1mm", "--frame", "10", "--patch-out", "p.json", "--json"];
    let answer = scratch.json(&arguments);
    let choice = &answer["choice"];
    let sets: Vec<&str> = choice["set"].as_array().unwrap().iter().map(|set| set.as_str().unwrap()).collect();
    assert!(sets.contains(&"sim.start=half_step") && sets.contains(&"sim.damping=per_second"), "{sets:?}");
    assert!(choice["error"].as_f64().unwrap() <= 1e-3 && choice["springs_visited"].as_u64().unwrap() > 0);
    assert!(
        choice["ms"].is_f64()
            && answer["horizon"].is_null()
            && answer["candidates"].as_array().unwrap().len() > 4
    );
    let set: Vec<&str> = sets.iter().flat_map(|set| ["--set", set]).collect();
    let simulate = ["simulate", "small.json", "--frames", "10", "--json"];
    let by_set = scratch.json(&[&simulate[..], &set].concat());
    let by_patch = scratch.json(&[&simulate[..], &["--patch", "p.json"]].concat());
    assert_eq!(by_set, by_patch);
    assert_ne!(by_set["state_hash"], scratch.json(&simulate)["state_hash"]);
    let text = String::from_utf8(scratch.succeed(&arguments[..6])).unwrap();
    assert_eq!(text.lines().last().unwrap(), set.join(" "));
}

#[test]
fn what_cannot_be_promised_is_1_with_the_reason() {
    let scratch = Scratch::new();
    let run = scratch.run(&["choose", "small.json", "--budget", "0.000001ms", "--frame", "5"]);
    assert!(run.code == Some(1) && run.stderr.contains("the fewest steps"), "{}", run.stderr);
    assert!(scratch.run(&["choose", "small.json", "--frame", "5"]).code == Some(2), "no goal");
    let both = ["choose", "small.json", "--within", "1mm", "--budget", "1s"];
    assert_eq!(scratch.run(&both).code, Some(2));
    for length in ["1", "-1mm", "mm", "1e999m"] {
        assert_eq!(scratch.run(&["choose", "small.json", "--within", length]).code, Some(2), "{length}");
    }
    assert_eq!(scratch.run(&["choose", "small.json", "--within", "1mm", "--frame", "0"]).code, Some(4));
    let no_cloth = ["choose", "small.json", "--within", "1mm", "--frame", "5", "--patch", "none.json"];
    fs::write(scratch.path("none.json"), r#"{"cloth": null}"#).unwrap();
    assert_eq!(scratch.run(&no_cloth).code, Some(4));
}

#[test]
fn a_budget_is_kept() {
    let scratch = Scratch::new();
    let answer = scratch.json(&["choose", "small.json", "--budget", "5s", "--frame", "3", "--max", "--json"]);
    assert!(answer["choice"]["ms"].as_f64().unwrap() <= 5000.0);
}

#[test]
fn the_horizon_is_told_and_drawn() {
    let scratch = Scratch::new();
    let horizon = scratch.json(&["horizon", "small.json", "out.html", "--frame", "12", "--json"]);
    assert_eq!(horizon["partings"].as_array().unwrap().len(), 12);
    assert_eq!(horizon["times"].as_array().unwrap().len(), 3);
    let page = String::from_utf8(scratch.read("out.html")).unwrap();
    assert!(page.starts_with("<!DOCTYPE html>") && page.contains("<svg"));
    let text = String::from_utf8(scratch.succeed(&["horizon", "small.json", "--frame", "12"])).unwrap();
    assert!(text.contains("1e-6 m apart not by the end"), "{text}");
    assert_eq!(scratch.run(&["horizon", "small.json", "--frame", "0"]).code, Some(4));
}

#[test]
fn the_summary_says_what_was_run_and_how_wrong_it_is() {
    let scratch = Scratch::new();
    let arguments = ["simulate", "small.json", "--frames", "10", "--error"];
    let text = String::from_utf8(scratch.succeed(&arguments)).unwrap();
    let line = |name: &str| {
        let lines: Vec<&str> = text.lines().filter(|line| line.split(' ').next() == Some(name)).collect();
        assert_eq!(lines.len(), 1, "{name}: {text}");
        lines[0].to_owned()
    };
    assert!(line("settings").contains("verlet, 30 steps in each of 90 frames a second, f64; start report"));
    assert!(line("heights").contains("sagged by"), "{text}");
    assert!(
        line("longest").contains("of its rest length") && line("rest").ends_with("not seen for 0.5 s"),
        "{text}"
    );
    assert!(line("error").contains("a run of 60 steps a frame"), "{text}");
    let summary = scratch.json(&[&arguments[..], &["--json"]].concat());
    assert_eq!(summary["settings"]["steps_per_frame"], 30);
    assert_eq!(summary["at_rest"], false);
    let number = |value: &serde_json::Value| value.as_f64().unwrap();
    let heights = &summary["heights"];
    assert!(
        number(&heights["lowest"]) <= number(&heights["mean"])
            && number(&heights["mean"]) <= number(&heights["highest"])
    );
    assert!(number(&heights["sag"]) > 0.0 && number(&summary["largest_stretch"]) > 1.0);
    let error = &summary["error"];
    assert!(number(&error["max"]) >= number(&error["rms"]) && number(&error["rms"]) > 0.0);
    // The estimate changes nothing of the run, and without it there is none.
    let plain = scratch.json(&["simulate", "small.json", "--frames", "10", "--json"]);
    assert_eq!(plain["state_hash"], summary["state_hash"]);
    assert!(plain["error"].is_null());
    let both = scratch.run(&[&arguments[..], &["--positions", "-"]].concat());
    assert_eq!(both.code, Some(2), "the summary has no place: {}", both.stderr);
    // A run that goes on from a state has the error of the whole way.
    scratch.succeed(&["simulate", "small.json", "--frames", "6", "--save-state", "six"]);
    let on = scratch.json(&[&arguments[..], &["--from-state", "six", "--json"]].concat());
    assert_eq!((&on["error"], &on["state_hash"]), (error, &summary["state_hash"]));
    // What there is not is not told.
    fs::write(scratch.path("bare.json"), "{}").unwrap();
    let bare = String::from_utf8(scratch.succeed(&["simulate", "bare.json", "--frames", "3"])).unwrap();
    assert!(!["heights", "longest", "rest "].iter().any(|name| bare.contains(name)), "{bare}");
}
