//! Drawing, next to Mesa's software driver: the same vertices, uniforms and GLSL programs.
//!
//! Both sides clear and draw. Ours also makes the mesh from the cloth's positions, which the driver
//! is given beforehand.

#![expect(unsafe_code, reason = "OpenGL is a C interface")]

use drape::camera::Camera;
use drape::render::{Options, Renderer};
use drape::scene::Scene;
use drape::simulation::Simulation;
use drape::texture_source::TextureSource;
use glow::HasContext;

use super::gl::context::Context;
use super::gl::device::Device;
use super::gl::object::{objects, vec3};
use super::gl::samples::Sampled;
use super::gl::target::Target;
use super::{medians, scene};

/// The plane from so near that it fills the picture.
const FULL_SCREEN: [&str; 4] =
    ["camera.polar=0", "camera.target=[0,0,0]", "camera.distance=0.5", "render.size=[1920,1080]"];

/// A table of all pictures.
pub(super) fn table(rounds: usize) {
    let context = match Context::open() {
        Ok(context) => context,
        Err(why) if std::env::var_os("DRAPE_REQUIRE_GL").is_some() => panic!("no OpenGL: {why}"),
        Err(why) => return println!("no OpenGL 3.3 to compare with: {why}"),
    };
    let mut device = Device::new(&context);
    println!("| ms a picture | drape | {} | ratio |\n|---|--:|--:|--:|", context.driver());
    for shader in ["phong", "texture", "bump", "mirror", "custom"] {
        let set = format!("material.shader={shader}");
        row(&format!("sphere.json, {shader}"), &scene("sphere", &[&set]), &mut device, rounds);
    }
    row("sphere.json, phong, 4 samples", &scene("sphere", &["render.samples=4"]), &mut device, rounds);
    for points in [50, 256, 1024] {
        let sets = ["width", "height"].map(|side| format!("cloth.num_{side}_points={points}"));
        let scene = scene("pinned2", &[&sets[0], &sets[1], "cloth.pinned=[]"]);
        row(&format!("cloth of {points} x {points} points, phong"), &scene, &mut device, rounds);
    }
    for shader in ["phong", "texture", "bump", "mirror"] {
        let set = format!("material.shader={shader}");
        let mut scene = scene("plane", &[&FULL_SCREEN[..], &[&set]].concat());
        scene.cloth = None;
        row(&format!("full screen of 1920 x 1080, {shader}"), &scene, &mut device, rounds);
    }
}

/// One picture by both sides, at the scene's start.
fn row(name: &str, scene: &Scene, device: &mut Device<'_>, rounds: usize) {
    let start = Simulation::new(scene).unwrap();
    let points = start.positions();
    let renderer = Renderer::new(scene, &TextureSource::BuiltIn).unwrap();
    let mut framebuffer = renderer.framebuffer();
    let options = Options::default();
    let objects = objects(scene, points);
    objects.iter().for_each(|object| device.prepare(object));
    let target = Target::new(device.gl, scene.render.size);
    let sampled = (scene.render.samples > 1).then(|| Sampled::new(device.gl, scene.render.size));
    let camera = Camera::of(scene).unwrap();
    let uploaded: Vec<_> = objects.iter().map(|object| device.upload(object, true)).collect();
    let ours = || {
        renderer.draw_into(&mut framebuffer, points, &options);
    };
    let theirs = || {
        let background = vec3(scene.render.background);
        match &sampled {
            Some(sampled) => sampled.begin(background),
            None => target.begin_colors(background),
        }
        for (uploaded, object) in uploaded.iter().zip(&objects) {
            device.draw_uploaded(uploaded, object, 0, scene, &camera);
        }
        sampled.iter().for_each(Sampled::resolve);
        // SAFETY: the context is current on this thread.
        unsafe { device.gl.finish() };
    };
    let [ours, theirs] = medians(rounds, ours, theirs).map(|time| time.as_secs_f64() * 1e3);
    println!("| {name} | {ours:.2} | {theirs:.2} | {:.1} |", theirs / ours);
}
