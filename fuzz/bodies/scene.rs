//! Scenes: whatever a file, its patches and its changes say, they give a scene in range, or errors with their places.

use std::fs;
use std::path::PathBuf;

use drape::error::Kind;
use drape::scene::{Collider, Material, Overrides, Scene, Vec3, load, load_text, plan};
use serde_json::Value;
use tempfile::TempDir;

/// Most patches of an input.
const MOST_PATCHES: usize = 3;

/// Reads the bytes as a scene. A line `%patch` starts a patch, and a line `%set PATH=JSON` is a change.
pub(crate) fn run(bytes: &[u8]) {
    let (mut documents, mut sets) = (vec![Vec::new()], Vec::new());
    for line in bytes.split_inclusive(|&byte| byte == b'\n') {
        if let Some(set) = line.strip_prefix(b"%set ") {
            sets.push(String::from_utf8_lossy(set.strip_suffix(b"\n").unwrap_or(set)).into_owned());
        } else if line.starts_with(b"%patch") && documents.len() <= MOST_PATCHES {
            documents.push(Vec::new());
        } else if let Some(document) = documents.last_mut() {
            document.extend(line);
        }
    }
    let files = Files::new(&documents[1..]);
    let overrides = Overrides { patches: files.paths.clone(), sets, flags: Vec::new() };
    let Some(scene) = loads_or_explains(&documents[0], &overrides) else { return };
    assert!(plan(&scene).iter().all(|item| !format!("{item:?}").is_empty()));
    let text = written(&scene).to_string();
    let again = load_text("written.json", &text, &Overrides::default());
    let again = again.unwrap_or_else(|error| panic!("{error:?}\n{text}")).scene;
    assert!(again.motion() == scene.motion() && again.moves_like(&scene), "{text}");
}

/// What holds of every file: a scene in range, or errors each with its place.
pub(crate) fn loads_or_explains(bytes: &[u8], overrides: &Overrides) -> Option<Scene> {
    let loaded = match std::str::from_utf8(bytes) {
        Ok(text) => load_text("x.json", text, overrides),
        Err(_) => {
            let file = Files::new(&[bytes.to_vec()]);
            load(&file.paths[0], overrides)
        }
    };
    let error = match loaded {
        Ok(loaded) => {
            assert_in_range(&loaded.scene);
            return Some(loaded.scene);
        }
        Err(error) => error,
    };
    assert!(matches!(error.kind, Kind::Scene | Kind::Usage), "{error:?}");
    assert_eq!(error.diagnostics.is_empty(), error.kind == Kind::Usage, "{error:?}");
    for found in error.diagnostics.iter().filter(|found| found.code != "scene::more") {
        assert!(!found.message.is_empty() && !found.rendered.is_empty(), "{found:?}");
        let place = format!("--> {}:{}:{}\n", found.file, found.line, found.column);
        // Other characters are shown in another way.
        let printable = found.file.chars().all(|c| c.is_ascii_graphic());
        assert!(!printable || (found.rendered.clone() + "\n").contains(&place), "{place}{}", found.rendered);
    }
    None
}

/// Asserts that every value of a scene is finite and within the range that its documentation states.
fn assert_in_range(scene: &Scene) {
    let positive = |x: f64| (1e-15..=1e15).contains(&x);
    let not_negative = |x: f64| (0.0..=1e15).contains(&x);
    let any = |v: Vec3| v.iter().all(|x| (-1e15..=1e15).contains(x));
    let all_not_negative = |v: Vec3| v.iter().all(|&x| not_negative(x));
    if let Some(c) = &scene.cloth {
        assert!([c.width, c.height, c.density].into_iter().all(positive));
        assert!(c.num_width_points >= 2 && c.num_height_points >= 2);
        assert!(c.num_width_points * c.num_height_points <= 1 << 22);
        assert!(not_negative(c.thickness) && not_negative(c.ks) && (0.0..=100.0).contains(&c.damping));
        assert!(any(c.offset) && any(c.velocity));
        assert!(c.pinned.iter().all(|&[x, y]| x < c.num_width_points && y < c.num_height_points));
    }
    assert!(scene.colliders.len() <= 255);
    for collider in &scene.colliders {
        assert!(not_negative(collider.friction()));
        match collider {
            Collider::Plane(p) => assert!(any(p.point) && any(p.normal) && p.normal.amax() >= 1e-15),
            Collider::Sphere(s) => {
                assert!(any(s.origin) && positive(s.radius));
                assert!((2..=1000).contains(&s.resolution[0]) && (3..=1000).contains(&s.resolution[1]));
            }
            Collider::Cuboid(c) => assert!(any(c.origin) && c.size.iter().all(|&edge| positive(edge))),
        }
    }
    scene.materials().for_each(assert_material_in_range);
    let sim = &scene.sim;
    assert!((1e-6..=1e9).contains(&sim.fps) && (1..=1_000_000_000).contains(&sim.steps_per_frame));
    assert!(any(sim.gravity) && sim.stretch_limit.is_none_or(not_negative));
    assert!([sim.stretch_passes, sim.iterations].iter().all(|count| (1..=1_000_000).contains(count)));
    assert!((1e-15..=1.0).contains(&sim.tolerance));
    let camera = &scene.camera;
    assert!(camera.target.is_none_or(any) && camera.distance.is_none_or(positive));
    assert!((0.0..=180.0).contains(&camera.polar) && camera.azimuth.abs() <= 1e15);
    assert!([camera.hfov, camera.vfov].iter().all(|fov| (0.001..=179.999).contains(fov)));
    assert!(positive(camera.near) && positive(camera.far) && camera.near < camera.far);
    let light = &scene.light;
    assert!(any(light.position) && all_not_negative(light.intensity) && all_not_negative(light.color));
    assert!(light.color.amax() >= 1e-15);
    let render = &scene.render;
    assert!(render.size.iter().all(|side| (1..=16384).contains(side)));
    assert!([1, 4, 8, 16].contains(&render.samples) && (0.0..=1e6).contains(&render.time));
    assert!(all_not_negative(render.background));
}

fn assert_material_in_range(m: &Material) {
    let not_negative = |x: f64| (0.0..=1e15).contains(&x);
    let name = |name: &str| !name.is_empty() && !name.contains(['/', '\\', '.', '\0']);
    assert!(m.color.iter().all(|&x| not_negative(x)));
    assert!([m.ka, m.kd, m.ks, m.shininess, m.km].into_iter().all(not_negative));
    assert!(m.normal_scaling.abs() <= 1e15 && m.height_scaling.abs() <= 1e15);
    assert!([&m.texture, &m.height_map, &m.environment].into_iter().all(|n| name(n)));
}

/// What decides how the cloth moves, written as the text of a scene.
fn written(scene: &Scene) -> Value {
    let mut document = Value::Object(serde_json::Map::new());
    for (path, value) in scene.motion() {
        let mut at = &mut document;
        for step in path.split('.') {
            at = match step.parse::<usize>() {
                Ok(number) => item(at, number),
                Err(_) => &mut at[step],
            };
        }
        *at = value;
    }
    document
}

/// An item of a list, made if it is not there.
fn item(at: &mut Value, number: usize) -> &mut Value {
    if at.is_null() {
        *at = Value::Array(Vec::new());
    }
    if let Value::Array(items) = at
        && items.len() <= number
    {
        items.resize(number + 1, Value::Null);
    }
    &mut at[number]
}

/// Files that are there as long as this is.
struct Files {
    _folder: Option<TempDir>,
    paths: Vec<PathBuf>,
}

impl Files {
    fn new(contents: &[Vec<u8>]) -> Self {
        let folder = (!contents.is_empty()).then(|| TempDir::new().expect("a folder"));
        let path = |i: usize| Some(folder.as_ref()?.path().join(format!("{i}.json")));
        let paths: Vec<PathBuf> = (0..contents.len()).filter_map(path).collect();
        for (path, content) in paths.iter().zip(contents) {
            fs::write(path, content).expect("a file is written");
        }
        Self { _folder: folder, paths }
    }
}
