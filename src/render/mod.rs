//! A scene and the cloth's positions in, a picture out.

mod options;
mod object;
mod programs;

pub use options::{Options, Shading};

use std::mem::take;

use crate::{
    cloth::Points,
    diagnostics::memory::{Memory, check_available},
    error::{Error, Kind, Result},
    math::StateHash,
    mesh::Mesh,
    raster::{self, DrawCall, Framebuffer, Stages, Stats},
    scene::{MAX_SAMPLES, Render, Scene, Vec3},
    texture_source::TextureSource,
};
use object::Object;
use options::round;
use programs::Programs;

/// A finished picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// Stored colours, three bytes a pixel, top row first.
    pub rgb: Vec<u8>,
    /// Window depth per pixel, 1 where nothing was drawn.
    pub depth: Vec<f32>,
    /// `object << 24 | (triangle + 1)` per pixel, 0 for the background; empty if not asked for.
    pub ids: Vec<u32>,
    /// What drawing it took.
    pub stats: Stats,
}

impl Picture {
    /// A hash over the bytes of its colours.
    pub fn hash(&self) -> u64 {
        let mut hash = StateHash::default();
        hash.write(&self.rgb);
        hash.finish()
    }
}

/// A scene with its textures, ready to be drawn at any positions of its cloth.
#[derive(Clone, Debug)]
pub struct Renderer {
    programs: Programs,
}

impl Renderer {
    /// Reads the textures that the scene's materials need, each once, and no others.
    ///
    /// # Errors
    /// A texture that is missing or cannot be decoded; more than [`MAX_SAMPLES`]; no memory for the picture.
    pub fn new(scene: &Scene, source: &TextureSource) -> Result<Self> {
        check_memory(scene)?;
        Ok(Self { programs: Programs::new(scene, source)? })
    }

    /// Draws `scene` from now on. Textures that were read already are kept, so `source` must have the same.
    ///
    /// # Errors
    /// As [`Renderer::new`]; then the scene is still the one before.
    pub fn change_scene(&mut self, scene: &Scene, source: &TextureSource) -> Result<()> {
        check_memory(scene)?;
        self.programs.change_scene(scene, source)
    }

    /// Finds what would be wrong with the picture of a valid scene, textures aside.
    ///
    /// # Errors
    /// A camera that stands in its target; more than [`MAX_SAMPLES`]; no memory for the picture.
    pub fn check(scene: &Scene) -> Result<()> {
        check_memory(scene)?;
        Programs::check(scene)
    }

    /// Takes the texels of all textures into `hash`.
    pub fn hash_textures(&self, hash: &mut StateHash) {
        self.programs.hash_textures(hash);
    }

    /// The names of the textures that have transparent pixels, which are drawn opaque.
    pub fn transparent_textures(&self) -> Vec<&str> {
        self.programs.transparent_textures()
    }

    /// A framebuffer of the scene's size and samples.
    pub fn framebuffer(&self) -> Framebuffer {
        let [width, height] = self.programs.scene.render.size;
        Framebuffer::new(width, height, self.programs.scene.render.samples)
    }

    /// The picture with the cloth at `points`.
    pub fn draw(&self, points: &Points, options: &Options) -> Picture {
        let mut framebuffer = self.framebuffer();
        let stats = self.draw_into(&mut framebuffer, points, options);
        let [width, height] = self.programs.scene.render.size;
        let (rgb, depth, ids) = (framebuffer.rgb(), framebuffer.depth(), framebuffer.ids());
        Picture { width, height, rgb, depth, ids, stats }
    }

    /// The distances along the view axis, in metres, of window depths of [`Renderer::draw`] with the same arguments;
    /// infinite where nothing was drawn.
    pub fn metres(&self, depth: &[f32], points: &Points, options: &Options) -> Vec<f32> {
        let camera = self.programs.camera(&self.objects(points, options, Mesh::default()));
        depth.iter().map(|&depth| camera.distance(depth)).collect()
    }

    /// Draws into a framebuffer made by [`Renderer::framebuffer`], which is cleared first.
    pub fn draw_into(&self, framebuffer: &mut Framebuffer, points: &Points, options: &Options) -> Stats {
        self.draw_with(framebuffer, points, options, |framebuffer, calls| {
            raster::draw(framebuffer, self.background(), calls, options.ids)
        })
    }

    /// Does what [`Renderer::draw_into`] does, and measures the time of each stage.
    pub fn draw_timed(
        &self,
        framebuffer: &mut Framebuffer,
        points: &Points,
        options: &Options,
    ) -> (Stats, Stages) {
        self.draw_with(framebuffer, points, options, |framebuffer, calls| {
            raster::draw_timed(framebuffer, self.background(), calls, options.ids)
        })
    }

    /// Hands the draw calls to `draw`.
    fn draw_with<R>(
        &self,
        framebuffer: &mut Framebuffer,
        points: &Points,
        options: &Options,
        draw: impl FnOnce(&mut Framebuffer, &[DrawCall<'_>]) -> R,
    ) -> R {
        let objects = self.objects(points, options, take(&mut framebuffer.mesh));
        let result = draw(framebuffer, &self.calls(&objects, options));
        framebuffer.mesh = cloth_mesh(objects);
        result
    }

    /// What is drawn, with the cloth at `points`, whose mesh takes the `memory` of another.
    fn objects(&self, points: &Points, options: &Options, memory: Mesh) -> Vec<Object<'_>> {
        let Programs { scene, origin, .. } = &self.programs;
        if *origin == Vec3::zeros() {
            return Object::all(scene, points, options.springs, memory);
        }
        let moved = |values: &[f64], by: f64| values.iter().map(|value| value - by).collect();
        let Points { x, y, z } = points;
        let points = Points { x: moved(x, origin.x), y: moved(y, origin.y), z: moved(z, origin.z) };
        Object::all(scene, &points, options.springs, memory)
    }

    fn calls<'a>(&'a self, objects: &'a [Object<'a>], options: &Options) -> Vec<DrawCall<'a>> {
        let camera = self.programs.camera(objects);
        objects.iter().map(|object| self.programs.draw_call(object, &camera, options.shading)).collect()
    }

    fn background(&self) -> [f32; 3] {
        round(self.programs.scene.render.background)
    }
}

/// The mesh of the cloth, or of what comes first: memory for the next.
fn cloth_mesh(objects: Vec<Object<'_>>) -> Mesh {
    objects.into_iter().next().map(|object| object.mesh).unwrap_or_default()
}

/// Checks that there is memory for the picture of `scene`, which may not come from a file.
fn check_memory(scene: &Scene) -> Result<()> {
    let Render { size: [width, height], samples, .. } = scene.render;
    if scene.render.sample_count() > MAX_SAMPLES {
        let message = format!("{width} x {height} pixels of {samples} samples are too many");
        let help = format!("pixels times samples may be at most {MAX_SAMPLES}");
        return Err(Error::new(Kind::Scene, message).with_help(help));
    }
    check_available(Memory::of(scene).picture, "the picture")
}
