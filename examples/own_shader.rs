//! A shader of your own: a toon look on a cloth that has fallen on a ball.
//!
//! `cargo run --release --example own_shader -- toon.png` draws it. Two programs are all there is to a shader. One
//! that scene files should have goes into the engine instead: `src/shader/` has a pair of files for each, and
//! `src/scene/shader.rs` a row.

#![expect(clippy::print_stdout, reason = "the example shows a number")]

use drape::camera::Camera;
use drape::error::{Error, Kind, Result};
use drape::glsl::{dot, max, normalize};
use drape::mesh::{Attributes, Mesh};
use drape::output::png;
use drape::raster::{DrawCall, Framebuffer, Primitives, draw};
use drape::scene::{Needs, Overrides, Shader, load_stock};
use drape::simulation::Simulation;

drape::varyings! {
    /// What the fragment program gets: as many numbers as it reads, under the names of their meaning.
    struct Toon { v_position: vec3, v_normal: vec3 }
}

drape::fragment_program! {
    /// Lambert's law in three steps of brightness. Statements are those of GLSL; every number is that of
    /// several fragments side by side.
    struct ToonFragment { u_color: [f32; 3], u_light_pos: [f32; 3] }
    |Toon { v_position, v_normal }| {
        let l = normalize(u_light_pos - v_position);
        let brightness = max(0.0, dot(normalize(v_normal), l));
        let steps = (brightness * 2.9).floor() * 0.3 + 0.3;
        u_color * steps
    }
}

fn main() -> Result<()> {
    // The camera of the report's figures, which shows the whole cloth.
    let overrides = Overrides { patches: vec!["scenes/look/draped.json".into()], ..Overrides::default() };
    let scene = load_stock("scenes/sphere.json".as_ref(), &overrides)?.scene;
    let mut simulation = Simulation::new(&scene)?;
    for _ in 0..150 {
        simulation.advance_frame()?;
    }
    let needs = Needs::of(Shader::Phong);
    let cloth = scene.cloth.as_ref().map(|cloth| Mesh::cloth(cloth, simulation.positions(), needs));
    let Some(mesh) = cloth else { return Ok(()) };

    let camera = Camera::of(&scene)?;
    // The vertex program is a closure. The point masses are in world space already.
    let vertex_program = |a: &Attributes| {
        let v_position = a.in_position;
        let gl_position = drape::glsl::transform(&camera.view_projection, v_position, 1.0);
        (gl_position, Toon { v_position: v_position.into(), v_normal: a.in_normal.into() })
    };
    let fragment_program = ToonFragment { u_color: [0.9, 0.5, 0.2], u_light_pos: [2.0, 1.5, 1.0] };

    let triangles = Primitives::Triangles(&mesh.triangles);
    let count = mesh.positions.len();
    let call = DrawCall::new(triangles, count, |i| mesh.vertex(i), vertex_program, fragment_program);
    let mut framebuffer = Framebuffer::new(640, 500, 4);
    let stats = draw(&mut framebuffer, [0.25; 3], &[call], false);
    println!("{} of {} pixels show the cloth", stats.covered, 640 * 500);

    let Some(path) = std::env::args().nth(1) else { return Ok(()) };
    let file = png::encode(640, 500, &framebuffer.rgb(), png::Effort::Small)?;
    std::fs::write(&path, file).map_err(|error| Error::new(Kind::Io, format!("{path}: {error}")))
}
