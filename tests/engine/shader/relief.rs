//! A relief is lit from the side where the light is, and both sides of a surface where that is asked for.

use std::fs;

use drape::cloth::Points;
use drape::render::{Options, Picture, Renderer};
use drape::scene::{Overrides, Scene, load, load_text};
use drape::simulation::Simulation;
use drape::texture_source::TextureSource;
use image::{ImageBuffer, Luma};

/// The mean brightness around the middle of a picture.
fn brightness(picture: &Picture) -> f64 {
    let (w, h) = (picture.width as usize, picture.height as usize);
    let middle = (2 * h / 5..3 * h / 5).flat_map(|y| (2 * w / 5..3 * w / 5).map(move |x| 3 * (y * w + x)));
    let values: Vec<f64> = middle.map(|at| f64::from(picture.rgb[at])).collect();
    values.iter().sum::<f64>() / values.len() as f64
}

/// A scene whose height map rises from v = 0 to v = 1.
fn on_a_ramp(text: &str, sets: &[&str]) -> f64 {
    let folder = tempfile::tempdir().unwrap();
    let ramp = ImageBuffer::<Luma<u16>, _>::from_fn(64, 64, |_, y| Luma([(y * 1000) as u16]));
    ramp.save(folder.path().join("ramp.png")).unwrap();
    let shared = [
        "material.height_map=ramp",
        "material.ks=0",
        "render.size=[100,80]",
        "material.normal_scaling=60000",
        "material.height_scaling=0.001",
    ];
    let sets = shared.iter().chain(sets).map(ToString::to_string).collect();
    let scene = load_text("ramp.json", text, &Overrides { sets, ..Overrides::default() }).unwrap().scene;
    let source = TextureSource::Folder(folder.path().to_path_buf());
    let points = Simulation::new(&scene).map(|s| s.positions().clone()).unwrap_or_else(|_| Points::default());
    brightness(&Renderer::new(&scene, &source).unwrap().draw(&points, &Options::default()))
}

const FLOOR: &str = r#"{"plane": {"point": [0, 0, 0], "normal": [0, 1, 0], "friction": 0},
    "camera": {"target": [0, 0, 0], "distance": 2, "polar": 20}}"#;
const BALL: &str = r#"{"sphere": {"origin": [0, 0, 0], "radius": 1, "friction": 0},
    "camera": {"target": [0, 0, 0], "distance": 4}}"#;
const BOX: &str = r#"{"box": {"origin": [0, 0, 0], "size": [2, 2, 2], "friction": 0},
    "camera": {"target": [0, 0, 0], "distance": 5}}"#;

/// The ramp falls towards v = 0, so what lies there lights it, and what lies beyond v = 1 does not. On a floor v grows
/// towards +z, on a ball, the sides of a box and a cloth that lies flat downwards or towards +z.
#[test]
fn a_relief_is_lit_from_the_right_side() {
    let cloth = fs::read_to_string(crate::repository::path("scenes/pinned2.json")).unwrap();
    let above = ["camera.polar=10", "camera.target=[0.5,1,0.5]", "camera.distance=1.5"];
    for (text, view, low, high) in [
        (FLOOR, &[][..], "[0,1,-2]", "[0,1,2]"),
        (BALL, &[], "[0,3,2]", "[0,-3,2]"),
        (BOX, &[], "[0,3,2]", "[0,-3,2]"),
        (BOX, &["camera.azimuth=-90"], "[-2,3,0]", "[-2,-3,0]"),
        (BOX, &["camera.polar=0"], "[0,2,-3]", "[0,2,3]"),
        (cloth.as_str(), &above, "[0.5,2,-1]", "[0.5,2,2]"),
    ] {
        for shader in ["bump", "displacement"] {
            let lit = |bitangent: &str, light: &str| {
                let (shader, light) =
                    (format!("material.shader={shader}"), format!("light.position={light}"));
                let bitangent = format!("material.bitangent={bitangent}");
                on_a_ramp(text, &[view, &[&shader, &light, &bitangent]].concat())
            };
            let right = lit("uv", low) - lit("uv", high);
            let wrong = lit("normal_cross_tangent", low) - lit("normal_cross_tangent", high);
            assert!(right > 15.0 && wrong < -15.0, "{shader}: {right} and {wrong}");
        }
    }
}

#[test]
fn both_sides_are_lit_where_that_is_asked_for() {
    let drawn = |scene: &str, sets: &[&str]| {
        let path = crate::repository::path("scenes").join(format!("{scene}.json"));
        let sets = sets.iter().map(ToString::to_string).collect();
        let scene: Scene = load(&path, &Overrides { sets, ..Overrides::default() }).unwrap().scene;
        let simulation = Simulation::new(&scene).unwrap();
        let picture = Renderer::new(&scene, &TextureSource::BuiltIn)
            .unwrap()
            .draw(simulation.positions(), &Options::default());
        brightness(&picture)
    };
    for shader in ["diffuse", "phong", "bump", "displacement"] {
        let shader = format!("material.shader={shader}");
        let small = ["render.size=[100,80]", "camera.polar=85", &shader];
        let one = drawn("selfCollision", &small);
        let both = drawn("selfCollision", &[&small[..], &["material.two_sided=true"]].concat());
        assert!(one < 30.0 && both > one + 40.0, "{shader}: {one} and {both}");
        // What faces the camera stays as it is.
        let above = ["render.size=[100,80]", "camera.polar=20", "camera.target=[0.5,1,0.5]", &shader];
        let (one, both) = (
            drawn("pinned2", &above),
            drawn("pinned2", &[&above[..], &["material.two_sided=true"]].concat()),
        );
        assert!(one > 60.0 && one == both, "{shader}: {one} and {both}");
    }
}
