//! Every failure has its exit code, says what is wrong, and leaves no file.

use crate::scratch::{Run, Scratch};
use std::fs;

/// Runs the program plainly and with `--json`; both must fail with `code`, print nothing, create
/// no file, and say an error of `kind`. Returns the error's JSON and the plain message.
pub(crate) fn fails(
    scratch: &Scratch,
    arguments: &[&str],
    code: i32,
    kind: &str,
) -> (serde_json::Value, String) {
    let before = scratch.names();
    let plain = scratch.run(arguments);
    assert_eq!(plain.code, Some(code), "{arguments:?}: {}", plain.stderr);
    assert!(plain.stderr.starts_with("error"), "{arguments:?}: {}", plain.stderr);
    assert!(!plain.stderr.contains("panicked"), "{arguments:?}: {}", plain.stderr);
    let json = scratch.run(&[arguments, &["--json"]].concat());
    assert_eq!(json.code, Some(code), "{arguments:?}: {}", json.stderr);
    let error = json.error();
    assert_eq!(error["exit_code"], code, "{error}");
    assert_eq!(error["kind"], kind, "{error}");
    assert!(error["error"].as_str().is_some_and(|message| !message.is_empty()), "{error}");
    for Run { stdout, .. } in [&plain, &json] {
        assert_eq!(stdout, b"", "{arguments:?} printed something");
    }
    assert_eq!(scratch.names(), before, "{arguments:?} left a file");
    (error, plain.stderr)
}

#[test]
fn a_wrong_command_line_is_2() {
    let scratch = Scratch::new();
    let scene = "small.json";
    for arguments in [
        &["frobnicate"][..],
        &["render"],
        &["render", scene, "--nonsense"],
        &["render", scene, "out.png", "--threads", "0"],
        &["render", scene, "out.png", "--threads", "1025"],
        &["render", scene, "out.png", "--threads", "two"],
        &["render", scene, "out.png", "--time", "1", "--frame", "1"],
        &["render", scene, "out.png", "--time", "-1"],
        &["render", scene, "out.png", "--time", "nan"],
        &["render", scene, "out.png", "--time", "1e999"],
        &["render", scene, "out.png", "--frame", "1.5"],
        &["render", scene, "out.png", "--shader", "fong"],
        &["render", scene, "out.png", "--size", "0x1"],
        &["render", scene, "out.png", "--size", "20000x1"],
        &["render", scene, "out.png", "--samples", "3"],
        &["render", scene, "out.png", "-a", "1"],
        &["render", scene, "out.png", "-o", "2"],
        &["render", scene, "out.png", "--springs", "elastic"],
        &["render", scene, "out.png", "--bench", "1"],
        &["render", scene, "--bench", "0"],
        &["render", scene, "out.jpg"],
        &["render", scene, "small.json"],
        &["render", scene, "out.png", "--depth", "out.png"],
        &["render", scene, "out.png", "--set", "cloth.ks"],
        &["render", scene, "-", "--stats"],
        &["animate", scene],
        &["animate", scene, "-"],
        &["animate", scene, "out.png"],
        &["animate", scene, "out.webm"],
        &["animate", scene, "%d/out.png"],
        &["animate", scene, "out.apng", "--frames", "3..3"],
        &["animate", scene, "out.apng", "--frames", "3"],
        &["animate", scene, "out.apng", "--fps", "0"],
        &["animate", scene, "out.apng", "--fps", "1001"],
        &["animate", scene, "out.apng", "--fps", "29.97"],
        &["animate", scene, "out.gif", "--fps", "51"],
        &["simulate", scene, "--positions", "small.json"],
        &["simulate", scene, "--hash", "--bench"],
        &["simulate", scene, "--frames", "1", "--time", "1"],
        &["export", scene],
        &["export", scene, "out.stl"],
        &["compare", scene],
        &["compare", scene, "."],
        &["compare", "a", "b", "--budget", "0:1"],
        &["compare-positions", scene],
        &["compare-positions", scene, "p", "--tolerance", "-1"],
        &["compare-positions", scene, "p", "--frame", "1", "--frames", "0..1"],
        &["check"],
        &["completions", "tcsh"],
        &["man", "frobnicate"],
        &["info", scene, "-q", "-v"],
        &["info", scene, "--color", "red"],
    ] {
        fails(&scratch, arguments, 2, "usage");
    }
    assert_eq!(scratch.read(scene), crate::scratch::SMALL.as_bytes(), "the scene is untouched");
}

#[test]
fn bytes_and_json_do_not_share_standard_output() {
    let scratch = Scratch::new();
    for arguments in
        [&["render", "small.json", "-", "--json"], &["simulate", "small.json", "--positions=-", "--json"]]
    {
        let run = scratch.run(arguments);
        assert_eq!((run.code, run.stdout.len()), (Some(2), 0), "{arguments:?}");
    }
}

#[test]
fn no_command_is_2_and_shows_the_help() {
    let run = Scratch::new().run(&[]);
    assert_eq!((run.code, run.stdout.len()), (Some(2), 0));
    assert!(run.stderr.contains("Usage: drape"), "{}", run.stderr);
    assert!(run.stderr.starts_with("A reference cloth simulator"), "{}", run.stderr);
    assert!(!run.stderr.contains("error:"), "{}", run.stderr);
}

#[test]
fn an_invalid_scene_is_3_and_names_every_place() {
    let scratch = Scratch::new();
    let broken =
        crate::scratch::SMALL.replace("\"ks\"", "\"kss\"").replace("\"radius\": 0.2", "\"radius\": -1");
    fs::write(scratch.path("broken.json"), broken).unwrap();
    fs::write(scratch.path("empty.json"), "").unwrap();
    for command in [&["render"][..], &["simulate"], &["info"], &["export"]] {
        let out: &[&str] = if command == ["export"] { &["out.obj"] } else { &[] };
        let arguments = [command, &["broken.json"], out].concat();
        let (error, plain) = fails(&scratch, &arguments, 3, "scene");
        let diagnostics = error["diagnostics"].as_array().unwrap();
        let keys: Vec<_> = diagnostics.iter().map(|d| d["key"].as_str().unwrap()).collect();
        assert!(keys.contains(&"cloth.kss") && keys.contains(&"sphere.radius"), "{keys:?}");
        for diagnostic in diagnostics {
            assert_eq!(diagnostic["file"], "broken.json");
            assert!(diagnostic["line"].as_u64() > Some(0) && diagnostic["column"].as_u64() > Some(0));
        }
        assert!(plain.contains("broken.json:3:") && plain.contains('^'), "{plain}");
    }
    fails(&scratch, &["simulate", "empty.json"], 3, "scene");
    fails(&scratch, &["simulate", "small.json", "--set", "cloth.ks=true"], 3, "scene");
}

#[test]
fn a_missing_texture_is_3_before_anything_is_simulated() {
    let scratch = Scratch::new();
    // The simulation would be refused as unstable.
    let stiff = "cloth.ks=1e12";
    let arguments =
        ["render", "small.json", "out.png", "--shader", "texture", "--textures", "no", "--set", stiff];
    fails(&scratch, &arguments, 3, "scene");
}

#[test]
fn nothing_to_do_is_4() {
    let scratch = Scratch::new();
    fs::write(scratch.path("bare.json"), "{}").unwrap();
    fails(&scratch, &["export", "bare.json", "out.obj"], 4, "nothing");
    fails(&scratch, &["animate", "small.json", "out.gif", "--set", "render.time=0"], 4, "nothing");
    fs::create_dir(scratch.path("a")).unwrap();
    fs::create_dir(scratch.path("b")).unwrap();
    fails(&scratch, &["compare", "a", "b"], 4, "nothing");
}

#[test]
fn an_unstable_scene_is_5_before_the_first_step_and_when_it_is_let_run() {
    let scratch = Scratch::new();
    let stiff = ["--set", "cloth.ks=1e12"];
    for command in [
        &["render", "small.json", "out.png"][..],
        &["simulate", "small.json", "--positions", "out"],
        &["export", "small.json", "out.obj"],
        &["animate", "small.json", "out.apng"],
    ] {
        let (error, _) = fails(&scratch, &[command, &stiff].concat(), 5, "unstable");
        assert!(error["error"].as_str().unwrap().contains("before the first step: dt·ω = "), "{error}");
        assert!(
            error["help"].as_str().unwrap().starts_with("raise steps_per_frame from 30 to at least "),
            "{error}"
        );
        // The stretch limit would hold the points together.
        let allowed =
            [command, &stiff, &["--set", "sim.stretch_limit=null", "--allow-unstable", "-q"]].concat();
        let (error, _) = fails(&scratch, &allowed, 5, "unstable");
        assert!(error["error"].as_str().unwrap().contains("at step"), "{error}");
    }
    scratch.succeed(&["simulate", "small.json", "--frames", "0", "--set", "cloth.ks=1e12"]);
}

/// A cloth a little over the bound at rest: what the message asks for at rest is let run, with the
/// warning that it is only stable there; what it asks for at worst is let run without. Both hold to
/// the last digit.
#[test]
fn the_advice_before_the_first_step_holds() {
    let scratch = Scratch::new();
    let run = |sets: [&str; 2]| {
        scratch.run(&["simulate", "small.json", "--frames", "1", "--set", sets[0], "--set", sets[1]])
    };
    let refused = run(["cloth.ks=4e7", "sim.steps_per_frame=30"]);
    assert_eq!(refused.code, Some(5));
    let number = |text: &str| -> f64 {
        let rest = refused.stderr.split(text).nth(1).expect(text);
        rest.split([' ', ';']).next().unwrap().parse().unwrap()
    };
    let (steps, softer) = (number("to at least "), number("lower ks to at most "));
    let softer_worst = number(&format!("{softer} at rest, "));
    let steps_worst = number(&format!("to at least {steps} at rest, "));
    for (ks, steps, code, warns) in [
        (4e7, steps - 1.0, 5, false),
        (4e7, steps, 0, true),
        (4e7, steps_worst - 1.0, 0, true),
        (4e7, steps_worst, 0, false),
        (softer, 30.0, 0, true),
        (more(softer), 30.0, 5, false),
        (softer_worst, 30.0, 0, false),
        (more(softer_worst), 30.0, 0, true),
    ] {
        let ran = run([&format!("cloth.ks={ks}"), &format!("sim.steps_per_frame={steps}")]);
        assert_eq!(ran.code, Some(code), "ks {ks}, {steps} steps: {}", ran.stderr);
        assert_eq!(
            ran.stderr.contains("may become unstable"),
            warns,
            "ks {ks}, {steps} steps: {}",
            ran.stderr
        );
    }
}

/// One more in the last of the four digits of `ks`.
fn more(ks: f64) -> f64 {
    let text = format!("{ks:.3e}");
    let (digits, exponent) = text.split_once('e').expect("an exponent");
    let digits: f64 = digits.parse().expect("digits");
    format!("{:.3}e{exponent}", digits + 0.001).parse().expect("a number")
}

/// The largest ks that `info` prints is stable, one more in its last digit is not.
#[test]
fn info_tells_the_largest_ks_to_the_last_digit() {
    let scratch = Scratch::new();
    for set in [
        "cloth.damping=0",
        "cloth.damping=3",
        "cloth.density=7",
        "sim.steps_per_frame=7",
        "cloth.enable_shearing=false",
        "sim.damping=per_second",
        "cloth.ks=123",
    ] {
        let info = |ks: f64| {
            let ks = format!("cloth.ks={ks}");
            scratch.json(&[
                "info",
                "small.json",
                "--json",
                "--set",
                "cloth.ks=5000",
                "--set",
                set,
                "--set",
                &ks,
            ])["cloth"]
                .take()
        };
        let cloth = scratch.json(&["info", "small.json", "--json", "--set", set])["cloth"].take();
        let [rest, worst] = ["rest", "worst"].map(|at| cloth[format!("largest_ks_{at}")].as_f64().unwrap());
        let said = String::from_utf8(scratch.succeed(&["info", "small.json", "--set", set])).unwrap();
        let line = format!("ks          at most {rest} N/m at rest, {worst} at worst, at ");
        assert!(said.contains(&line), "{line}: {said}");
        let stable = [worst, more(worst), rest, more(rest)].map(|ks| info(ks)["stable"].take());
        assert_eq!(stable, ["stable", "stable at rest", "stable at rest", "unstable"], "{set}: {line}");
    }
    let slack = scratch.json(&["info", "small.json", "--json", "--set", "cloth.ks=0"]);
    assert!(slack["cloth"]["largest_ks_rest"].is_null(), "no stiffness, no bound: {slack}");
}
