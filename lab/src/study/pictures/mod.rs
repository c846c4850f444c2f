//! Speed against accuracy of drawing.
//!
//! Pictures are compared with a converged one. It is drawn four times as wide and high with 16 samples a
//! pixel, which makes 256 samples and 16 runs of the fragment program for each pixel, with bilinear filter,
//! spheres of 512 × 512 and fragment programs in binary64. Its difference from the same with twice the
//! width and height, which makes 64 samples, is the floor.

mod way;
mod finer;

pub use way::Way;

use std::time::Instant;

use serde::{Deserialize, Serialize};

use self::finer::finer;
use self::way::ways;
use super::extent::Extent;
use super::runs::median;
use crate::store::{Store, key};
use drape::cloth::Points;
use drape::error::Result;
use drape::math::StateHash;
use drape::output::compare::Difference;
use drape::output::png::Pixels;
use drape::render::Renderer;
use drape::scene::{Scene, Shader};
use drape::simulation::Simulation;
use drape::texture_source::TextureSource;

/// How much wider and higher than the pictures the converged one is drawn.
const FINE: u32 = 4;

/// The measurements of one way to draw.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Drawn {
    /// The way.
    pub way: Way,
    /// Root of the mean squared channel difference, in levels of 255.
    pub rmse: f64,
    /// Largest channel difference, in levels of 255.
    pub max: usize,
    /// Pixels off by more than one level of 255.
    pub off: u64,
    /// Runs of a fragment program: the same on every machine.
    pub fragments: u64,
    /// Runs of a vertex program.
    pub vertices: u64,
    /// Wall time of each repetition, in milliseconds.
    pub times: Vec<f64>,
}

impl Drawn {
    /// The median wall time, in milliseconds.
    pub fn ms(&self) -> f64 {
        median(&self.times)
    }
}

/// The scene at its moment, and its pictures.
pub struct Pictures {
    scene: Scene,
    textures: TextureSource,
    points: Points,
    /// The converged picture.
    pub converged: Pixels,
    /// A hash of the converged picture, which changes with all that a picture shows, textures included.
    hash: u64,
    /// Root of the mean squared difference of the converged picture from the one with 64 samples, in levels of
    /// 255.
    pub floor: f64,
    /// The ways, measured.
    pub drawn: Vec<Drawn>,
}

/// Draws `scene` in every way that makes a difference; `None` for a wireframe, which has no converged picture
/// because its lines are one pixel wide at every size, or if the cloth does not reach the scene's time.
///
/// # Errors
/// Those of the renderer, the store and `watch`, which is called between pictures.
pub fn measure(
    scene: &Scene,
    textures: &TextureSource,
    extent: &Extent,
    store: &Store,
    watch: &(dyn Fn(u32) -> Result<()> + Sync),
) -> Result<Option<Pictures>> {
    let mut scene = scene.clone();
    let [width, height] = scene.render.size;
    let wide = width.min(extent.picture_width);
    scene.render.size = [wide, (height * wide / width).max(1)];
    if has_lines(&scene) {
        return Ok(None);
    }
    let Some(points) = moved(&scene, watch)? else { return Ok(None) };
    let converged = finer(&scene, textures, &points, FINE)?;
    let coarser = finer(&scene, textures, &points, FINE / 2)?;
    let floor = Difference::between(&converged, &coarser).rmse;
    let mut hash = StateHash::default();
    hash.write(converged.rgba.as_flattened());
    let (textures, hash) = (textures.clone(), hash.finish());
    let mut pictures = Pictures { scene, textures, points, converged, hash, floor, drawn: Vec::new() };
    // A picture takes so little time that it can be drawn often.
    for repetition in 0..4 * extent.repeats {
        for (number, way) in ways(&pictures.scene, extent).into_iter().enumerate() {
            watch(0)?;
            pictures.measure_way(number, way, repetition, store)?;
        }
    }
    Ok(Some(pictures))
}

fn has_lines(scene: &Scene) -> bool {
    scene.materials().any(|material| material.shader == Shader::Wireframe)
}

/// The cloth at the frame nearest to the scene's time; `None` if it becomes unstable before.
fn moved(scene: &Scene, watch: &dyn Fn(u32) -> Result<()>) -> Result<Option<Points>> {
    let mut simulation = Simulation::new(scene)?;
    let frames = (scene.render.time * scene.sim.fps).round();
    while (simulation.frame() as f64) < frames {
        watch(0)?;
        if simulation.advance_frame().is_err() {
            return Ok(None);
        }
    }
    Ok(Some(simulation.positions().clone()))
}

impl Pictures {
    /// Milliseconds and root of the mean squared difference of each way.
    pub fn points(&self) -> Vec<[f64; 2]> {
        self.drawn.iter().map(|drawn| [drawn.ms(), drawn.rmse]).collect()
    }

    /// Width and height of the pictures.
    pub fn size(&self) -> [u32; 2] {
        self.scene.render.size
    }

    /// The picture drawn in a way.
    ///
    /// # Errors
    /// Those of the renderer.
    pub fn draw(&self, way: &Way) -> Result<Pixels> {
        let scene = way.scene(&self.scene);
        let picture = Renderer::new(&scene, &self.textures)?.draw(&self.points, &way.options());
        let rgba = picture.rgb.chunks_exact(3).map(|c| [c[0], c[1], c[2], 255]).collect();
        Ok(Pixels { width: picture.width, height: picture.height, rgba })
    }

    /// The most pixels that differ between fragment programs in binary32 and in binary64, over all pairs of ways
    /// that differ in nothing else, and the largest difference in levels of 255.
    ///
    /// # Errors
    /// Those of the renderer.
    pub fn rounding(&self) -> Result<(u64, usize)> {
        let mut most = (0, 0);
        for way in self.drawn.iter().map(|drawn| drawn.way).filter(|way| !way.double) {
            let difference =
                Difference::between(&self.draw(&way)?, &self.draw(&Way { double: true, ..way })?);
            most = (most.0.max(difference.differing()), most.1.max(difference.max()));
        }
        Ok(most)
    }

    /// Makes repetition number `repetition` of way `number`, unless it is stored.
    fn measure_way(&mut self, number: usize, way: Way, repetition: usize, store: &Store) -> Result<()> {
        let key = key("picture", &(&self.scene, self.hash, way));
        if repetition == 0
            && let Some(kept) = store.get::<Drawn>(key)
        {
            kept.times.iter().for_each(|_| store.count_found());
            self.drawn.push(kept);
            return Ok(());
        }
        if self.drawn.get(number).is_some_and(|drawn| drawn.times.len() > repetition) {
            return Ok(());
        }
        if self.drawn.len() <= number {
            self.drawn.push(self.first(way)?);
        }
        let time = self.time(&way)?;
        if let Some(drawn) = self.drawn.get_mut(number) {
            drawn.times.push(time);
            store.put(key, drawn)?;
        }
        Ok(())
    }

    /// All measurements but the times.
    fn first(&self, way: Way) -> Result<Drawn> {
        let picture = self.draw(&way)?;
        let scene = way.scene(&self.scene);
        let stats = Renderer::new(&scene, &self.textures)?.draw(&self.points, &way.options()).stats;
        let difference = Difference::between(&self.converged, &picture);
        Ok(Drawn {
            way,
            rmse: difference.rmse,
            max: difference.max(),
            off: difference.histogram().filter(|&(magnitude, _)| magnitude > 1).map(|(_, count)| count).sum(),
            fragments: stats.fragments,
            vertices: stats.vertices,
            times: Vec::new(),
        })
    }

    /// The time to draw a picture, in milliseconds, after one to warm up.
    fn time(&self, way: &Way) -> Result<f64> {
        let scene = way.scene(&self.scene);
        let renderer = Renderer::new(&scene, &self.textures)?;
        let mut framebuffer = renderer.framebuffer();
        renderer.draw_into(&mut framebuffer, &self.points, &way.options());
        let started = Instant::now();
        renderer.draw_into(&mut framebuffer, &self.points, &way.options());
        Ok(started.elapsed().as_secs_f64() * 1e3)
    }
}
