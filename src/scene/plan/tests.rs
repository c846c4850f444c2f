//! Tests of the plan.

use super::*;
use crate::scene::{Overrides, SelfCollision, Shader, load_text};

const TWO_BALLS: &str = r#"{"cloth": {"width": 1, "height": 1, "num_width_points": 5, "num_height_points": 5,
        "thickness": 0.01, "orientation": 0, "damping": 0.2, "density": 150, "ks": 5000,
        "enable_structural": true, "enable_shearing": false, "enable_bending": true},
        "sphere": [{"origin": [0, 0, 0], "radius": 1, "friction": 0}, {"origin": [3, 0, 0], "radius": 1, "friction": 0}]}"#;

fn scene(text: &str, sets: &[&str]) -> Scene {
    let sets = sets.iter().map(ToString::to_string).collect();
    load_text("x.json", text, &Overrides { sets, ..Overrides::default() }).unwrap().scene
}

fn line(scene: &Scene, name: &str) -> Item {
    plan(scene).into_iter().find(|item| item.name == name).unwrap()
}

#[test]
fn every_decision_has_one_line_with_its_reason() {
    let plan = plan(&scene(TWO_BALLS, &["sphere.1.material.shader=texture"]));
    let line = |Item { name, needed, reason }: &Item| {
        format!("{name}: {}: {reason}", if *needed { "needed" } else { "left out" })
    };
    let lines: Vec<String> = plan.iter().map(line).collect();
    let expected = "\
structural springs: needed: cloth.enable_structural is true
shearing springs: left out: cloth.enable_shearing is false
bending springs: needed: cloth.enable_bending is true
self-collision: needed: cloth.thickness is 0.01 m
collision with planes: left out: the scene has no plane
collision with spheres: needed: the scene has 2 spheres
collision with boxes: left out: the scene has no box
stretch limit: needed: sim.stretch_limit is 0.1
cloth normals: needed: read by the phong shader
cloth tangents: left out: not read by the phong shader
cloth texture coordinates: left out: not read by the phong shader
cloth texture: left out: not read by the phong shader
cloth height map: left out: not read by the phong shader
cloth environment: left out: not read by the phong shader
sphere.0 normals: needed: read by the phong shader
sphere.0 tangents: left out: not read by the phong shader
sphere.0 texture coordinates: left out: not read by the phong shader
sphere.0 texture: left out: not read by the phong shader
sphere.0 height map: left out: not read by the phong shader
sphere.0 environment: left out: not read by the phong shader
sphere.1 normals: left out: not read by the texture shader
sphere.1 tangents: left out: not read by the texture shader
sphere.1 texture coordinates: needed: read by the texture shader
sphere.1 texture: needed: read by the texture shader
sphere.1 height map: left out: not read by the texture shader
sphere.1 environment: left out: not read by the texture shader
texture texture_1: needed: read by sphere.1
cube maps: left out: no shader reads one";
    assert_eq!(lines.join("\n"), expected);
}

#[test]
fn phases_are_left_out_when_nothing_needs_them() {
    let all = scene(TWO_BALLS, &[]);
    assert!(!line(&all, "collision with planes").needed && line(&all, "collision with spheres").needed);
    assert_eq!(
        (all.needed_self_collision(), all.needed_stretch_limit()),
        (SelfCollision::SameBox, Some(0.1))
    );
    let outside = scene(TWO_BALLS, &["sim.contact=outside"]);
    let kept = "the scene has 2 spheres, and sim.contact is outside: points are kept out";
    assert_eq!(line(&outside, "collision with spheres").reason, kept);

    let thin = scene(TWO_BALLS, &["cloth.thickness=0"]);
    assert_eq!(thin.needed_self_collision(), SelfCollision::Off);
    assert_eq!(line(&thin, "self-collision").reason, "cloth.thickness is 0");
    let off = scene(TWO_BALLS, &["sim.self_collision=off"]);
    assert_eq!(off.needed_self_collision(), SelfCollision::Off);
    assert_eq!(line(&off, "self-collision").reason, "sim.self_collision is off");

    assert_eq!(scene(TWO_BALLS, &["sim.stretch_limit=null"]).needed_stretch_limit(), None);
    let loose = scene(TWO_BALLS, &["cloth.enable_structural=false", "cloth.enable_bending=false"]);
    assert_eq!(loose.needed_stretch_limit(), None);
    assert_eq!(line(&loose, "stretch limit").reason, "there are no springs");
}

#[test]
fn without_a_cloth_nothing_is_simulated() {
    let text = r#"{"sphere": {"origin": [0, 0, 0], "radius": 1, "friction": 0}}"#;
    let scene = scene(text, &["sim.contact=outside"]);
    assert_eq!((scene.needed_self_collision(), scene.needed_stretch_limit()), (SelfCollision::Off, None));
    assert!(!line(&scene, "collision with planes").needed && !line(&scene, "collision with spheres").needed);
    assert_eq!(line(&scene, "collision with spheres").reason, "the scene has no cloth");
    assert_eq!(names(&scene), ["sphere"]);
}

#[test]
fn every_shader_reads_what_its_formula_names() {
    // normal, tangent, uv, texture, height map, environment
    let expected = [
        ("wireframe", "------"),
        ("normal", "n-----"),
        ("diffuse", "n-----"),
        ("phong", "n-----"),
        ("texture", "--ux--"),
        ("bump", "ntu-h-"),
        ("displacement", "ntu-h-"),
        ("mirror", "n----e"),
        ("custom", "ntuxhe"),
    ];
    let found = Shader::NAMES.iter().map(|&(name, shader)| {
        let letters = "ntuxhe".chars().zip(Needs::of(shader).named());
        (name, letters.map(|(letter, (_, needed))| if needed { letter } else { '-' }).collect::<String>())
    });
    assert!(found.eq(expected.map(|(name, needs)| (name, needs.to_owned()))));
}

#[test]
fn an_image_is_named_once() {
    let sets = ["material.shader=custom", "material.height_map=texture_1", "sphere.1.material.texture=wood"];
    let scene = scene(TWO_BALLS, &sets);
    let images = Images::of(&scene);
    assert_eq!(
        (images.textures, images.environments),
        (vec!["texture_1".into(), "wood".into()], vec!["cube".into()])
    );
    assert_eq!(line(&scene, "texture texture_1").reason, "read by cloth, sphere.0, sphere.1");
    assert_eq!(line(&scene, "texture wood").reason, "read by sphere.1");
}
