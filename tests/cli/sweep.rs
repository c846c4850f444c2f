//! `sweep`: whoever runs the cases, and whatever becomes of the workers, the report has the same bytes.

use std::fs;
use std::process::Child;
use std::time::Duration;

use serde_json::{Value, json};

use crate::scratch::Scratch;

/// Cases of which some are refused, one is unstable, and the others end well.
const SPEC: &str = r#"{"scene": "small.json",
    "set": {"cloth.damping": [0.2, 101], "cloth.ks": [50, 5000, 1e9], "sim.integrator": ["verlet", "bdf2"]},
    "frames": 9, "measure": ["total", "by_damping", "largest_stretch", "rest_time", "hash", "outcome"],
    "render": {"material": {"shader": "normal"}, "size": [32, 25]}}"#;

/// The files of a report.
const FILES: [&str; 3] = ["results.csv", "results.json", "index.html"];

fn scratch(spec: &str) -> Scratch {
    let scratch = Scratch::new();
    fs::write(scratch.path("spec.json"), spec).unwrap();
    scratch
}

/// The bytes of the report in a folder.
fn report(scratch: &Scratch, folder: &str) -> [Vec<u8>; 3] {
    FILES.map(|file| scratch.read(&format!("{folder}/{file}")))
}

fn results(scratch: &Scratch, folder: &str) -> Vec<Value> {
    let value: Value = serde_json::from_slice(&scratch.read(&format!("{folder}/results.json"))).unwrap();
    value["results"].as_array().unwrap().clone()
}

/// The files of the store, without claims.
fn stored(scratch: &Scratch, folder: &str, ending: &str) -> Vec<std::path::PathBuf> {
    let folders =
        fs::read_dir(scratch.path(folder).join("results")).unwrap().map(|entry| entry.unwrap().path());
    let files = folders.flat_map(|folder| fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()));
    let mut files: Vec<_> = files.filter(|path| path.to_string_lossy().ends_with(ending)).collect();
    files.sort();
    files
}

#[test]
fn any_division_of_the_work_gives_the_same_bytes() {
    let scratch = scratch(SPEC);
    scratch.succeed(&["sweep", "run", "spec.json", "whole", "-q"]);
    scratch.succeed(&["sweep", "plan", "spec.json", "parts", "-q"]);
    let missing = scratch.run(&["sweep", "report", "parts", "-q"]);
    assert_eq!(missing.code, Some(1));
    assert!(missing.stderr.contains("12 of 12 cases have no result yet"), "{}", missing.stderr);
    for part in ["3/3", "1/3", "2/3", "1/3"] {
        scratch.succeed(&["sweep", "work", "parts", "--part", part, "--threads", "1", "-q"]);
    }
    scratch.succeed(&["sweep", "report", "parts", "-q"]);
    assert!(report(&scratch, "parts") == report(&scratch, "whole"));

    scratch.succeed(&["sweep", "plan", "spec.json", "both", "-q"]);
    let workers = [1, 2].map(|_| scratch.command(&["sweep", "work", "both", "-q"]).spawn().unwrap());
    assert!(workers.map(|mut worker: Child| worker.wait().unwrap().success()) == [true; 2]);
    scratch.succeed(&["sweep", "report", "both", "-q"]);
    assert!(report(&scratch, "both") == report(&scratch, "whole"));
    // Nothing is run again.
    let again = scratch.json(&["sweep", "work", "both", "--json"]);
    assert_eq!((&again["made"], &again["cases"]), (&json!(0), &json!(12)));
}

#[test]
fn a_case_ends_as_the_command_that_repeats_it() {
    let scratch = scratch(SPEC);
    scratch.succeed(&["sweep", "run", "spec.json", "out", "-q"]);
    let mut codes = Vec::new();
    for result in results(&scratch, "out") {
        let sets =
            result["changes"].as_object().unwrap().iter().map(|(path, value)| format!("{path}={value}"));
        let sets: Vec<String> = sets.flat_map(|set| ["--set".to_owned(), set]).collect();
        let mut words = vec!["simulate", "small.json", "--frames", "9", "--ledger", "--json"];
        words.extend(sets.iter().map(String::as_str));
        let run = scratch.run(&words);
        codes.push(run.code.unwrap());
        assert_eq!(result["exit_code"], json!(run.code), "{result}");
        if run.code == Some(0) {
            let summary = run.object();
            assert_eq!(result["values"]["hash"], summary["state_hash"], "{result}");
            let table = scratch.succeed(&[&words[..4], &words[6..], &["--csv", "-"]].concat());
            let table = String::from_utf8(table).unwrap();
            let fields = |line: &str| line.split(',').map(str::to_owned).collect::<Vec<_>>();
            let (head, last) = (fields(table.lines().next().unwrap()), fields(table.lines().last().unwrap()));
            for name in ["total", "by_damping", "largest_stretch"] {
                let place = head.iter().position(|column| column == name).unwrap();
                assert_eq!(
                    result["values"][name],
                    json!(last[place].parse::<f64>().unwrap()),
                    "{name} of {result}"
                );
            }
        } else {
            assert_eq!(result["message"], run.error()["error"], "{result}");
        }
    }
    codes.sort_unstable();
    assert_eq!(codes, [0, 0, 0, 0, 0, 3, 3, 3, 3, 3, 3, 5]);
    let text = String::from_utf8(scratch.read("out/results.csv")).unwrap();
    let head = "case,id,cloth.damping,cloth.ks,sim.integrator,exit_code,message,total,by_damping,largest_stretch,rest_time,hash,outcome";
    assert_eq!((text.lines().next(), text.lines().count()), (Some(head), 13));
    assert_eq!(text.matches(",unstable\n").count() + text.matches(",refused\n").count(), 7);
    assert_eq!(stored(&scratch, "out", ".png").len(), 5);
    // The picture is the one of `render`, pixel by pixel.
    let first = &results(&scratch, "out")[0]["id"];
    let stored = stored(&scratch, "out", &format!("{}.png", first.as_str().unwrap()));
    let sets =
        ["--set", "cloth.damping=0.2", "--set", "cloth.ks=50", "--shader", "normal", "--size", "32x25"];
    scratch.succeed(&[&["render", "small.json", "a.png", "--frame", "9", "-q"], &sets[..]].concat());
    scratch.succeed(&["compare", "a.png", stored[0].to_str().unwrap()]);
}

/// A sweep of so many cases that take a while each.
fn slow(count: u32) -> String {
    format!(
        r#"{{"scene": "small.json", "set": {{"cloth.ks": {{"from": 50, "to": 5000, "count": {count}, "scale": "log"}}}},
        "frames": 100, "measure": ["total", "hash"], "render": {{"size": [16, 16]}}}}"#
    )
}

#[test]
fn workers_that_are_killed_lose_no_case() {
    let scratch = scratch(&slow(60));
    scratch.succeed(&["sweep", "run", "spec.json", "whole", "-q"]);
    scratch.succeed(&["sweep", "plan", "spec.json", "out", "-q"]);
    let mut rounds = 0_u64;
    while stored(&scratch, "out", ".jsonl").len() < 20 {
        let work = ["sweep", "work", "out", "-q", "--threads", "1"];
        let mut workers = [0, 1, 2].map(|_| scratch.command(&work).spawn().unwrap());
        for (number, worker) in (0..).zip(&mut workers) {
            // Anywhere between the start of the program and some cases later, later from round to round.
            let pause = drape::math::splitmix64(rounds * 3 + number) % (20 * (rounds + 1));
            std::thread::sleep(Duration::from_millis(pause));
            worker.kill().unwrap();
            worker.wait().unwrap();
        }
        rounds += 1;
    }
    assert!(rounds > 2, "workers were killed before they were through");
    scratch.succeed(&["sweep", "work", "out", "-q"]);
    scratch.succeed(&["sweep", "report", "out", "-q"]);
    assert!(report(&scratch, "out") == report(&scratch, "whole"));
}

#[test]
fn what_is_claimed_by_nobody_or_damaged_is_run_all_the_same() {
    let scratch = scratch(SPEC);
    scratch.succeed(&["sweep", "run", "spec.json", "out", "-q"]);
    let before = report(&scratch, "out");
    // Claims of workers that are gone.
    for file in stored(&scratch, "out", ".jsonl") {
        let claims = scratch.path("out/results/claims");
        fs::create_dir_all(&claims).unwrap();
        fs::write(claims.join(file.file_stem().unwrap()), "").unwrap();
    }
    let results = stored(&scratch, "out", ".jsonl");
    fs::remove_file(&results[0]).unwrap();
    let text = fs::read_to_string(&results[1]).unwrap();
    fs::write(&results[1], text.replacen("values", "valuse", 1)).unwrap();
    fs::write(&results[2], &text.as_bytes()[..20]).unwrap();
    let pictures = stored(&scratch, "out", ".png");
    // Of a case whose result is whole.
    let last = pictures.last().unwrap();
    let mut picture = fs::read(last).unwrap();
    picture[50] ^= 1;
    fs::write(last, picture).unwrap();
    let reported = scratch.run(&["sweep", "report", "out"]);
    assert_eq!(reported.code, Some(1));
    let run = scratch.run(&["sweep", "work", "out"]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    assert!(run.stderr.contains("warning: the result of case ") && run.stderr.contains("it is run again"));
    scratch.succeed(&["sweep", "report", "out", "-q"]);
    assert!(report(&scratch, "out") == before);
}

#[test]
fn a_plan_keeps_what_it_was_made_of_and_a_larger_one_keeps_its_results() {
    let scratch = scratch(&slow(3));
    scratch.succeed(&["sweep", "run", "spec.json", "out", "-q"]);
    let before = report(&scratch, "out");
    fs::write(scratch.path("small.json"), "{}").unwrap();
    assert_eq!(
        scratch.json(&["sweep", "work", "out", "--json"])["made"],
        json!(0),
        "the scene of the plan counts"
    );
    scratch.succeed(&["sweep", "report", "out", "-q"]);
    assert!(report(&scratch, "out") == before);
    fs::write(scratch.path("small.json"), crate::scratch::SMALL).unwrap();
    fs::write(scratch.path("spec.json"), slow(5)).unwrap();
    // 50, 158, 500, 1580, 5000 has three of them.
    assert_eq!(scratch.json(&["sweep", "run", "spec.json", "out", "--json"])["made"], json!(2));
    assert_eq!(results(&scratch, "out").len(), 5);
}

#[test]
fn a_case_out_of_time_is_a_result() {
    let scratch = scratch(
        r#"{"scene": "small.json", "set": {"cloth.ks": [50, 500]}, "frames": 100000000, "measure": ["outcome"],
        "time_limit": 0.05}"#,
    );
    scratch.succeed(&["sweep", "run", "spec.json", "out", "-q"]);
    for result in results(&scratch, "out") {
        assert_eq!((&result["exit_code"], &result["values"]["outcome"]), (&json!(6), &json!("out of time")));
        assert_eq!(result["message"], "out of time: the case took more than 0.05 s");
    }
}

#[test]
fn a_plan_is_asked_for_and_one_that_was_changed_is_refused() {
    let scratch = scratch(&slow(3));
    let run = scratch.run(&["sweep", "work", "out"]);
    assert_eq!(run.code, Some(6));
    assert!(run.stderr.contains("plan the sweep first: drape sweep plan SPEC OUT"), "{}", run.stderr);
    scratch.succeed(&["sweep", "plan", "spec.json", "out", "-q"]);
    let cases = String::from_utf8(scratch.read("out/cases.jsonl")).unwrap();
    let ids: Vec<Value> = cases.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    assert_eq!(
        ids.iter().map(|case| &case["changes"]["cloth.ks"]).collect::<Vec<_>>(),
        [&json!(50), &json!(500), &json!(5000)]
    );
    fs::write(scratch.path("out/cases.jsonl"), cases.replace(":500}", ":501}")).unwrap();
    let run = scratch.run(&["sweep", "work", "out", "--threads", "1"]);
    assert_eq!(run.code, Some(6));
    assert!(run.stderr.contains("line 2 of cases.jsonl is not one of this plan"), "{}", run.stderr);
}
