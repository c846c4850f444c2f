//! Speed against accuracy of drawing: samples × filter × sphere resolution × arithmetic.
//!
//! Pictures are held against a converged one: four times as wide and high with 16 samples a pixel,
//! so 256 samples and 16 runs of the fragment programs for each pixel, textures filtered bilinearly,
//! spheres of 512 × 512, fragment programs in binary64. How far it is from the picture of half its
//! width and height, with 64 samples, is the floor.

use std::time::Instant;

use serde::{Deserialize, Serialize};

use super::matrix::Extent;
use super::reference::key;
use super::runs::median;
use super::store::Store;
use drape::cloth::Points;
use drape::error::Result;
use drape::math::StateHash;
use drape::output::compare::Difference;
use drape::output::png::Pixels;
use drape::render::{Options, Renderer, Shading};
use drape::scene::{Collider, Filter, Images, Scene, Shader};
use drape::simulation::Simulation;
use drape::texture_source::TextureSource;

/// Latitude and longitude counts of the converged spheres.
const FINE_SPHERE: u32 = 512;

/// How much wider and higher than the pictures the converged one is drawn.
const FINE: u32 = 4;

/// One way to draw.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Way {
    /// Samples per pixel.
    pub samples: u32,
    /// Whether textures are filtered bilinearly; absent where none is read.
    pub bilinear: Option<bool>,
    /// Latitude and longitude count of the spheres; absent where there are none.
    pub resolution: Option<u32>,
    /// Whether the fragment programs run in binary64.
    pub double: bool,
}

impl Way {
    /// The way in words.
    pub fn text(&self) -> String {
        let mut text = format!("{} sample{}", self.samples, if self.samples == 1 { "" } else { "s" });
        if let Some(bilinear) = self.bilinear {
            text += if bilinear { ", bilinear" } else { ", nearest" };
        }
        if let Some(resolution) = self.resolution {
            text += &format!(", spheres {resolution} × {resolution}");
        }
        text + if self.double { ", f64" } else { ", f32" }
    }

    /// The scene drawn in this way.
    fn scene(&self, scene: &Scene) -> Scene {
        let mut scene = scene.clone();
        scene.render.samples = self.samples;
        if let Some(bilinear) = self.bilinear {
            scene.render.filter = if bilinear { Filter::Bilinear } else { Filter::Nearest };
        }
        for collider in &mut scene.colliders {
            if let (Collider::Sphere(sphere), Some(n)) = (collider, self.resolution) {
                sphere.resolution = [n, n];
            }
        }
        scene
    }

    fn options(&self) -> Options {
        let shading = if self.double { Shading::F64 } else { Shading::F32 };
        Options { shading, ..Options::default() }
    }
}

/// What was measured of one way to draw.
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

/// The scene at its moment, and what it is drawn against.
pub struct Pictures {
    scene: Scene,
    textures: TextureSource,
    points: Points,
    /// The converged picture.
    pub converged: Pixels,
    /// A hash of it, which changes with whatever a picture shows: the textures too.
    shown: u64,
    /// Root of the mean squared difference of the converged picture from one of half its size.
    pub floor: f64,
    /// The ways, measured.
    pub drawn: Vec<Drawn>,
}

/// Draws `scene` in every way that it can tell apart; nothing for a wireframe, whose lines are one
/// pixel wide and so have no limit, or if the cloth does not reach the scene's time.
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
    let (textures, shown) = (textures.clone(), hash.finish());
    let mut pictures = Pictures { scene, textures, points, converged, shown, floor, drawn: Vec::new() };
    // A picture takes so little time that it can be drawn often.
    for round in 0..4 * extent.repeats {
        for (number, way) in ways(&pictures.scene, extent).into_iter().enumerate() {
            watch(0)?;
            pictures.measure_way(number, way, round, store)?;
        }
    }
    Ok(Some(pictures))
}

fn has_lines(scene: &Scene) -> bool {
    scene.materials().any(|material| material.shader == Shader::Wireframe)
}

/// The cloth at the frame of the picture, the nearest to the scene's time, if it gets there.
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

/// Every way that makes a difference for `scene`.
fn ways(scene: &Scene, extent: &Extent) -> Vec<Way> {
    let reads = !Images::of(scene).is_empty();
    let filters = if reads { vec![Some(false), Some(true)] } else { vec![None] };
    let resolutions = if scene.spheres().next().is_none() {
        vec![None]
    } else {
        extent.resolutions.iter().copied().map(Some).collect()
    };
    let mut ways = Vec::new();
    for &bilinear in &filters {
        for &resolution in &resolutions {
            for double in [false, true] {
                let way = |samples| Way { samples, bilinear, resolution, double };
                ways.extend([1, 4, 8, 16].map(way));
            }
        }
    }
    ways
}

/// The picture with `times` the width and height and 16 samples, box-filtered to the scene's size.
fn finer(scene: &Scene, textures: &TextureSource, points: &Points, times: u32) -> Result<Pixels> {
    let [width, height] = scene.render.size;
    let best = Way { samples: 16, bilinear: Some(true), resolution: Some(FINE_SPHERE), double: true };
    let mut fine = best.scene(scene);
    fine.render.size = [width * times, height * times];
    let picture = Renderer::new(&fine, textures)?.draw(points, &best.options());
    let [wide, times_] = [picture.width as usize, times as usize];
    let mean = |pixel: usize, channel: usize| {
        let (left, top) = (pixel % width as usize * times_, pixel / width as usize * times_);
        let rows = (top..top + times_).flat_map(|y| (left..left + times_).map(move |x| y * wide + x));
        let sum: u32 = rows.map(|i| u32::from(picture.rgb[3 * i + channel])).sum();
        u8::try_from((sum + times * times / 2) / (times * times)).unwrap_or(u8::MAX)
    };
    let rgba = (0..width as usize * height as usize).map(|i| [mean(i, 0), mean(i, 1), mean(i, 2), 255]);
    Ok(Pixels { width, height, rgba: rgba.collect() })
}

impl Pictures {
    /// The scene's picture size.
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

    /// How many pixels differ between fragment programs in binary32 and in binary64, most of all pairs of
    /// ways that differ in nothing else, and by how many levels of 255 at most.
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

    /// Makes repetition `round` of way `number`, unless it is kept.
    fn measure_way(&mut self, number: usize, way: Way, round: usize, store: &Store) -> Result<()> {
        let key = key("picture", &(&self.scene, self.shown, way));
        if round == 0
            && let Some(kept) = store.get::<Drawn>(key)
        {
            kept.times.iter().for_each(|_| store.note_found());
            self.drawn.push(kept);
            return Ok(());
        }
        if self.drawn.get(number).is_some_and(|drawn| drawn.times.len() > round) {
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

    /// What does not depend on the machine.
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

    /// How long a picture takes after one to warm up, in milliseconds.
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
