//! What files say of themselves beyond one picture: numbered pictures, animations, meshes and positions.

use std::fs;

use crate::scratch::Scratch;
use crate::verify::{assert_equal, render};

#[test]
fn numbered_pictures_and_animations_prove_themselves() {
    let scratch = Scratch::new();
    let look = ["--size", "64x50", "--frames", "4..19", "--fps", "30", "--shader", "texture"];
    for out in ["f/%d.png", "a.apng", "a.gif"] {
        scratch.succeed(&[&["animate", "small.json", out], &look[..]].concat());
    }
    for file in ["f/0.png", "f/4.png", "a.apng", "a.gif"] {
        for more in [&["--threads", "1"][..], &["small.json"]] {
            let run = scratch.run(&[&["verify", file], more].concat());
            assert_eq!(run.code, Some(0), "{file}: {}", run.stderr);
        }
    }
    render(&scratch, "7", &["--shader", "texture"]);
    assert!(scratch.read("b.png") == scratch.read("f/1.png"), "each is the file that `render` writes");
}

/// Where the bytes of `name` first are in a file.
fn place(bytes: &[u8], name: &[u8]) -> usize {
    bytes.windows(name.len()).position(|window| window == name).unwrap()
}

#[test]
fn an_animation_with_another_time_or_picture_differs() {
    let scratch = Scratch::new();
    let look = ["--size", "16x16", "--frames", "0..9", "--fps", "30"];
    scratch.succeed(&[&["animate", "small.json", "a.gif"], &look[..]].concat());
    let whole = scratch.read("a.gif");
    // The graphic control extension of the first picture: its time.
    let time = place(&whole, b"\x21\xF9\x04") + 4;
    let mut slow = whole.clone();
    slow[time] += 1;
    fs::write(scratch.path("slow.gif"), slow).unwrap();
    let run = scratch.run(&["verify", "slow.gif"]);
    assert_eq!(run.code, Some(1), "{}", run.stderr);
    assert!(run.stderr.contains("not those that it was written with"), "{}", run.stderr);
    // Fewer moments than pictures.
    let moments = place(&whole, b"\"frames\":[0,9]") + 12;
    let mut short = whole;
    short[moments] = b'6';
    fs::write(scratch.path("short.gif"), short).unwrap();
    let run = scratch.run(&["verify", "short.gif"]);
    assert_eq!(run.code, Some(1), "{}", run.stderr);
    assert!(run.stderr.contains("3 pictures instead of 2"), "{}", run.stderr);
}

#[test]
fn an_animation_that_ends_differs_from_one_that_is_shown_for_ever() {
    let scratch = Scratch::new();
    scratch.succeed(&[
        "animate",
        "small.json",
        "a.gif",
        "--size",
        "16x16",
        "--frames",
        "0..4",
        "--fps",
        "30",
    ]);
    assert_eq!(scratch.run(&["verify", "a.gif"]).code, Some(0));
    let mut bytes = scratch.read("a.gif");
    // How often all pictures are shown, 0 for ever.
    let again = place(&bytes, b"NETSCAPE2.0\x03\x01") + 13;
    bytes[again] = 2;
    fs::write(scratch.path("a.gif"), bytes).unwrap();
    let run = scratch.run(&["verify", "a.gif"]);
    assert_eq!(run.code, Some(1), "{}", run.stderr);
    assert!(run.stderr.contains("2 times instead of for ever"), "{}", run.stderr);
}

#[test]
fn nothing_of_the_machine_is_in_a_file_unless_it_is_asked_for() {
    let scratch = Scratch::new();
    fs::create_dir(scratch.path("secret-folder")).unwrap();
    fs::copy(scratch.path("small.json"), scratch.path("secret-folder/secret-scene.json")).unwrap();
    fs::copy(crate::repository::path("textures/texture_1.png"), scratch.path("secret-folder/texture_1.png"))
        .unwrap();
    fs::write(scratch.path("secret-folder/secret-patch.json"), r#"{"cloth": {"ks": 900}}"#).unwrap();
    let path = scratch.path("secret-folder/secret-scene.json");
    let path = path.to_str().unwrap();
    let look =
        ["--patch", "secret-folder/secret-patch.json", "--textures", "secret-folder", "--shader", "texture"];
    let look = [&["--size", "64x50"], &look[..]].concat();
    let write = |more: &[&str]| {
        scratch.succeed(&[&["render", path, "a.png", "--frame", "3"], &look[..], more].concat());
        scratch.succeed(&[&["animate", path, "a.apng", "--frames", "0..2"], &look[..], more].concat());
        scratch.succeed(&[&["animate", path, "a.gif", "--frames", "0..2"], &look[..], more].concat());
        scratch.succeed(&[&["export", path, "a.glb", "--frame", "3"], more].concat());
        let detail = if more.is_empty() { &["--provenance", "scene"] } else { more };
        let positions = ["simulate", path, "--frames", "3", "--positions", "a.npy", "-q", "--json"];
        scratch.succeed(&[&positions, detail].concat());
        ["a.png", "a.apng", "a.gif", "a.glb", "a.npy.json"].map(|name| scratch.read(name))
    };
    let holds = |bytes: &[u8], name: &str| bytes.windows(name.len()).any(|window| window == name.as_bytes());
    for bytes in write(&[]) {
        assert!(holds(&bytes, drape::version::VERSION) && !holds(&bytes, "secret"));
    }
    for bytes in write(&["--provenance", "command"]) {
        assert!(holds(&bytes, "secret-folder/secret-scene.json"));
    }
    assert_equal(&scratch, &["--textures", "secret-folder"]);
}

#[test]
fn a_file_that_has_no_place_for_it_is_named() {
    let scratch = Scratch::new();
    for (out, warned) in [("a.obj", true), ("a.ply", true), ("a.glb", false)] {
        let run = scratch.run(&["export", "small.json", out, "--frame", "1", "--provenance", "hashes"]);
        assert_eq!(run.code, Some(0), "{}", run.stderr);
        assert_eq!(run.stderr.contains("--provenance has no effect"), warned, "{out}: {}", run.stderr);
    }
}
