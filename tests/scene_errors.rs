//! Promise: whatever is wrong in a scene is named with its place, all of it at once, and nothing
//! that can be read makes the reader panic.

use std::fs;
use std::path::Path;

use drape::error::{Diagnostic, Error, Kind};
use drape::scene::{Overrides, load, load_text};

/// A cloth that is valid.
const CLOTH: &str = r#""cloth": {"width": 1, "height": 1, "num_width_points": 5, "num_height_points": 5,
"thickness": 0, "orientation": 0, "damping": 0.2, "density": 150, "ks": 5000,
"enable_structural": true, "enable_shearing": true, "enable_bending": true}"#;

fn sets(sets: &[&str]) -> Overrides {
    Overrides { sets: sets.iter().map(ToString::to_string).collect(), ..Overrides::default() }
}

fn error(text: &str, set: &[&str]) -> Error {
    load_text("scene.json", text, &sets(set)).expect_err("the scene must be refused")
}

fn rendered(diagnostics: &[Diagnostic]) -> String {
    diagnostics.iter().map(|d| format!("{}\n\n", d.rendered)).collect()
}

/// Compares without the empty lines at the ends, so that the goldens below can be laid out.
#[track_caller]
fn assert_rendered(error: &Error, golden: &str) {
    assert_eq!(error.kind, Kind::Scene);
    let found = rendered(&error.diagnostics);
    assert_eq!(found.trim(), golden.trim(), "\n{found}");
}

#[test]
fn all_errors_of_a_file_come_at_once() {
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
error[scene::wrong_type]: `cloth.height` is text but must be a number above 0, from 1e-15 to 1e15 m
 --> scene.json:4:15
  |
4 |     "height": "1",
  |               ^^^ wrong type
  |
  = help: write the number without quotes

error[scene::missing_key]: `cloth` is missing `damping`
 --> scene.json:2:12
  |
2 |   "cloth": {
  |            ^ in the object that starts here
  |
  = help: `damping` is a number from 0 to 100 %

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

error[scene::unknown_key]: unknown key `cloth.dampning`
  --> scene.json:12:5
   |
12 |     "dampning": 0.2,
   |     ^^^^^^^^^^ not a key of this object
   |
   = help: did you mean `damping`?

error[scene::pin_outside]: pinned point `cloth.pinned.1` is outside the grid
  --> scene.json:10:16
   |
 5 |     "num_width_points": 50,
   |                         -- `num_width_points` is set here
...
10 |       [0, 0], [50, 0]
   |                ^^ must be from 0 to 49: there are 50 points
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
    let overrides = Overrides { patches: vec![patch.clone()], sets: vec![] };
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

/// `CODE LINE:COLUMN KEY` of every diagnostic.
fn summary(error: &Error) -> Vec<String> {
    error.diagnostics.iter().map(|d| format!("{} {}:{} {}", d.code, d.line, d.column, d.key)).collect()
}

#[test]
fn text_that_is_not_json_is_refused_where_it_goes_wrong() {
    let cases = [
        ("", 1, 1, "the file is empty"),
        (" \n ", 1, 1, "the file is empty"),
        ("\u{feff}{}", 1, 1, "the file starts with a byte order mark"),
        ("{\"sim\": {}", 1, 1, "this object is never closed"),
        ("{\"sim\": [1", 1, 9, "this list is never closed"),
        ("{\n} x", 2, 3, "nothing may follow the scene's closing brace"),
        ("{} {}", 1, 4, "nothing may follow the scene's closing brace"),
        ("{\"sim\": {},}", 1, 11, "trailing commas are not allowed"),
        ("{\"sim\" {}}", 1, 8, "expected `:` after the key"),
        ("{\"sim\": {} \"light\": {}}", 1, 11, "expected `,`"),
        ("{sim: {}}", 1, 2, "expected string for object property"),
        ("{'sim': {}}", 1, 2, "single-quoted strings are not allowed"),
        ("{} // x", 1, 4, "comments are not allowed"),
        ("{\"sim\": tru}", 1, 9, "this is no JSON value"),
        ("{\"sim\": .5}", 1, 9, "leading or trailing decimal points on numbers are not allowed"),
        ("{\"sim\": 5.}", 1, 9, "leading or trailing decimal points on numbers are not allowed"),
        ("{\"sim\": +5}", 1, 9, "unary plus on numbers is not allowed"),
        ("{\"sim\": 0x5}", 1, 9, "hexadecimal numbers are not allowed"),
        ("{\"sim\": 05}", 1, 10, "expected `,`"),
        ("{\"sim\": NaN}", 1, 9, "this is no JSON value"),
        ("{\"sim\": -Infinity}", 1, 9, "infinity and NaN are not allowed"),
        ("{\"sim\": \"a\nb\"}", 1, 11, "control characters in text must be escaped"),
        ("{\"sim\": \"a\tb\"}", 1, 11, "control characters in text must be escaped"),
        ("{\"sim\":\u{b}1}", 1, 8, "this character is not allowed here"),
        ("{\"sim\":\u{a0}1}", 1, 8, "this character is not allowed here"),
    ];
    for (text, line, column, reason) in cases {
        let error = error(text, &[]);
        assert_eq!(summary(&error), [format!("scene::syntax {line}:{column} ")], "{text}");
        assert!(error.message.ends_with(reason), "{text}: {}", error.message);
    }
}

#[test]
fn what_is_too_deep_or_too_large_or_not_utf8_is_refused() {
    for levels in [66, 200, 600, 100_000] {
        let text = format!("{{\"sim\": {}{}}}", "[".repeat(levels), "]".repeat(levels));
        assert_eq!(error(&text, &[]).diagnostics[0].message, "nested too deeply", "{levels}");
    }
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("scene.json");
    let refused = |bytes: &[u8]| {
        fs::write(&file, bytes).unwrap();
        load(&file, &Overrides::default()).unwrap_err()
    };
    assert_eq!(summary(&refused(b"{\n\"\xff\": 1}")), ["scene::syntax 2:2 "]);
    assert_eq!(summary(&refused(&vec![b' '; (16 << 20) + 1])), ["scene::too_large 1:1 "]);
    assert_eq!(summary(&refused(&vec![b' '; 16 << 20])), ["scene::syntax 1:1 "], "exactly 16 MiB are read");
}

#[test]
fn a_file_that_cannot_be_read_is_an_input_error() {
    let missing = Path::new("no/such/scene.json");
    let error = load(missing, &Overrides::default()).unwrap_err();
    assert_eq!(error.kind, Kind::Io);
    assert!(error.message.starts_with("cannot read no/such/scene.json: "), "{}", error.message);
    let overrides = Overrides { patches: vec![missing.into()], sets: vec![] };
    assert_eq!(load_text("scene.json", "{}", &overrides).unwrap_err().kind, Kind::Io);
    assert_eq!(load(Path::new("."), &Overrides::default()).unwrap_err().kind, Kind::Io);
}

#[test]
fn a_set_that_is_not_path_and_value_is_a_usage_error() {
    let path = format!("{}=1", ["a"; 65].join("."));
    for argument in ["cloth.ks", "", "=5", "cloth..ks=5", ".ks=5", "cloth.=5", &path] {
        assert_eq!(error("{}", &[argument]).kind, Kind::Usage, "{argument}");
    }
}

/// A valid scene with one value changed: what is found wrong.
#[track_caller]
fn refuses(set: &str, expected: &[&str]) {
    let text = format!("{{{CLOTH}, \"sphere\": {{\"origin\": [0, 0, 0], \"radius\": 1, \"friction\": 0}}}}");
    let found: Vec<String> =
        error(&text, &[set]).diagnostics.iter().map(|d| format!("{} {}", d.code, d.key)).collect();
    assert_eq!(found, expected, "--set {set}");
}

#[test]
fn values_out_of_range_are_refused() {
    for set in [
        "cloth.width=0",
        "cloth.width=-1",
        "cloth.width=-0",
        "cloth.width=1e-16",
        "cloth.height=1.0000001e15",
        "cloth.num_width_points=1",
        "cloth.num_width_points=0",
        "cloth.num_height_points=-5",
        "cloth.num_height_points=5.5",
        "cloth.num_height_points=1e999",
        "cloth.thickness=-0.1",
        "cloth.damping=100.1",
        "cloth.damping=-0.1",
        "cloth.density=0",
        "cloth.ks=-1",
        "cloth.ks=1e999",
        "sphere.radius=0",
        "sphere.friction=1.1",
        "sphere.friction=-0.1",
        "sim.fps=0",
        "sim.steps_per_frame=0",
        "sim.steps_per_frame=2000000000",
        "sim.stretch_limit=-0.1",
        "sim.stretch_passes=0",
        "camera.distance=0",
        "camera.polar=181",
        "camera.polar=-1",
        "camera.hfov=0",
        "camera.vfov=180",
        "camera.near=0",
        "render.time=-1",
        "material.shininess=-1",
        "material.kd=-1",
        "cloth.material.ka=-1",
    ] {
        let key = set.split('=').next().unwrap();
        refuses(set, &[&format!("scene::out_of_range {key}")]);
    }
    refuses(
        "sphere.origin=[0,1e16,-1e16]",
        &["scene::out_of_range sphere.origin.1", "scene::out_of_range sphere.origin.2"],
    );
    refuses(
        "sphere.resolution=[1,2]",
        &["scene::out_of_range sphere.resolution.0", "scene::out_of_range sphere.resolution.1"],
    );
    refuses(
        "render.size=[0,16385]",
        &["scene::out_of_range render.size.0", "scene::out_of_range render.size.1"],
    );
    refuses("light.intensity=[1,1,-1]", &["scene::out_of_range light.intensity.2"]);
    refuses("light.color=[0,0,-0]", &["scene::zero_vector light.color"]);
    refuses(
        "plane={\"point\":[0,0,0],\"normal\":[0,0,0],\"friction\":0}",
        &["scene::zero_vector plane.normal"],
    );
    refuses("render.samples=2", &["scene::unknown_value render.samples"]);
    refuses("cloth.orientation=2", &["scene::unknown_value cloth.orientation"]);
    refuses("cloth.orientation=0.5", &["scene::unknown_value cloth.orientation"]);
    refuses("material.shader=glass", &["scene::unknown_value material.shader"]);
    for name in ["a/b", "..", "", "a.png", "ü", "a\\u0000", &"x".repeat(65)] {
        refuses(&format!("material.texture=\"{name}\""), &["scene::bad_name material.texture"]);
    }
}

#[test]
fn values_of_the_wrong_type_are_refused() {
    for set in [
        "cloth=5",
        "cloth=null",
        "cloth=[]",
        "cloth.width=true",
        "cloth.width=null",
        "cloth.width=NaN",
        "cloth.num_width_points=\"5\"",
        "cloth.orientation=\"0\"",
        "cloth.pinned=5",
        "cloth.enable_bending=1",
        "sphere=true",
        "sphere.origin=5",
        "sim=[]",
        "sim.gravity=-9.8",
        "sim.integrator=5",
        "material.texture=5",
        "cloth.material=bump",
        "render.size=640",
    ] {
        let key = set.split('=').next().unwrap();
        refuses(set, &[&format!("scene::wrong_type {key}")]);
    }
    refuses(
        "cloth.pinned=[5,[0,true]]",
        &["scene::wrong_type cloth.pinned.0", "scene::wrong_type cloth.pinned.1.1"],
    );
    refuses("cloth.pinned=[[1]]", &["scene::wrong_length cloth.pinned.0"]);
    refuses("sim.gravity=[0,0]", &["scene::wrong_length sim.gravity"]);
    refuses(
        "sphere=[1,{}]",
        &[
            "scene::wrong_type sphere.0",
            "scene::missing_key sphere.1.origin",
            "scene::missing_key sphere.1.radius",
            "scene::missing_key sphere.1.friction",
        ],
    );
    assert_eq!(summary(&error("[]", &[])), ["scene::wrong_type 1:1 "]);
    assert_eq!(error("[]", &[]).diagnostics[0].message, "the scene is a list but must be an object");
}

#[test]
fn every_required_field_is_missed() {
    let text = "{\"cloth\": {}, \"plane\": {}, \"sphere\": {}}";
    let keys: Vec<String> = error(text, &[]).diagnostics.iter().map(|d| d.key.clone()).collect();
    assert_eq!(
        keys,
        [
            "cloth.width",
            "cloth.height",
            "cloth.num_width_points",
            "cloth.num_height_points",
            "cloth.thickness",
            "cloth.orientation",
            "cloth.damping",
            "cloth.density",
            "cloth.ks",
            "cloth.enable_structural",
            "cloth.enable_shearing",
            "cloth.enable_bending",
            "plane.point",
            "plane.normal",
            "plane.friction",
            "sphere.origin",
            "sphere.radius",
            "sphere.friction",
        ]
    );
}

#[test]
fn unknown_keys_are_refused_at_every_level() {
    for key in
        ["sims", "cloth.k", "sphere.x", "sim.dt", "camera.fov", "light.size", "material.kb", "render.frame"]
    {
        refuses(&format!("{key}=1"), &[&format!("scene::unknown_key {key}")]);
    }
    refuses("cloth.material.ky=1", &["scene::unknown_key cloth.material.ky"]);
    let help = |text: &str| error(text, &[]).diagnostics[0].help.clone();
    assert_eq!(help("{\"spere\": 1}"), "did you mean `sphere`?");
    assert_eq!(help("{\"sim\": {\"Fps\": 60}}"), "did you mean `fps`?");
    assert_eq!(help("{\"light\": {\"pin_edges\": 1}}"), "the keys here are position, intensity, color");
}

#[test]
fn relations_between_values_are_checked() {
    refuses("cloth.pinned=[[5,0],[0,5],[-1,0],[4,4],[1e9,1e300]]", &["scene::out_of_range cloth.pinned.4.1"]);
    refuses(
        "cloth.pinned=[[5,0],[0,5],[-1,0],[4,4],[1e9,7]]",
        &[
            "scene::pin_outside cloth.pinned.0",
            "scene::pin_outside cloth.pinned.1",
            "scene::pin_outside cloth.pinned.2",
            "scene::pin_outside cloth.pinned.4",
            "scene::pin_outside cloth.pinned.4",
        ],
    );
    refuses(
        "cloth.pinned=[[1,2],[2,1],[1,2],[1,2]]",
        &["scene::duplicate_pin cloth.pinned.2", "scene::duplicate_pin cloth.pinned.3"],
    );
    refuses("camera.near=1e4", &["scene::near_far camera.near"]);
    refuses("camera.far=0.01", &["scene::near_far camera.near"]);
    refuses("cloth.num_width_points=1000000", &["scene::too_many_points cloth.num_width_points"]);
    refuses("cloth.num_width_points=100000000", &["scene::out_of_range cloth.num_width_points"]);
    let spheres = |n: usize| {
        let sphere = "{\"origin\":[0,0,0],\"radius\":1,\"friction\":0}";
        format!("sphere=[{}]", vec![sphere; n].join(","))
    };
    refuses(&spheres(255), &["scene::too_many_objects sphere"]);
    assert!(load_text("scene.json", &format!("{{{CLOTH}}}"), &sets(&[&spheres(254)])).is_ok());
}

#[test]
fn a_set_cannot_go_through_a_value() {
    refuses("cloth.ks.x=1", &["scene::no_such_place cloth.ks.x"]);
    refuses("sphere.1.radius=1", &["scene::unknown_key sphere.1"]);
    let two = "{\"sphere\": [{\"origin\": [0, 0, 0], \"radius\": 1, \"friction\": 0}, {}]}";
    let found = error(two, &["sphere.2.radius=1", "sphere.radius=1"]);
    assert_eq!(
        summary(&found)[..2],
        ["scene::no_such_place 1:8 sphere.2", "scene::no_such_place 1:8 sphere.radius"]
    );
    assert_eq!(found.diagnostics[1].message, "there is no `sphere.radius`: `sphere` is a list");
}

#[test]
fn what_does_not_print_is_escaped_and_what_is_long_is_cut() {
    let found = error(&format!("{{\"\\u001b[31m{}\": 1}}", "x".repeat(5000)), &[]);
    let message = &found.diagnostics[0].message;
    assert!(message.starts_with("unknown key `\\u{1b}[31mxxx") && message.ends_with("xxx...`"), "{message}");
    assert!(!found.diagnostics[0].rendered.contains('\u{1b}'));
}

#[test]
fn reading_stops_after_a_hundred_errors() {
    let text = format!("{{{}}}", (0..300).map(|i| format!("\"k{i}\": 0")).collect::<Vec<_>>().join(","));
    let found = error(&text, &[]);
    assert_eq!(found.diagnostics.len(), 101);
    assert_eq!(found.diagnostics[100].message, "stopped after 100 errors");
}

#[test]
fn all_damping_per_second_is_an_error() {
    let scene = |set: &[&str]| load("scenes/pinned2.json".as_ref(), &sets(set));
    let error = scene(&["cloth.damping=100", "sim.damping=\"per_second\""]).unwrap_err();
    assert!(error.to_string().contains("a damping of 100 % has no rate per second"), "{error}");
    scene(&["cloth.damping=100"]).unwrap();
    scene(&["cloth.damping=99.99", "sim.damping=\"per_second\""]).unwrap();
}

#[test]
fn what_belongs_to_another_integrator_is_an_error() {
    let scene = |set: &[&str]| load("scenes/pinned2.json".as_ref(), &sets(set));
    for integrator in ["xpbd", "implicit_euler", "bdf2"] {
        let integrator = format!("sim.integrator={integrator}");
        for (key, what) in [("sim.start=half_step", "starts with"), ("sim.precision=f32", "runs in binary32")]
        {
            let error = scene(&[&integrator, key]).unwrap_err().to_string();
            assert!(error.contains(&format!("only Verlet's scheme {what}")), "{integrator} {key}: {error}");
            scene(&[key]).unwrap();
        }
        scene(&[&integrator, "sim.start=report", "sim.precision=f64"]).unwrap();
    }
    scene(&["sim.iterations=7", "sim.tolerance=1e-9"]).unwrap();
    refuses("sim.iterations=0", &["scene::out_of_range sim.iterations"]);
    refuses("sim.tolerance=0", &["scene::out_of_range sim.tolerance"]);
    refuses("sim.integrator=euler", &["scene::unknown_value sim.integrator"]);
}
