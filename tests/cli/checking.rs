//! `check` and what it foresees: it fails where `render` would, and warns of what stops a later command.

use std::fs;

use crate::errors::fails;
use crate::scratch::Scratch;

#[test]
fn check_tells_everything_and_is_3_if_any_scene_is_wrong() {
    let scratch = Scratch::new();
    fs::write(scratch.path("a.json"), r#"{"clot": {}, "sim": {"fps": 0}}"#).unwrap();
    fs::write(scratch.path("b.json"), r#"{"sim": {"fps": "x"}}"#).unwrap();
    assert_eq!(scratch.run(&["check", "small.json"]).code, Some(0));
    let run = scratch.run(&["check", "a.json", "no.json", "small.json", "b.json", "--json"]);
    assert_eq!((run.code, &run.error()["kind"]), (Some(3), &"scene".into()));
    let object = run.object();
    let files = object["files"].as_array().unwrap();
    let errors: Vec<_> = files.iter().map(|file| file["errors"].as_array().unwrap().len()).collect();
    assert_eq!(errors, [2, 0, 0, 1]);
    assert!(files[1]["failure"].as_str().unwrap().contains("no.json"));
    let plain = scratch.run(&["check", "a.json", "b.json"]);
    assert_eq!(plain.code, Some(3));
    let text = String::from_utf8(plain.stdout).unwrap();
    assert!(text.contains("a.json:1:2") && text.contains("b.json:1:17"), "{text}");
    assert_eq!(scratch.run(&["check", "a.json", "no.json"]).code, Some(3));
    assert_eq!(scratch.run(&["check", "no.json", "a.json"]).code, Some(3));
    assert_eq!(scratch.run(&["check", "no.json", "small.json"]).code, Some(6));
    assert_eq!(scratch.run(&["check", "small.json", "--set", "cloth.ks=-1"]).code, Some(3));
}

#[test]
fn check_fails_where_render_would() {
    let scratch = Scratch::new();
    fs::create_dir(scratch.path("set")).expect("a folder");
    fs::create_dir(scratch.path("set/texture_1.png")).expect("a folder in place of a picture");
    let read = ["--set", "material.shader=texture"];
    for (arguments, code) in [
        (&[&read[..], &["--set", "material.texture=granite"]].concat(), "check::texture"),
        (&[&read[..], &["--textures", "set"]].concat(), "check::texture"),
        (&vec!["--set", "material.shader=mirror", "--textures", "set"], "check::texture"),
    ] {
        let render =
            scratch.run(&[&["render", "small.json", "out.png", "--frame", "0"], &arguments[..]].concat());
        let check = [&["check", "small.json", "--json"], &arguments[..]].concat();
        let run = scratch.run(&check);
        assert_eq!((run.code, render.code), (Some(3), Some(3)), "{arguments:?}: {}", render.stderr);
        let files: serde_json::Value = serde_json::from_slice(&run.stdout).expect("JSON");
        assert_eq!(files["files"][0]["errors"][0]["code"], code, "{files}");
    }
}

#[test]
fn check_foresees_what_would_stop_a_later_command_and_does_not_fail() {
    let scratch = Scratch::new();
    fs::create_dir(scratch.path("set")).expect("a folder");
    let stiff = ["--set", "cloth.ks=1e12"];
    for (arguments, codes, says) in [
        (&[][..], &[][..], "valid"),
        (&["--set", "material.texture=granite"], &["scene::without_effect", "check::texture"], "granite"),
        (
            &["--set", "sphere.material.environment=hall"],
            &["scene::without_effect", "check::texture"],
            "built in: cube",
        ),
        (&["--textures", "set"], &["check::without_effect"], "--textures has no effect"),
        (&["--set", "material.shader=texture"], &[], "valid"),
        (&[&stiff[..], &["--set", "sim.integrator=xpbd"]].concat(), &[], "valid"),
        (&stiff, &["check::unstable"], "dt·ω"),
    ] {
        let arguments = [&["check", "small.json", "--set", "cloth.thickness=0"], arguments].concat();
        let text = String::from_utf8(scratch.succeed(&arguments)).expect("text");
        let verdict = ["valid", "valid, with a warning", "valid, with 2 warnings"][codes.len()];
        assert!(text.contains(says), "{arguments:?}: {text}");
        assert!(text.ends_with(&format!("small.json: {verdict}\n")), "{arguments:?}: {text}");
        let object = scratch.json(&[&arguments[..], &["--json"]].concat());
        let warnings = object["files"][0]["warnings"].as_array().expect("a list").iter();
        let found: Vec<_> = warnings.map(|warning| warning["code"].as_str().expect("a code")).collect();
        assert_eq!(found, codes, "{arguments:?}");
    }
}

#[test]
fn a_picture_larger_than_memory_is_3() {
    let scratch = Scratch::new();
    let large = ["render", "small.json", "out.png", "--size", "16384x16384", "--samples", "4"];
    let (error, _) = fails(&scratch, &large, 3, "scene");
    let found = &error["diagnostics"][0];
    assert_eq!((&found["code"], &found["key"]), (&"scene::too_many_samples".into(), &"render.size".into()));
    assert!(found["help"].as_str().is_some_and(|help| help.contains("268435456")), "{error}");
    // What would be drawn is checked without drawing it.
    let large = ["--set", "render.size=[16384,16384]", "--set", "render.samples=4"];
    assert_eq!(scratch.run(&[&["check", "small.json"], &large[..]].concat()).code, Some(3));
}

#[test]
fn a_camera_whose_distance_is_lost_in_its_target_is_no_error() {
    let scratch = Scratch::new();
    let far = ["--set", "camera.target=[0,0,1e15]", "--set", "camera.distance=0.05"];
    let run = scratch.run(&[&["render", "small.json", "out.png", "--frame", "0"], &far[..]].concat());
    assert!(run.code == Some(0) && run.stderr.contains("no object is visible"), "{}", run.stderr);
}
