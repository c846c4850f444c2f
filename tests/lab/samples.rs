//! What more samples a pixel are worth: the table of `docs/choose.md`.

use super::repository;
use drape::render::{Options, Renderer};
use drape::scene::{Overrides, Scene, load};
use drape::simulation::Simulation;
use drape::texture_source::TextureSource;

/// Pictures: a scene and its shader.
const PICTURES: [(&str, &str); 7] = [
    ("sphere", "phong"),
    ("plane", "normal"),
    ("pinned2", "bump"),
    ("sphere", "texture"),
    ("pinned2", "texture"),
    ("sphere", "mirror"),
    ("table", "texture"),
];

/// Numbers of samples.
const SAMPLES: [u32; 4] = [1, 4, 8, 16];

/// The width and height of the pictures.
const SIZE: [usize; 2] = [256, 200];

/// A picture is compared with one of so many times the samples: as many pixels again in each direction, averaged.
const FINER: usize = 4;

fn scene(name: &str, sets: &[String]) -> Scene {
    let path = repository::path(&format!("scenes/{name}.json"));
    load(&path, &Overrides { sets: sets.to_vec(), ..Overrides::default() }).unwrap().scene
}

/// The RGB bytes of a picture that is `times` as wide and high as [`SIZE`].
fn draw(name: &str, shader: &str, samples: u32, times: usize, simulation: &Simulation) -> Vec<f64> {
    let size = SIZE.map(|side| side * times);
    let sets = [
        format!("cloth.material.shader={shader}"),
        format!("material.shader={shader}"),
        format!("render.samples={samples}"),
        format!("render.size={size:?}"),
    ];
    let renderer = Renderer::new(&scene(name, &sets), &TextureSource::BuiltIn).unwrap();
    let picture = renderer.draw(simulation.positions(), &Options::default());
    picture.rgb.iter().map(|&byte| f64::from(byte)).collect()
}

/// The mean of each square of [`FINER`] × [`FINER`] pixels.
fn averaged(large: &[f64]) -> Vec<f64> {
    let [width, height] = SIZE;
    let of = |i: usize| {
        let (x, y, channel) = (i / 3 % width, i / 3 / width, i % 3);
        let pixels = (0..FINER * FINER).map(|k| (x * FINER + k % FINER, y * FINER + k / FINER));
        let sum: f64 = pixels.map(|(x, y)| large[(y * width * FINER + x) * 3 + channel]).sum();
        sum / (FINER * FINER) as f64
    };
    (0..3 * width * height).map(of).collect()
}

fn rms(a: &[f64], b: &[f64]) -> f64 {
    let sum: f64 = a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum();
    (sum / a.len() as f64).sqrt()
}

#[test]
fn the_table_of_samples_is_what_the_renderer_draws() {
    let page = std::fs::read_to_string(repository::path("docs/choose.md")).unwrap();
    let mut missing = Vec::new();
    for (name, shader) in PICTURES {
        let mut simulation = Simulation::new(&scene(name, &[])).unwrap();
        (0..60).for_each(|_| simulation.advance_frame().unwrap());
        let error = |samples: u32| {
            let [small, large] = [1, FINER].map(|times| draw(name, shader, samples, times, &simulation));
            rms(&small, &averaged(&large))
        };
        let [one, four, eight, sixteen] = SAMPLES.map(error);
        let row = format!("| {name}, {shader} | {one:.2} | {four:.2} | {eight:.2} | {sixteen:.2} |");
        if !page.lines().any(|line| line == row) {
            missing.push(row);
        }
    }
    assert!(missing.is_empty(), "docs/choose.md lacks\n{}", missing.join("\n"));
}
