//! A picture proves itself: `verify` makes it again from what it says, and finds whatever was changed in it.

use std::fs;

use drape::output::png::{self, Effort};
use serde_json::Value;

use crate::scratch::{Run, SMALL, Scratch, scene};

const LOOK: [&str; 4] = ["--size", "64x50", "--frame", "12"];

/// A picture `a.png` of the small scene.
fn drawn(more: &[&str]) -> Scratch {
    let scratch = Scratch::new();
    scratch.succeed(&[&["render", "small.json", "a.png"], &LOOK[..], more].concat());
    scratch
}

/// Draws a frame of the small scene to `b.png`.
pub(crate) fn render(scratch: &Scratch, frame: &str, more: &[&str]) {
    let look = ["render", "small.json", "b.png", "--size", "64x50", "--frame", frame];
    scratch.succeed(&[&look, more].concat());
}

/// The report on `a.png`, which must end with this exit code.
fn report(scratch: &Scratch, code: i32, more: &[&str]) -> Value {
    let run = scratch.run(&[&["verify", "a.png", "--json"], more].concat());
    assert_eq!(run.code, Some(code), "{more:?}: {}", run.stderr);
    serde_json::from_slice(&run.stdout).unwrap()
}

pub(crate) fn assert_equal(scratch: &Scratch, more: &[&str]) {
    let report = report(scratch, 0, more);
    assert_eq!((&report["equal"], &report["differs"]), (&true.into(), &Value::Null), "{more:?}");
}

/// Writes `a.png` again after `change` of its colours and of what it says of itself.
fn doctor(scratch: &Scratch, change: impl FnOnce(&mut Vec<u8>, &mut Vec<(String, String)>)) {
    let pixels = png::read(&scratch.path("a.png")).unwrap();
    let mut rgb: Vec<u8> = pixels.rgba.iter().flat_map(|pixel| pixel[..3].to_vec()).collect();
    let mut texts = png::texts(&scratch.read("a.png")).unwrap();
    change(&mut rgb, &mut texts);
    let bytes = png::encode_with(pixels.width, pixels.height, &rgb, Effort::Small, &texts).unwrap();
    fs::write(scratch.path("a.png"), bytes).unwrap();
}

/// The text of a keyword.
fn text<'a>(texts: &'a mut [(String, String)], keyword: &str) -> &'a mut String {
    &mut texts.iter_mut().find(|(known, _)| known == keyword).unwrap().1
}

fn hash(rgb: &[u8]) -> String {
    let mut hash = drape::math::StateHash::default();
    hash.write(rgb);
    format!("{:016x}", hash.finish())
}

#[test]
fn pictures_of_the_stock_scenes_are_equal_for_other_threads_too() {
    let scratch = Scratch::new();
    for name in ["pinned2", "pinned4", "sphere", "plane", "selfCollision", "table"] {
        let path = scene(&format!("{name}.json"));
        scratch.succeed(&[&["render", &path, "a.png", "--threads", "1"], &LOOK[..]].concat());
        for more in [&["--threads", "3"][..], &[&path]] {
            assert_equal(&scratch, more);
        }
        assert_eq!(report(&scratch, 0, &[])["arguments"]["stock"], format!("{name}.json"));
    }
}

/// What was changed by options is made again on the scene file, from wherever it comes.
#[test]
fn options_are_part_of_what_a_picture_says() {
    let patch = r#"{"cloth": {"ks": 900}, "sphere": null, "plane": {"point": [0, 0, 0], "normal": [1, 2, 3], "friction": 0.1}}"#;
    for more in [
        &["--set", "cloth.ks=100", "--set", "camera.polar=60"][..],
        &["--shader", "custom", "--samples", "4", "-a", "9", "-o", "7"],
        &["--shader", "wireframe", "--springs", "bending,structural"],
        &["--set", "sim.integrator=rk4", "--set", "sim.gravity=[-0.0,-9.8,0.1]"],
        &["--set", "sphere=null", "--set", "material.shader=normal"],
        &["--patch", "patch.json"],
    ] {
        let scratch = Scratch::new();
        fs::write(scratch.path("patch.json"), patch).unwrap();
        scratch.succeed(&[&["render", "small.json", "a.png"], &LOOK[..], more].concat());
        assert_equal(&scratch, &[]);
        assert_equal(&scratch, &["small.json"]);
        fs::remove_file(scratch.path("small.json")).unwrap();
        fs::remove_file(scratch.path("patch.json")).unwrap();
        assert_equal(&scratch, &[]);
    }
}

#[test]
fn a_picture_at_rest_and_one_from_a_state_are_those_of_their_frame() {
    let scratch = Scratch::new();
    let calm = ["--set", "cloth.damping=1", "--until-rest", "--size", "64x50", "--save-state", "s"];
    scratch.succeed(&[&["render", "small.json", "a.png"], &calm[..]].concat());
    assert_equal(&scratch, &[]);
    assert_equal(&scratch, &["--from-state", "s"]);
    let scratch = drawn(&["--save-state", "s"]);
    render(&scratch, "20", &["--from-state", "s"]);
    fs::rename(scratch.path("b.png"), scratch.path("a.png")).unwrap();
    assert_equal(&scratch, &[]);
    assert_equal(&scratch, &["--from-state", "s"]);
    let scratch = drawn(&["--save-state", "s"]);
    scratch.succeed(&["render", "small.json", "a.png", "--size", "64x50", "--frame", "3"]);
    let late = scratch.run(&["verify", "a.png", "--from-state", "s"]);
    assert_eq!(late.code, Some(2), "{}", late.stderr);
}

#[test]
fn pictures_with_textures_of_ones_own_need_them() {
    let scratch = Scratch::new();
    fs::create_dir(scratch.path("set")).unwrap();
    let copy = |from: &str, to: &str| {
        fs::copy(crate::repository::path("textures").join(from), scratch.path("set").join(to)).unwrap();
    };
    copy("texture_3.png", "texture_1.png");
    let own = ["--shader", "texture", "--textures", "set"];
    scratch.succeed(&[&["render", "small.json", "a.png"], &LOOK[..], &own].concat());
    assert_equal(&scratch, &["--textures", "set"]);
    assert_eq!(report(&scratch, 1, &[])["differs"], "textures");
    copy("texture_4.png", "texture_1.png");
    assert_eq!(report(&scratch, 1, &["--textures", "set"])["differs"], "textures");
    fs::remove_file(scratch.path("set/texture_1.png")).unwrap();
    assert_eq!(scratch.run(&["verify", "a.png", "--textures", "set"]).code, Some(3));
}

#[test]
fn a_pixel_that_was_changed_is_found_without_drawing() {
    let scratch = drawn(&[]);
    doctor(&scratch, |_, _| ());
    assert_equal(&scratch, &[]);
    doctor(&scratch, |rgb, _| rgb[3 * (64 * 20 + 7)] ^= 1);
    let report = report(&scratch, 1, &[]);
    assert_eq!(report["differs"], "pixels");
    assert_eq!(report["differing_pixels"], Value::Null, "nothing was drawn");
}

/// The same bytes in rows of another length have the same hash.
#[test]
fn a_picture_of_another_shape_differs() {
    let scratch = drawn(&[]);
    let pixels = png::read(&scratch.path("a.png")).unwrap();
    let rgb: Vec<u8> = pixels.rgba.iter().flat_map(|pixel| pixel[..3].to_vec()).collect();
    let texts = png::texts(&scratch.read("a.png")).unwrap();
    fs::write(scratch.path("a.png"), png::encode_with(50, 64, &rgb, Effort::Small, &texts).unwrap()).unwrap();
    assert_eq!(report(&scratch, 1, &[])["differs"], "size");
}

#[test]
fn a_forger_who_writes_the_hash_too_is_told_the_pixels() {
    let scratch = drawn(&[]);
    doctor(&scratch, |rgb, texts| {
        for (x, y) in [(7, 20), (8, 20), (0, 49)] {
            rgb[3 * (64 * y + x)] ^= 1;
        }
        *text(texts, "drape:picture") = hash(rgb);
    });
    let report = report(&scratch, 1, &[]);
    assert_eq!((&report["differs"], &report["differing_pixels"]), (&"picture".into(), &3.into()));
    assert_eq!(report["first"], serde_json::json!([0, 7, 20]));
    let said = scratch.run(&["verify", "a.png"]).stderr;
    assert!(said.contains("3 of 3200 pixels, the first at column 7, row 20"), "{said}");
}

#[test]
fn whatever_else_was_changed_is_named() {
    let change = |keyword: &'static str, from: &'static str, to: &'static str| {
        let scratch = drawn(&[]);
        doctor(&scratch, |_, texts| {
            let text = text(texts, keyword);
            assert!(text.contains(from), "{text}");
            *text = text.replacen(from, to, 1);
        });
        scratch.run(&["verify", "a.png", "--json"])
    };
    let differs = |run: Run| {
        assert_eq!(run.code, Some(1), "{}", run.stderr);
        serde_json::from_slice::<Value>(&run.stdout).unwrap()["differs"].clone()
    };
    assert_eq!(differs(change("drape:arguments", "\"frame\":12", "\"frame\":13")), "state");
    assert_eq!(differs(change("drape:scene-json", "\"ks\":5000", "\"ks\":5001")), "scene");
    let state = drawn(&[]);
    doctor(&state, |_, texts| *text(texts, "drape:state") = "0".repeat(16));
    assert_eq!(report(&state, 1, &[])["differs"], "state");
    for (keyword, from, to) in [
        ("drape:arguments", "\"frame\":12", "\"frame\":-1"),
        ("drape:arguments", "\"frame\":12", "\"fps\":12"),
        ("drape:scene-json", "{", "["),
    ] {
        let run = change(keyword, from, to);
        assert_eq!(run.code, Some(6), "{keyword}: {}", run.stderr);
    }
}

#[test]
fn the_scene_file_that_is_given_is_compared_key_by_key() {
    let scratch = drawn(&["--set", "camera.polar=60"]);
    fs::write(scratch.path("other.json"), SMALL.replace("\"ks\": 5000", "\"ks\": 5001")).unwrap();
    let run = scratch.run(&["verify", "a.png", "other.json"]);
    assert_eq!(run.code, Some(1));
    let told = "`cloth.ks` is 5000 in the picture and 5001 in the scene";
    assert!(run.stderr.contains(told) && !run.stderr.contains("polar"), "{}", run.stderr);
    let plane = scratch.run(&["verify", "a.png", &scene("pinned2.json")]);
    assert_eq!(plane.code, Some(1), "{}", plane.stderr);
    assert!(
        plane.stderr.contains("`sphere` is there (1) in the picture and absent in the scene"),
        "{}",
        plane.stderr
    );
    fs::write(scratch.path("other.json"), "{\"cloth\": 3}").unwrap();
    assert_eq!(scratch.run(&["verify", "a.png", "other.json"]).code, Some(3));
    assert_eq!(scratch.run(&["verify", "a.png", "none.json"]).code, Some(6));
}

#[test]
fn another_version_is_named_and_not_refused() {
    let scratch = drawn(&[]);
    doctor(&scratch, |_, texts| *text(texts, "drape:version") = "0.0.9".to_owned());
    let run = scratch.run(&["verify", "a.png"]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    assert!(String::from_utf8_lossy(&run.stdout).contains("written by 0.0.9"));
    doctor(&scratch, |_, texts| *text(texts, "drape:state") = "1".repeat(16));
    let run = scratch.run(&["verify", "a.png"]);
    assert_eq!(run.code, Some(1));
    assert!(run.stderr.contains("version 0.0.9 wrote it"), "{}", run.stderr);
}

#[test]
fn a_damaged_file_is_6_and_one_that_says_nothing_4() {
    let scratch = drawn(&[]);
    let whole = scratch.read("a.png");
    for end in [0, 4, 40, 200, whole.len() / 2, whole.len() - 12] {
        fs::write(scratch.path("cut.png"), &whole[..end]).unwrap();
        let run = scratch.run(&["verify", "cut.png"]);
        assert_eq!(run.code, Some(6), "cut to {end}: {}", run.stderr);
    }
    for place in (8..whole.len()).step_by(97) {
        let mut bytes = whole.clone();
        bytes[place] ^= 0x20;
        fs::write(scratch.path("flipped.png"), bytes).unwrap();
        let run = scratch.run(&["verify", "flipped.png"]);
        assert_eq!(run.code, Some(6), "byte {place}: {}", run.stderr);
    }
    fs::write(scratch.path("plain.png"), png::encode(1, 1, &[0; 3], Effort::Small).unwrap()).unwrap();
    assert_eq!(scratch.run(&["verify", "plain.png"]).code, Some(4));
    doctor(&scratch, |_, texts| texts.retain(|(keyword, _)| keyword == "drape:picture"));
    assert_eq!(scratch.run(&["verify", "a.png"]).code, Some(6), "a part of what it said");
    for no_picture in ["small.json", "none.png", "."] {
        assert_eq!(scratch.run(&["verify", no_picture]).code, Some(6), "{no_picture}");
    }
}

#[test]
fn a_picture_without_its_scene_needs_the_file() {
    let scratch = drawn(&["--provenance", "hashes", "--set", "cloth.ks=700"]);
    let run = scratch.run(&["verify", "a.png"]);
    assert_eq!(run.code, Some(2), "{}", run.stderr);
    assert_equal(&scratch, &["small.json"]);
    assert_eq!(report(&scratch, 1, &[&scene("sphere.json")])["differs"], "file");
    let input = fs::File::open(scratch.path("small.json")).unwrap();
    let piped: Run = scratch.command(&["verify", "a.png", "-"]).stdin(input).output().unwrap().into();
    assert_eq!(piped.code, Some(0), "{}", piped.stderr);
}

#[test]
fn what_is_said_twice_is_damaged() {
    for keyword in ["drape:arguments", "drape:picture", "drape:version"] {
        let scratch = drawn(&[]);
        doctor(&scratch, |_, texts| {
            let mut other = texts.iter().find(|(known, _)| known == keyword).unwrap().clone();
            other.1 = other.1.replacen("12", "13", 1);
            texts.insert(0, other);
        });
        let run = scratch.run(&["verify", "a.png"]);
        assert_eq!(run.code, Some(6), "{keyword}: {}", run.stderr);
        assert!(run.stderr.contains(&format!("`{keyword}` twice")), "{}", run.stderr);
    }
}
