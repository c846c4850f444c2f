//! A key that is given and changes nothing is warned of, and no other.

use drape::cloth::Points;
use drape::render::{Options, Renderer};
use drape::scene::{Overrides, Scene, Shader, load, load_text};
use drape::texture_source::TextureSource;

/// The keys that are warned of in a text with changes.
fn ineffective(text: &str, sets: &[String]) -> (Scene, Vec<String>) {
    let loaded =
        load_text("x.json", text, &Overrides { sets: sets.to_vec(), ..Overrides::default() }).unwrap();
    let keys = loaded.warnings.iter().filter(|warning| warning.code == "scene::without_effect");
    (loaded.scene, keys.map(|warning| warning.key.clone()).collect())
}

const BALL: &str =
    r#"{"sphere": {"origin": [0.5, 0.5, 0.5], "radius": 0.5, "friction": 0}, "render": {"size": [60, 50]}}"#;

fn drawn(scene: &Scene) -> Vec<u8> {
    let renderer = Renderer::new(scene, &TextureSource::BuiltIn).unwrap();
    renderer.draw(&Points::default(), &Options::default()).rgb
}

/// Every key of a material with every shader: it is warned of exactly where the picture stays the same.
#[test]
fn a_key_of_a_material_is_warned_of_where_no_shader_reads_it() {
    // From below, so that what faces away is seen.
    let base =
        ["camera.polar=120", "material.normal_scaling=30", "light.position=[0.5,2,0.6]"].map(String::from);
    let mut unread = 0;
    for (name, _) in Shader::NAMES {
        let with = |more: &[&str]| {
            let sets: Vec<String> = base
                .iter()
                .cloned()
                .chain([format!("material.shader={name}")])
                .chain(more.iter().map(|set| set.to_string()))
                .collect();
            ineffective(BALL, &sets)
        };
        let plain = drawn(&with(&[]).0);
        for set in [
            "color=[0.2,0.4,0.1]",
            "ka=0.4",
            "kd=0.3",
            "ks=0.1",
            "shininess=3",
            "km=0.9",
            "normal_scaling=-90",
            "height_scaling=0.3",
            "texture=texture_4",
            "height_map=texture_3",
            "bitangent=uv",
        ] {
            let set = format!("material.{set}");
            let key = set.split('=').next().unwrap();
            let (scene, warned) = with(&[&set]);
            let changes = drawn(&scene) != plain;
            assert_eq!(changes, !warned.iter().any(|warned| warned == key), "{name} {set}: {warned:?}");
            unread += usize::from(!changes);
        }
    }
    assert!(unread > 40, "{unread}");
}

#[test]
fn keys_that_take_another_are_warned_of() {
    let scene = |name: &str| std::fs::read_to_string(crate::repository::path("scenes").join(name)).unwrap();
    let (sphere, pinned) = (scene("sphere.json"), scene("pinned2.json"));
    for (text, sets, expected) in [
        (&sphere, &["sim.iterations=3"][..], &["sim.iterations"][..]),
        (&sphere, &["sim.iterations=3", "sim.integrator=xpbd"], &[]),
        (&sphere, &["sim.iterations=1"], &[]),
        (&sphere, &["sim.tolerance=1e-3"], &["sim.tolerance"]),
        (&sphere, &["sim.tolerance=1e-3", "sim.integrator=bdf2"], &[]),
        (&sphere, &["sim.stretch_passes=3", "sim.stretch_limit=null"], &["sim.stretch_passes"]),
        (&sphere, &["sim.stretch_passes=3"], &[]),
        (&pinned, &["render.samples=8", "material.shader=wireframe"], &["render.samples"]),
        (&sphere, &["render.samples=8", "material.shader=wireframe"], &[]),
        (&sphere, &["render.filter=nearest"], &["render.filter"]),
        (&sphere, &["render.filter=nearest", "material.shader=mirror"], &[]),
        (&sphere, &["render.seamless=true", "material.shader=texture"], &["render.seamless"]),
        (&sphere, &["render.seamless=true", "material.shader=mirror"], &[]),
        (&sphere, &["light.color=[1,0,0]"], &["light.color"]),
        (&sphere, &["camera.vfov=20"], &["camera.vfov"]),
        (&sphere, &["camera.vfov=60"], &[]),
        (&sphere, &["camera.hfov=30"], &["camera.hfov"]),
        (&sphere, &["camera.hfov=49"], &[]),
        (&sphere, &["camera.vfov=20", "render.size=[200,100]"], &["camera.vfov"]),
        (&sphere, &["camera.vfov=36", "render.size=[200,100]"], &[]),
        (&sphere, &["sim.gravity=[0,-1,0]", "cloth=null"], &["sim"]),
        (&sphere, &["sim.fps=60", "cloth=null"], &[]),
        (&pinned, &["sim.contact=coulomb"], &["sim.contact"]),
        (&sphere, &["sim.contact=coulomb"], &[]),
        (&pinned, &["sim.self_collision=neighbors", "cloth.thickness=0"], &["sim.self_collision"]),
        (&pinned, &["sim.self_collision=off", "cloth.thickness=0"], &[]),
        (&pinned, &["sim.self_collision=neighbors"], &[]),
        (&pinned, &["sim.damping=per_second", "cloth.damping=0"], &["sim.damping"]),
        (&pinned, &["sim.damping=per_second"], &[]),
        (&sphere, &["material.color=[1,0,0]", "cloth=null", "sphere=null"], &["material.color"]),
        (&pinned, &["material.color=[1,0,0]", "cloth.material.color=[0,1,0]"], &["material.color"]),
        (&sphere, &["material.color=[1,0,0]", "cloth.material.color=[0,1,0]"], &[]),
        (&pinned, &["material.shader=normal", "cloth.material.shader=phong"], &["material.shader"]),
        (&sphere, &["material.shader=normal", "cloth.material.shader=phong"], &[]),
        (&sphere, &["light.intensity=[1,0,0]", "material.shader=texture"], &["light.intensity"]),
        (&sphere, &["light.position=[1,9,0]"], &[]),
        (&sphere, &["camera.distance=3", "camera.fit=true"], &["camera.distance"]),
        (&sphere, &["sphere.material.km=1"], &["sphere.material.km"]),
        (&sphere, &["sphere.material.km=1", "sphere.material.shader=custom"], &[]),
        (&sphere, &["material.km=1", "sphere.material.shader=custom"], &[]),
    ] {
        let sets: Vec<String> = sets.iter().map(ToString::to_string).collect();
        assert_eq!(ineffective(text, &sets).1, expected, "{sets:?}");
    }
}

#[test]
fn stock_scenes_and_looks_are_not_warned_of() {
    for name in ["sphere", "plane", "pinned2", "pinned4", "selfCollision"] {
        let path = crate::repository::path("scenes").join(format!("{name}.json"));
        for look in [None, Some("ball"), Some("draped"), Some("folding")] {
            let patches =
                look.map(|look| crate::repository::path("scenes/look").join(format!("{look}.json")));
            let overrides = Overrides { patches: patches.into_iter().collect(), ..Overrides::default() };
            assert_eq!(load(&path, &overrides).unwrap().warnings, [], "{name} {look:?}");
        }
    }
}
