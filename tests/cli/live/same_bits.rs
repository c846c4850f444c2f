//! The live page computes the same bits as the native program, in Node and in a browser.

use std::collections::BTreeMap;
use std::path::Path;
use std::process::Command;
use std::sync::OnceLock;

use drape::render::{Options, Renderer};
use drape::scene::{Overrides, Scene, Shader, load_stock};
use drape::simulation::Simulation;
use drape::texture_source::TextureSource;
use serde_json::Value;

use super::{built, go, opened};

const SCENES: [&str; 6] = ["sphere", "plane", "pinned2", "pinned4", "selfCollision", "table"];

/// Frames that are compared.
const FRAMES: usize = 90;

/// A function of the page's language that steps through frames, and gives the state hash that is shown at each.
const EVERY_FRAME: &str = "async (frames) => { const text = (id) => document.getElementById(id).textContent; \
    const states = [text('state-hash')]; \
    while (states.length <= frames) { document.getElementById('step').click(); \
      while (text('frame') !== String(states.length)) await new Promise((done) => setTimeout(done, 1)); \
      states.push(text('state-hash')); } return states; }";

/// What the native program computes for a scene.
struct Native {
    /// The state hash of each frame, from the start on.
    states: Vec<String>,
    /// The picture hash of the last frame by shader, at 320 × 250.
    pictures: BTreeMap<&'static str, String>,
}

/// The scenes by name.
fn native() -> &'static BTreeMap<&'static str, Native> {
    static NATIVE: OnceLock<BTreeMap<&'static str, Native>> = OnceLock::new();
    NATIVE.get_or_init(|| SCENES.map(|name| (name, simulated(name))).into())
}

fn scene(name: &str) -> Scene {
    let sets = vec!["render.size=[320,250]".to_owned()];
    let path = format!("scenes/{name}.json");
    load_stock(Path::new(&path), &Overrides { sets, ..Overrides::default() }).unwrap().scene
}

fn simulated(name: &str) -> Native {
    let mut scene = scene(name);
    let mut simulation = Simulation::new(&scene).unwrap();
    let mut states = vec![format!("{:016x}", simulation.state_hash())];
    for _ in 0..FRAMES {
        simulation.advance_frame().unwrap();
        states.push(format!("{:016x}", simulation.state_hash()));
    }
    let mut pictures = BTreeMap::new();
    for &(shader_name, shader) in Shader::NAMES {
        scene.materials_mut().for_each(|material| material.shader = shader);
        let renderer = Renderer::new(&scene, &TextureSource::BuiltIn).unwrap();
        let picture = renderer.draw(simulation.positions(), &Options::default());
        pictures.insert(shader_name, format!("{:016x}", picture.hash()));
    }
    Native { states, pictures }
}

/// What a script of this folder prints that runs the engine of the page in Node; nothing where that cannot be.
#[allow(clippy::print_stdout, reason = "a test that did not run must say so")]
fn in_node(script: &str, arguments: &[&str]) -> Option<Vec<u8>> {
    let page = built()?;
    let script = crate::repository::path(&format!("tests/cli/live/{script}"));
    let run = match Command::new("node").arg(script).arg(page).args(arguments).output() {
        Ok(run) => run,
        Err(error) => {
            assert!(std::env::var_os("DRAPE_REQUIRE_WEB").is_none(), "node: {error}");
            println!("skipped: no node on the PATH");
            return None;
        }
    };
    assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
    Some(run.stdout)
}

#[test]
fn node_computes_the_bits_of_the_native_program() {
    let Some(printed) = in_node("node.js", &SCENES) else { return };
    let found: Value = serde_json::from_slice(&printed).unwrap();
    for (name, native) in native() {
        let states: Vec<&str> =
            found[name]["states"].as_array().unwrap().iter().flat_map(Value::as_str).collect();
        assert_eq!(states, native.states, "{name}");
        let pictures = &found[name]["pictures"];
        assert_eq!(pictures.as_object().unwrap().len(), Shader::NAMES.len());
        for (shader, hash) in &native.pictures {
            assert_eq!(pictures[shader].as_str(), Some(hash.as_str()), "{name} with {shader}");
        }
    }
}

#[test]
fn node_computes_the_hashes_of_every_platform() {
    let file = crate::repository::path("tests/cli/everywhere.txt");
    let Some(printed) = in_node("everywhere.js", &[file.to_str().unwrap()]) else { return };
    let (printed, expected) = (String::from_utf8(printed).unwrap(), std::fs::read_to_string(file).unwrap());
    let differ: Vec<_> = printed.lines().zip(expected.lines()).filter(|(a, b)| a != b).collect();
    assert!(differ.is_empty() && printed == expected, "{differ:#?}");
}

#[test]
fn the_page_shows_the_bits_of_the_native_program() {
    let Some(mut tools) = opened("scene=sphere&frame=0&paused&size=320x250", 1400, false) else { return };
    for (name, native) in native() {
        go(&mut tools, &format!("scene={name}&frame=0&paused&size=320x250"));
        assert_eq!((tools.text("status"), tools.text("frame")), ("paused".to_owned(), "0".to_owned()));
        let states = tools.eval(&format!("({EVERY_FRAME})({FRAMES})"));
        assert_eq!(states, serde_json::json!(native.states), "{name}");
        for (shader, hash) in &native.pictures {
            go(&mut tools, &format!("scene={name}&frame={FRAMES}&paused&size=320x250&shader={shader}"));
            assert_eq!(&tools.text("picture-hash"), hash, "{name} with {shader}");
        }
    }
    // And what the hash is taken of is what is on the canvas.
    let shown = "(() => { const c = document.getElementById('view'); \
        const d = c.getContext('2d').getImageData(0, 0, c.width, c.height).data; let h = 0xcbf29ce484222325n; \
        d.forEach((b, i) => { if (i % 4 < 3) h = BigInt.asUintN(64, (h ^ BigInt(b)) * 0x100000001b3n); }); \
        return h.toString(16).padStart(16, '0'); })()";
    let hash = tools.text("picture-hash");
    assert_eq!(tools.eval(shown), hash);
    assert_eq!(tools.console, Vec::<String>::new());
}
