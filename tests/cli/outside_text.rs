//! Text from outside, such as names of files and keys of scenes, reaches a terminal, a table or a page only as text.
#![cfg(unix)]

use std::ffi::OsStr;
use std::fs;

use drape::output::png::{self, Effort};

use crate::scratch::{Run, SMALL, Scratch};

/// Escape sequences that clear and colour a terminal, a forged line, a control character beyond ASCII, ends of lines
/// that JavaScript sees, a mark that turns the writing, and markup.
const NAME: &str = "a\u{1b}[2J\u{7}\nerror: forged\r\u{9b}31m\u{2028}\u{202e}<script>&\"'b";

fn acts(c: char) -> bool {
    c.is_control() && !matches!(c, '\n' | '\t')
        || matches!(c, '\u{2028}' | '\u{2029}' | '\u{202a}'..='\u{202e}')
}

fn assert_harmless(what: &str, run: &Run) {
    let stdout = String::from_utf8(run.stdout.clone()).unwrap();
    for text in [&stdout, &run.stderr] {
        assert!(!text.chars().any(acts), "{what}: {text:?}");
        assert!(!text.contains("\nerror: forged"), "{what}: {text}");
    }
}

#[test]
fn messages_and_results_show_names_and_do_not_act() {
    let scratch = Scratch::new();
    let scene = format!("{NAME}.json");
    fs::write(scratch.path(&scene), SMALL).unwrap();
    fs::write(scratch.path("invalid.json"), format!("{{\"cloth\": {{\"x{}\": 1}}}}", "\u{9b}\u{2028}"))
        .unwrap();
    let escaped = "{\"cl\\u001both\\n\\u202e\": 1, \"material\": {\"texture\": \"\\u001b[31m\"}}";
    fs::write(scratch.path("escaped.json"), escaped).unwrap();
    fs::write(scratch.path("no.png"), "no picture").unwrap();
    let [mesh, other] = [format!("{NAME}mesh"), format!("{NAME}other")];
    let [obj, png, set, sequence] =
        [format!("{NAME}.obj"), format!("{NAME}.png"), format!("{NAME}=1"), format!("{NAME}d/%d.png")];
    let drawn: &[&str] = &["--frame", "0", "--size", "8x8"];
    for (arguments, code) in [
        (vec!["check", &scene], 0),
        (vec!["check", "invalid.json"], 3),
        (vec!["check", "escaped.json"], 3),
        (vec!["render", "invalid.json"], 3),
        (vec!["render", "escaped.json"], 3),
        (vec!["info", &scene], 0),
        (vec!["simulate", &scene, "--frames", "1"], 0),
        ([&["render", &scene, &png], drawn].concat(), 0),
        ([&["render", &png, "o.png"], drawn].concat(), 3),
        ([&["render", NAME, "o.png"], drawn].concat(), 6),
        ([&["render", &scene, &other], drawn].concat(), 0),
        (vec!["animate", &scene, &sequence, "--frames", "0..1", "--size", "8x8"], 0),
        (vec!["animate", &scene, NAME], 2),
        (vec!["export", &scene, &obj, "--materials", "--frame", "0"], 2),
        (vec!["export", &scene, &mesh, "--frame", "0"], 0),
        (vec!["compare", &png, "no.png"], 6),
        (vec!["compare", NAME, &scene], 6),
        (vec!["compare-positions", &scene, NAME], 6),
        (vec!["simulate", &scene, "--set", &set], 3),
        (vec!["simulate", &scene, "--patch", NAME], 6),
        (vec!["simulate", &scene, "--from-state", &png], 6),
        (vec!["render", &scene, "--shader", NAME], 2),
        (vec!["render", &scene, "--shader", "texture", "--textures", NAME], 3),
        (vec!["sweep", "run", NAME, "out"], 6),
        (vec!["sweep", "run", &scene, "out"], 3),
        (vec!["sweep", "report", NAME], 6),
        (vec![NAME], 2),
    ] {
        for json in [&[][..], &["--json"]] {
            let run = scratch.run(&[&arguments, json].concat());
            assert_harmless(&format!("{arguments:?}"), &run);
            assert_eq!(run.code, Some(code), "{arguments:?}: {}", run.stderr);
            let lines = run.stderr.lines();
            let objects = |line: &str| serde_json::from_str::<serde_json::Value>(line).is_ok();
            assert!(json.is_empty() || lines.into_iter().all(objects), "{arguments:?}: {}", run.stderr);
        }
    }
}

#[test]
fn tables_and_pages_hold_names_and_not_markup() {
    let scratch = Scratch::new();
    let scene = format!("{NAME}.json");
    fs::write(scratch.path(&scene), SMALL).unwrap();
    let values = serde_json::json!([NAME, "texture_1"]);
    let spec = serde_json::json!({"scene": scene, "set": {"material.texture": values}, "frames": 1,
        "measure": ["hash", "kinetic"]});
    fs::write(scratch.path("spec.json"), spec.to_string()).unwrap();
    let out = format!("{NAME}.out");
    let run = scratch.run(&["sweep", "run", "spec.json", &out]);
    assert_harmless("sweep", &run);
    for name in ["results.csv", "index.html", "results.json"] {
        let text = fs::read_to_string(scratch.path(&out).join(name)).unwrap();
        assert!(!text.chars().any(acts), "{name}: {text:?}");
        assert!(name != "index.html" || !text.contains("<script>&"), "markup in {name}");
    }
    let csv = fs::read_to_string(scratch.path(&out).join("results.csv")).unwrap();
    assert_eq!(csv.lines().count(), 3, "a line a case: {csv}");

    let page = format!("{NAME}.html");
    scratch.succeed(&["horizon", &scene, &page, "--frame", "2", "-q"]);
    let text = fs::read_to_string(scratch.path(&page)).unwrap();
    assert!(!text.chars().any(acts) && !text.contains("<script>&"), "{text}");
}

#[test]
fn a_name_that_is_no_text_is_shown_as_far_as_it_can() {
    use std::os::unix::ffi::OsStrExt;
    let scratch = Scratch::new();
    let mut command = scratch.command(&["render"]);
    let run: Run = command.arg(OsStr::from_bytes(b"no\xff\x1b.json")).output().unwrap().into();
    assert_eq!(run.code, Some(6), "{}", run.stderr);
    assert_harmless("not UTF-8", &run);
}

#[test]
fn lines_of_results_are_those_of_the_program() {
    let scratch = Scratch::new();
    fs::create_dir_all(scratch.path("a")).unwrap();
    fs::create_dir_all(scratch.path("b")).unwrap();
    let (picture, broken) = (format!("{NAME}.png"), format!("{NAME}.gif"));
    let drawn = |name: &str| {
        scratch.succeed(&["render", "small.json", name, "--frame", "0", "--size", "8x8", "-q"]);
    };
    for name in [&format!("a/{picture}"), &format!("b/{picture}"), "a/only.png"] {
        drawn(name);
    }
    for name in [format!("a/{broken}"), format!("b/{broken}"), format!("b/{NAME}")] {
        fs::write(scratch.path(&name), "no picture").unwrap();
    }
    drawn(&format!("b/{NAME}other.png"));
    let run = scratch.run(&["compare", "a", "b"]);
    assert_harmless("compare", &run);
    assert_eq!((run.code, run.stdout.iter().filter(|&&byte| byte == b'\n').count()), (Some(6), 5));

    drawn("a.png");
    let pixels = png::read(&scratch.path("a.png")).unwrap();
    let rgb: Vec<u8> = pixels.rgba.iter().flat_map(|pixel| pixel[..3].to_vec()).collect();
    let mut texts = png::texts(&scratch.read("a.png")).unwrap();
    for (_, text) in
        texts.iter_mut().filter(|(keyword, _)| keyword == "drape:version" || keyword == "drape:state")
    {
        text.push_str("\nequal\nerror: forged");
    }
    fs::write(scratch.path("a.png"), png::encode_with(8, 8, &rgb, Effort::Small, &texts).unwrap()).unwrap();
    let run = scratch.run(&["verify", "a.png"]);
    assert_harmless("verify", &run);
    let text = String::from_utf8(run.stdout).unwrap();
    assert_eq!((run.code, text.lines().any(|line| line == "equal")), (Some(1), false), "{text}");
}
