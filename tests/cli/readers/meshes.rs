//! Meshes as trimesh, the Khronos validator and Blender read them.

use std::process::Command;

use serde_json::{Value, json};

use super::{installed, not_checked, python};
use crate::scratch::{Scratch, scene};

/// Upper half of the texture red, lower half blue.
fn textures(scratch: &Scratch) {
    std::fs::create_dir(scratch.path("t")).unwrap();
    let texture =
        image::RgbImage::from_fn(16, 16, |_, y| image::Rgb(if y < 8 { [255, 0, 0] } else { [0, 0, 255] }));
    texture.save(scratch.path("t/halves.png")).unwrap();
}

fn export(scratch: &Scratch, out: &str, more: &[&str]) {
    let path = scene("sphere.json");
    let look = ["--set", "cloth.num_width_points=9", "--set", "cloth.num_height_points=9", "--textures", "t"];
    let looks = ["--set", "material.texture=halves", "--set", "material.shader=texture"];
    scratch.succeed(&[&["export", &path, out][..], &look, &looks, more].concat());
}

/// The first point has the texture's upper left corner, the last the lower right one.
fn assert_upright(cloth: &Value, out: &str) {
    assert_eq!((&cloth["vertices"], &cloth["faces"]), (&81.into(), &128.into()), "{out}");
    assert!(cloth["outward"].as_f64() > Some(0.5), "{out}: faces turn to the side of their normals: {cloth}");
    if matches!(out, "cloth.obj" | "cloth.glb") {
        assert_eq!(cloth["colors"], json!([[255, 0, 0], [0, 0, 255]]), "{out}");
    } else {
        assert_eq!(cloth["uv"], json!([[0.0, 1.0], [1.0, 0.0]]), "{out}: v grows upwards");
    }
}

#[test]
fn trimesh_reads_meshes_with_their_textures_upright() {
    let scratch = Scratch::new();
    textures(&scratch);
    export(&scratch, "cloth.obj", &["--frame", "20", "--materials"]);
    export(&scratch, "plain.obj", &["--frame", "20"]);
    export(&scratch, "cloth.ply", &["--frame", "20"]);
    export(&scratch, "cloth.glb", &["--frame", "20"]);
    assert!(scratch.path("halves.png").exists() && scratch.path("cloth.mtl").exists());
    let mut bounds = Vec::new();
    for out in ["cloth.obj", "plain.obj", "cloth.ply", "cloth.glb"] {
        let Some(found) = python(&scratch, "meshes", &[out]) else { return };
        let cloth = found.as_object().unwrap().values().next().unwrap().clone();
        assert_upright(&cloth, out);
        bounds.push(serde_json::from_value::<Vec<[f64; 3]>>(cloth["bounds"].clone()).unwrap());
    }
    let near = |a: &Vec<[f64; 3]>| {
        a.as_flattened().iter().zip(bounds[0].as_flattened()).all(|(a, b)| (a - b).abs() < 1e-6)
    };
    assert!(bounds.iter().all(near), "{bounds:?}");
}

#[test]
fn trimesh_reads_the_other_objects_where_they_are() {
    let scratch = Scratch::new();
    textures(&scratch);
    for out in ["all.obj", "all.glb"] {
        export(&scratch, out, &["--frame", "0", "--objects", "--materials"]);
        let Some(found) = python(&scratch, "meshes", &[out]) else { return };
        assert_eq!(found.as_object().unwrap().len(), 2, "{out}: {found}");
        let ball = found.as_object().unwrap().iter().find(|(name, _)| name.starts_with("sphere")).unwrap().1;
        let bounds: Vec<[f64; 3]> = serde_json::from_value(ball["bounds"].clone()).unwrap();
        // As it is drawn, with 0.92 of its radius.
        for (axis, centre) in [0.5, 0.2, 0.5].into_iter().enumerate() {
            let middle = (bounds[0][axis] + bounds[1][axis]) / 2.0;
            assert!((middle - centre).abs() < 2e-3, "{out}: {bounds:?}");
            assert!((bounds[1][axis] - middle - 0.92 * 0.2).abs() < 2e-3, "{out}: {bounds:?}");
        }
    }
}

/// Numbers of 32 bits are 6 cm apart there.
#[test]
fn trimesh_reads_what_is_a_million_metres_away_in_its_shape() {
    let scratch = Scratch::new();
    textures(&scratch);
    let bounds = |x: f64| {
        let offset = format!("cloth.offset=[{x},0,0]");
        export(&scratch, "far.glb", &["--frame", "0", "--set", &offset]);
        let found = python(&scratch, "meshes", &["far.glb"])?;
        let cloth = found.as_object().unwrap().values().next().unwrap();
        Some(serde_json::from_value::<[[f64; 3]; 2]>(cloth["bounds"].clone()).unwrap())
    };
    let x = 1_000_000.03;
    let (Some(near), Some(far)) = (bounds(0.0), bounds(x)) else { return };
    for (near, far) in near.into_iter().zip(far) {
        let away = (far[0] - near[0] - x).abs().max((far[1] - near[1]).abs()).max((far[2] - near[2]).abs());
        assert!(away < 1e-6, "{near:?} and {far:?}");
    }
}

/// What the Khronos validator says of a file.
fn validated(scratch: &Scratch, file: &str) -> Option<Value> {
    let script = crate::repository::path("tests/cli/readers/validate.js");
    let modules = installed("node_modules");
    if !modules.join("gltf-validator").exists() {
        not_checked("the glTF validator", ".ci/install-readers has not run");
        return None;
    }
    let run =
        Command::new("node").arg(script).arg(modules).arg(scratch.path(file)).output().expect("node starts");
    assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
    Some(serde_json::from_slice(&run.stdout).unwrap())
}

#[test]
fn the_khronos_validator_finds_nothing_to_say() {
    let scratch = Scratch::new();
    textures(&scratch);
    for (out, more) in [
        ("one.glb", &["--frame", "30"][..]),
        ("all.glb", &["--frame", "30", "--objects"]),
        ("motion.glb", &["--frames", "3..9", "--objects"]),
        ("far.glb", &["--frame", "3", "--set", "cloth.offset=[1e6,0,0]"]),
        ("colour.glb", &["--frame", "3", "--set", "cloth.material.shader=phong"]),
    ] {
        export(&scratch, out, more);
        let Some(found) = validated(&scratch, out) else { return };
        let issues = &found["issues"];
        let [errors, warnings] = ["numErrors", "numWarnings"].map(|key| issues[key].as_u64());
        assert_eq!((errors, warnings), (Some(0), Some(0)), "{out}: {issues}");
        assert_eq!(found["info"]["animationCount"], u64::from(out == "motion.glb"), "{out}");
        assert_eq!(found["info"]["hasMorphTargets"], out == "motion.glb", "{out}");
    }
}

#[test]
fn blender_plays_the_motion() {
    let scratch = Scratch::new();
    textures(&scratch);
    export(&scratch, "motion.glb", &["--frames", "0..31"]);
    let found = python(&scratch, "blender", &["motion.glb", "30"]).unwrap_or(Value::Null);
    if found.is_null() {
        return println!("not checked: Blender: there is no `bpy`");
    }
    let path = scene("sphere.json");
    let few = ["--set", "cloth.num_width_points=9", "--set", "cloth.num_height_points=9"];
    scratch.succeed(&[&["simulate", &path, "--frames", "30", "--positions", "p"][..], &few].concat());
    let numbers: Vec<f64> =
        scratch.read("p").chunks(8).map(|c| f64::from_le_bytes(c.try_into().unwrap())).collect();
    let mut expected: Vec<f64> = numbers.chunks(3).map(|point| point[1]).collect();
    expected.sort_by(f64::total_cmp);
    let heights: Vec<Vec<f64>> = serde_json::from_value(found["heights"].clone()).unwrap();
    assert!(heights[0].iter().all(|height| (height - 1.0).abs() < 1e-6), "flat at first: {:?}", heights[0]);
    let off = heights[1].iter().zip(&expected).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    assert!(heights[1].len() == 81 && off < 1e-5, "{off}");
}
