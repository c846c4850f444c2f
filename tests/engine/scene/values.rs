//! Promise: a valid scene means exactly what it says.

use std::fs;

use drape::scene::{
    Bitangent, Camera, Cloth, Collider, Contact, Cuboid, Damping, Filter, Integrator, Light, Material,
    Orientation, Overrides, Plane, Precision, Render, Scene, SelfCollision, Shader, Sim, Sphere, Start, Vec3,
    load, load_text,
};

const STOCK: [&str; 5] = ["pinned2", "pinned4", "sphere", "plane", "selfCollision"];

fn stock(name: &str) -> Scene {
    let loaded = load(&crate::repository::path(&format!("scenes/{name}.json")), &Overrides::default())
        .expect("a stock scene loads");
    assert_eq!(loaded.warnings, [], "{name}");
    loaded.scene
}

pub(super) fn with(text: &str, sets: &[&str]) -> Scene {
    let sets = sets.iter().map(ToString::to_string).collect();
    load_text("scene.json", text, &Overrides { sets, ..Overrides::default() }).expect("a valid scene").scene
}

fn material() -> Material {
    Material {
        shader: Shader::Phong,
        color: Vec3::new(1.0, 1.0, 1.0),
        ka: 0.1,
        kd: 0.7,
        ks: 1.0,
        shininess: 64.0,
        km: 0.25,
        normal_scaling: 2.0,
        height_scaling: 0.1,
        texture: "texture_1".into(),
        height_map: "texture_2".into(),
        environment: "cube".into(),
        bitangent: Bitangent::NormalCrossTangent,
        two_sided: false,
    }
}

/// A scene in which nothing but `{}` is said.
pub(super) fn empty() -> Scene {
    Scene {
        cloth: None,
        colliders: vec![],
        sim: Sim {
            fps: 90.0,
            steps_per_frame: 30,
            gravity: Vec3::new(0.0, -9.8, 0.0),
            integrator: Integrator::Verlet,
            iterations: 1,
            tolerance: 1e-4,
            precision: Precision::F64,
            start: Start::Report,
            damping: Damping::PerStep,
            stretch_limit: Some(0.1),
            stretch_passes: 1,
            self_collision: SelfCollision::SameBox,
            contact: Contact::Report,
        },
        camera: Camera {
            target: None,
            distance: None,
            polar: 90.0,
            azimuth: 0.0,
            hfov: 50.0,
            vfov: 35.0,
            fit: false,
            near: 0.01,
            far: 10_000.0,
        },
        light: Light {
            position: Vec3::new(0.5, 2.0, 2.0),
            intensity: Vec3::new(3.0, 3.0, 3.0),
            color: Vec3::new(1.0, 1.0, 1.0),
        },
        render: Render {
            size: [1024, 800],
            samples: 1,
            background: Vec3::new(0.25, 0.25, 0.25),
            time: 2.0,
            filter: Filter::Bilinear,
            seamless: false,
        },
    }
}

pub(super) fn stock_cloth() -> Cloth {
    Cloth {
        width: 1.0,
        height: 1.0,
        num_width_points: 50,
        num_height_points: 50,
        thickness: 0.0095,
        orientation: Orientation::Horizontal,
        offset: Vec3::zeros(),
        velocity: Vec3::zeros(),
        pinned: vec![],
        damping: 0.2,
        density: 150.0,
        ks: 5000.0,
        enable_structural: true,
        enable_shearing: true,
        enable_bending: true,
        material: material(),
    }
}

fn floor() -> Collider {
    Collider::Plane(Plane {
        point: Vec3::zeros(),
        normal: Vec3::new(0.0, 1.0, 0.0),
        friction: 0.5,
        material: Material { color: Vec3::new(0.7, 0.7, 0.7), ..material() },
    })
}

fn ball() -> Collider {
    Collider::Sphere(Sphere {
        origin: Vec3::new(0.5, 0.2, 0.5),
        radius: 0.2,
        friction: 0.3,
        resolution: [40, 40],
        material: material(),
    })
}

#[test]
fn the_stock_scenes_have_exactly_their_values() {
    let pinned = |pinned: &[[usize; 2]]| Some(Cloth { pinned: pinned.to_vec(), ..stock_cloth() });
    assert_eq!(stock("pinned2"), Scene { cloth: pinned(&[[0, 0], [49, 0]]), ..empty() });
    let corners = [[0, 0], [0, 49], [49, 0], [49, 49]];
    assert_eq!(stock("pinned4"), Scene { cloth: pinned(&corners), ..empty() });
    let horizontal = Some(stock_cloth());
    assert_eq!(stock("sphere"), Scene { cloth: horizontal.clone(), colliders: vec![ball()], ..empty() });
    assert_eq!(stock("plane"), Scene { cloth: horizontal, colliders: vec![floor()], ..empty() });
    let vertical = Some(Cloth { orientation: Orientation::Vertical, ..stock_cloth() });
    assert_eq!(stock("selfCollision"), Scene { cloth: vertical, colliders: vec![floor()], ..empty() });
}

#[test]
fn the_stock_files_hold_only_keys_of_the_original_format() {
    let keys =
        |value: &serde_json::Value| -> Vec<String> { value.as_object().unwrap().keys().cloned().collect() };
    for name in STOCK {
        let text = fs::read_to_string(crate::repository::path(&format!("scenes/{name}.json"))).unwrap();
        let scene: serde_json::Value = serde_json::from_str(&text).unwrap();
        for (object, allowed) in [
            (
                "cloth",
                "width height num_width_points num_height_points thickness orientation pinned damping density ks enable_structural enable_shearing enable_bending",
            ),
            ("sphere", "origin radius friction"),
            ("plane", "point normal friction"),
        ] {
            let found = scene.get(object).map(keys).unwrap_or_default();
            assert!(found.iter().all(|key| allowed.split(' ').any(|a| a == key)), "{name}: {found:?}");
        }
        assert!(
            keys(&scene).iter().all(|key| ["cloth", "sphere", "plane"].contains(&key.as_str())),
            "{name}"
        );
    }
}

#[test]
fn every_optional_key_is_read() {
    let text = r#"{
      "sim": {"fps": 30, "steps_per_frame": 5, "gravity": [1, 2, 3], "integrator": "verlet", "precision": "f64",
              "start": "half_step", "damping": "per_second", "stretch_limit": null, "stretch_passes": 7,
              "self_collision": "neighbors", "contact": "outside"},
      "camera": {"target": [1, 2, 3], "distance": 4, "polar": 5, "azimuth": -6, "hfov": 7, "vfov": 8, "fit": true, "near": 9,
                 "far": 10},
      "light": {"position": [1, 2, 3], "intensity": [4, 5, 6], "color": [0, 0, 7]},
      "material": {"shader": "custom", "color": [0.1, 0.2, 0.3], "ka": 1, "kd": 2, "ks": 3, "shininess": 4, "km": 5,
                   "normal_scaling": -6, "height_scaling": -7, "texture": "a", "height_map": "b", "environment": "c",
                   "bitangent": "uv", "two_sided": true},
      "sphere": [{"origin": [1, 2, 3], "radius": 4, "friction": 1, "resolution": [16, 8]}],
      "plane": {"point": [1, 2, 3], "normal": [0, 0, -4], "friction": 0},
      "box": {"origin": [1, 2, 3], "size": [4, 5, 6], "friction": 0.5},
      "render": {"size": [640, 480], "samples": 16, "background": [0, 1, 0], "time": 0, "filter": "nearest",
                 "seamless": true}
    }"#;
    let v123 = Vec3::new(1.0, 2.0, 3.0);
    let material = Material {
        shader: Shader::Custom,
        color: Vec3::new(0.1, 0.2, 0.3),
        ka: 1.0,
        kd: 2.0,
        ks: 3.0,
        shininess: 4.0,
        km: 5.0,
        normal_scaling: -6.0,
        height_scaling: -7.0,
        texture: "a".into(),
        height_map: "b".into(),
        environment: "c".into(),
        bitangent: Bitangent::Uv,
        two_sided: true,
    };
    let expected = Scene {
        cloth: None,
        sim: Sim {
            fps: 30.0,
            steps_per_frame: 5,
            gravity: v123,
            stretch_limit: None,
            stretch_passes: 7,
            start: Start::HalfStep,
            damping: Damping::PerSecond,
            self_collision: SelfCollision::Neighbors,
            contact: Contact::Outside,
            ..empty().sim
        },
        camera: Camera {
            target: Some(v123),
            distance: Some(4.0),
            polar: 5.0,
            azimuth: -6.0,
            hfov: 7.0,
            vfov: 8.0,
            fit: true,
            near: 9.0,
            far: 10.0,
        },
        light: Light { position: v123, intensity: Vec3::new(4.0, 5.0, 6.0), color: Vec3::new(0.0, 0.0, 7.0) },
        colliders: vec![
            Collider::Plane(Plane {
                point: v123,
                normal: Vec3::new(0.0, 0.0, -4.0),
                friction: 0.0,
                material: material.clone(),
            }),
            Collider::Sphere(Sphere {
                origin: v123,
                radius: 4.0,
                friction: 1.0,
                resolution: [16, 8],
                material: material.clone(),
            }),
            Collider::Cuboid(Cuboid {
                origin: v123,
                size: Vec3::new(4.0, 5.0, 6.0),
                friction: 0.5,
                material,
            }),
        ],
        render: Render {
            size: [640, 480],
            samples: 16,
            background: Vec3::new(0.0, 1.0, 0.0),
            time: 0.0,
            filter: Filter::Nearest,
            seamless: true,
        },
    };
    assert_eq!(with(text, &[]), expected);
}

#[test]
fn materials_are_inherited_key_by_key() {
    let text = fs::read_to_string(crate::repository::path("scenes/plane.json")).unwrap();
    let sets = ["material.shader=bump", "material.ka=0.5", "cloth.material.ka=0.25", "plane.material.kd=0"];
    let scene = with(&text, &sets);
    let common = Material { shader: Shader::Bump, ka: 0.5, ..material() };
    let grey = Vec3::new(0.7, 0.7, 0.7);
    let cloth = Material { ka: 0.25, ..common.clone() };
    assert!(scene.materials().eq([&cloth, &Material { kd: 0.0, color: grey, ..common }]));

    let red = Vec3::new(1.0, 0.0, 0.0);
    let scene = with(&text, &["material.color=[1,0,0]"]);
    assert_eq!(
        scene.planes().next().unwrap().material.color,
        red,
        "a colour for all objects is also the plane's"
    );
    let scene = with(&text, &["plane.material.color=[1,0,0]"]);
    assert_eq!(scene.planes().next().unwrap().material.color, red);
    assert_eq!(scene.cloth.unwrap().material.color, Vec3::new(1.0, 1.0, 1.0));
}
