//! The rasteriser and the shaders agree with OpenGL.
mod gl;
use drape::cloth::Points;
use drape::render::{Options, Renderer};
use drape::scene::{Overrides, Scene, load};
use drape::simulation::Simulation;
use drape::texture_source::TextureSource;
use gl::context::Context;
use gl::device::Device;
use std::path::Path;

fn scene(name: &str, sets: &[String]) -> Scene {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes").join(format!("{name}.json"));
    load(&path, &Overrides { patches: vec![], sets: sets.to_vec() }).unwrap().scene
}

#[test]
fn first() {
    let context = Context::open().unwrap();
    println!("{}", context.driver());
    let mut device = Device::new(&context);
    for name in ["sphere", "plane", "pinned2", "pinned4", "selfCollision"] {
        let base = scene(name, &[]);
        let mut sim = Simulation::new(&base).unwrap();
        let mut states: Vec<Points> = vec![sim.positions().clone()];
        for _ in 0..2 {
            for _ in 0..90 { sim.advance_frame().unwrap(); }
            states.push(sim.positions().clone());
        }
        for (t, points) in states.iter().enumerate() {
            for shader in ["normal", "wireframe", "diffuse", "phong", "texture", "bump", "displacement", "mirror", "custom"] {
                let s = scene(name, &[format!("material.shader={shader}")]);
                let started = std::time::Instant::now();
                let gl = device.draw(&s, points);
                let t_gl = started.elapsed();
                let r = Renderer::new(&s, &TextureSource::BuiltIn).unwrap();
                let started = std::time::Instant::now();
                let own = r.draw(points, &Options { ids: true, springs: None });
                let t_own = started.elapsed();
                let covered = own.ids.iter().zip(&gl.ids).filter(|(a, b)| **a != 0 || **b != 0).count();
                let wrong = own.ids.iter().zip(&gl.ids).filter(|(a, b)| a != b).count();
                let mut h = [0; 3];
                for (i, (a, b)) in own.rgb.chunks(3).zip(gl.rgb.chunks(3)).enumerate() {
                    if own.ids[i] == gl.ids[i] && own.ids[i] != 0 {
                        let d = a.iter().zip(b).map(|(a, b)| a.abs_diff(*b)).max().unwrap();
                        h[usize::from(d.min(2))] += 1;
                    }
                }
                println!("{name:14} {t} {shader:12} {covered:7} wrong {wrong:5} {h:?} gl {t_gl:?} own {t_own:?}");
                for i in (0..own.ids.len()).filter(|&i| own.ids[i] != gl.ids[i]).take(4) {
                    println!("   at {} {}: own {:x} {:.9} gl {:x} {:.9} ({})", i % 1024, i / 1024, own.ids[i], own.depth[i], gl.ids[i], gl.depth[i],
                    (own.depth[i].to_bits() as i64) - gl.depth[i].to_bits() as i64);
                }
            }
        }
    }
}
