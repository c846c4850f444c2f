//! Values that a scene cannot have, and keys that are missing or unknown.

use drape::scene::{load, load_text};

use super::{CLOTH, error, sets, summary};

/// A valid scene with one value changed: what is found wrong.
#[track_caller]
pub(super) fn refuses(set: &str, expected: &[&str]) {
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
fn a_key_of_another_object_is_shown_where_it_belongs() {
    for (set, help) in [
        ("render.shader=bump", "did you mean `material.shader`?"),
        ("shader=bump", "did you mean `material.shader`?"),
        ("cloth.shader=bump", "did you mean `cloth.material.shader`?"),
        ("density=3", "did you mean `cloth.density`?"),
        ("friction=0", "did you mean `box.friction`, `sphere.friction` or `plane.friction`?"),
        ("sphere.time=0", "did you mean `render.time`?"),
        ("render.sim=0", "did you mean `sim`?"),
        ("camera.gravity=[0,0,0]", "did you mean `sim.gravity`?"),
        ("position=[0,0,0]", "did you mean `light.position`?"),
        // The place of one object is not what is meant by a place in another.
        (
            "camera.position=[0,0,0]",
            "the keys here are target, distance, polar, azimuth, hfov, vfov, fit, near, far",
        ),
        ("light.size=[1,1]", "the keys here are position, intensity, color"),
        // A slip of the key that is there comes first.
        ("render.site=0", "did you mean `size`?"),
    ] {
        let text =
            format!("{{{CLOTH}, \"sphere\": {{\"origin\": [0, 0, 0], \"radius\": 1, \"friction\": 0}}}}");
        assert_eq!(error(&text, &[set]).diagnostics[0].help, help, "--set {set}");
    }
}

#[test]
fn a_code_is_explained() {
    for (value, found) in [("\"horizontal\"", "is text but must be the number "), ("2", "is 2 but must be ")]
    {
        let error = error(&format!("{{{CLOTH}}}"), &[&format!("cloth.orientation={value}")]);
        let message = &error.diagnostics[0].message;
        assert_eq!(*message, format!("`cloth.orientation` {found}0 (horizontal) or 1 (vertical)"));
    }
    let samples = error("{}", &["render.samples=2"]);
    assert_eq!(samples.diagnostics[0].message, "`render.samples` is 2 but must be 1, 4, 8 or 16");
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
