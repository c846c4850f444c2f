//! What an error looks like: place, line, caret, hint.

use drape::error::{Error, Kind};
use drape::scene::{Overrides, load_text};
use std::fs;

use super::{CLOTH, error, rendered, sets};

/// Compares without the empty lines at the ends, so that the goldens below can be laid out.
#[track_caller]
fn assert_rendered(error: &Error, golden: &str) {
    assert_eq!(error.kind, Kind::Scene);
    let found = rendered(&error.diagnostics);
    assert_eq!(found.trim(), golden.trim(), "\n{found}");
}

#[test]
fn all_errors_of_a_file_come_at_once_from_its_first_line_to_its_last() {
    let text = r#"{
  "cloth": {
    "width": 1,
    "height": "1",
    "num_width_points": 50,
    "num_height_points": 50,
    "thickness": 0.0095,
    "orientation": 0,
    "pinned": [
      [0, 0], [50, 0]
    ],
    "dampning": 0.2,
    "density": -150,
    "ks": 5000,
    "enable_structural": true,
    "enable_shearing": true,
    "enable_bending": 1
  }
}
"#;
    let golden = r#"
error[scene::missing_key]: `cloth` is missing `damping`
 --> scene.json:2:12
  |
2 |   "cloth": {
  |            ^ in the object that starts here
  |
  = help: `damping` is a number from 0 to 100 %

error[scene::wrong_type]: `cloth.height` is text but must be a number above 0, from 1e-15 to 1e15 m
 --> scene.json:4:15
  |
4 |     "height": "1",
  |               ^^^ wrong type
  |
  = help: write the number without quotes

error[scene::pin_outside]: pinned point `cloth.pinned.1` is outside the grid
  --> scene.json:10:16
   |
 5 |     "num_width_points": 50,
   |                         -- `num_width_points` is set here
...
10 |       [0, 0], [50, 0]
   |                ^^ must be from 0 to 49: there are 50 points

error[scene::unknown_key]: unknown key `cloth.dampning`
  --> scene.json:12:5
   |
12 |     "dampning": 0.2,
   |     ^^^^^^^^^^ not a key of this object
   |
   = help: did you mean `damping`?

error[scene::out_of_range]: `cloth.density` is -150 but must be above 0, from 1e-15 to 1e15 kg/m²
  --> scene.json:13:16
   |
13 |     "density": -150,
   |                ^^^^ not allowed

error[scene::wrong_type]: `cloth.enable_bending` is a number but must be true or false
  --> scene.json:17:23
   |
17 |     "enable_bending": 1
   |                       ^ wrong type
"#;
    assert_rendered(&error(text, &[]), golden);
}

#[test]
fn a_duplicate_key_shows_both_places() {
    let text = "{\n  \"camera\": {\n    \"polar\": 60,\n    \"polar\": 70\n  }\n}\n";
    let golden = r#"
error[scene::duplicate_key]: duplicate key `camera.polar`
 --> scene.json:4:5
  |
3 |     "polar": 60,
  |     ------- first given here
4 |     "polar": 70
  |     ^^^^^^^ given again here
  |
  = help: keep one of the two
"#;
    assert_rendered(&error(text, &[]), golden);
}

#[test]
fn a_set_is_named_as_the_source_of_its_error() {
    let golden = r#"
error[scene::wrong_type]: `cloth.ks` is text but must be a number from 0 to 1e15 N/m
 --> --set cloth.ks="x":1:10
  |
1 | cloth.ks="x"
  |          ^^^ wrong type

error[scene::pin_outside]: pinned point `cloth.pinned.1` is outside the grid
 --> --set cloth.pinned=[[0,0],[0,7],[0,0]]:1:24
  |
1 | cloth.pinned=[[0,0],[0,7],[0,0]]
  |                        ^ must be from 0 to 4: there are 5 points
  |
 ::: scene.json:2:80
  |
2 | "cloth": {"width": 1, "height": 1, "num_width_points": 5, "num_height_points": 5,
  |                                                                                - `num_height_points` is set here

error[scene::duplicate_pin]: point [0, 0] is pinned twice
 --> --set cloth.pinned=[[0,0],[0,7],[0,0]]:1:27
  |
1 | cloth.pinned=[[0,0],[0,7],[0,0]]
  |               -----       ^^^^^ again here
  |               |
  |               first pinned here
  |
  = help: remove one of the two
"#;
    let text = format!("{{\n{CLOTH}\n}}");
    assert_rendered(&error(&text, &["cloth.ks=\"x\"", "cloth.pinned=[[0,0],[0,7],[0,0]]"]), golden);
}

#[test]
fn a_patch_is_named_with_its_own_line_and_column() {
    let folder = tempfile::tempdir().unwrap();
    let patch = folder.path().join("look.json");
    fs::write(&patch, "{\n  \"light\": {\"colour\": [1, 1, 1]},\n  \"render\": {\"size\": [640]}\n}\n")
        .unwrap();
    let overrides = Overrides { patches: vec![patch.clone()], ..Overrides::default() };
    let error = load_text("scene.json", "{}", &overrides).unwrap_err();
    let golden = r#"
error[scene::unknown_key]: unknown key `light.colour`
 --> LOOK:2:13
  |
2 |   "light": {"colour": [1, 1, 1]},
  |             ^^^^^^^^ not a key of this object
  |
  = help: did you mean `color`?

error[scene::wrong_length]: `render.size` has length 1 but must be a list of 2 whole numbers: 1 to 16384, 1 to 16384
 --> LOOK:3:22
  |
3 |   "render": {"size": [640]}
  |                      ^^^^^ wrong length
"#;
    assert_rendered(&error, &golden.replace("LOOK", &patch.display().to_string()));
    assert!(error.diagnostics.iter().all(|d| d.file == patch.display().to_string()));
}

#[test]
fn columns_and_carets_count_characters() {
    let text = "{\"light\": {\"größe\": 1, \"naß\": 2}}";
    let golden = r#"
error[scene::unknown_key]: unknown key `light.größe`
 --> scene.json:1:12
  |
1 | {"light": {"größe": 1, "naß": 2}}
  |            ^^^^^^^ not a key of this object
  |
  = help: the keys here are position, intensity, color

error[scene::unknown_key]: unknown key `light.naß`
 --> scene.json:1:24
  |
1 | {"light": {"größe": 1, "naß": 2}}
  |                        ^^^^^ not a key of this object
  |
  = help: the keys here are position, intensity, color
"#;
    assert_rendered(&error(text, &[]), golden);
}

#[test]
fn a_warning_is_not_an_error() {
    let text = format!("{{\n{CLOTH}\n}}");
    let loaded = load_text("scene.json", &text, &sets(&["cloth.thickness=0.2"])).unwrap();
    let golden = r#"
warning[scene::thickness]: 2 x thickness is 0.4 m, more than the 0.25 m between neighbouring points
 --> --set cloth.thickness=0.2:1:17
  |
1 | cloth.thickness=0.2
  |                 ^^^ half the distance that self-collision keeps
  |
  = help: self-collision pushes the cloth apart at rest unless this is at most 0.125
"#;
    assert_eq!(rendered(&loaded.warnings).trim(), golden.trim());
    let at_rest = load_text("scene.json", &text, &sets(&["cloth.thickness=0.125"])).unwrap();
    assert_eq!(at_rest.warnings, []);
    let off = sets(&["cloth.thickness=0.2", "sim.self_collision=off"]);
    assert_eq!(load_text("scene.json", &text, &off).unwrap().warnings, []);
}

#[test]
fn what_does_not_print_is_escaped_and_what_is_long_is_cut() {
    let found = error(&format!("{{\"\\u001b[31m{}\": 1}}", "x".repeat(5000)), &[]);
    let message = &found.diagnostics[0].message;
    assert!(message.starts_with("unknown key `\\u{1b}[31mxxx") && message.ends_with("xxx...`"), "{message}");
    assert!(!found.diagnostics[0].rendered.contains('\u{1b}'));
}
