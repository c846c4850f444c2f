//! A scene and the cloth's positions in, a picture out.

mod object;

use crate::{
    camera::Camera,
    cloth::Points,
    cubemap::Cubemap,
    error::{Error, Kind, Result},
    lanes::Wide,
    math::StateHash,
    mesh::SpringKinds,
    raster::{self, Framebuffer, Stages, Stats},
    scene::{Images, Scene},
    texture::Texture,
    texture_source::TextureSource,
};
use object::{Object, round};

/// Most samples of a picture: 16384 x 16384 pixels of one sample, which take 3 GiB.
pub const MAX_SAMPLES: u64 = 1 << 28;

/// What is asked of a picture besides the scene.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Options {
    /// Spring kinds that a wireframe shows; absent: those that the cloth has.
    pub springs: Option<SpringKinds>,
    /// Keep object and triangle ids.
    pub ids: bool,
    /// The arithmetic of the fragment stage.
    pub shading: Shading,
}

/// The arithmetic in which fragment programs run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Shading {
    /// binary32, as on a graphics card.
    #[default]
    F32,
    /// binary64, for measuring what binary32 loses: the same programs, uniforms and vertices.
    F64,
}

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

/// A scene with its textures, ready to be drawn at any positions of its cloth.
#[derive(Clone, Debug)]
pub struct Renderer {
    scene: Scene,
    camera: Camera,
    textures: Vec<(String, Texture)>,
    cubemaps: Vec<(String, Cubemap)>,
}

impl Renderer {
    /// Reads the textures that the scene's materials need, each once, and no others.
    ///
    /// # Errors
    /// A texture that is missing or cannot be decoded; more than [`MAX_SAMPLES`].
    pub fn new(scene: &Scene, source: &TextureSource) -> Result<Self> {
        let [width, height] = scene.render.size.map(u64::from);
        let samples = width * height * u64::from(scene.render.samples);
        if samples > MAX_SAMPLES {
            let message =
                format!("{width} x {height} pixels of {} samples are too many", scene.render.samples);
            let help = format!("pixels times samples may be at most {MAX_SAMPLES}");
            return Err(Error::new(Kind::Scene, message).with_help(help));
        }
        let images = Images::of(scene);
        let texture = |name: String| Ok((name.clone(), source.texture(&name)?));
        let cubemap = |name: String| Ok((name.clone(), source.cubemap(&name)?));
        Ok(Self {
            scene: scene.clone(),
            camera: Camera::of(scene)?,
            textures: images.textures.into_iter().map(texture).collect::<Result<_>>()?,
            cubemaps: images.environments.into_iter().map(cubemap).collect::<Result<_>>()?,
        })
    }

    /// Takes the texels of all textures into `hash`.
    pub fn hash_textures(&self, hash: &mut StateHash) {
        let faces = self.cubemaps.iter().flat_map(|(_, cubemap)| cubemap.faces());
        for texture in self.textures.iter().map(|(_, texture)| texture).chain(faces) {
            hash.write(&(texture.width() as u64).to_le_bytes());
            texture.texels().iter().flatten().for_each(|value| hash.write(&value.to_le_bytes()));
        }
    }

    /// A framebuffer of the scene's size and samples.
    pub fn framebuffer(&self) -> Framebuffer {
        let [width, height] = self.scene.render.size;
        Framebuffer::new(width, height, self.scene.render.samples)
    }

    /// The picture with the cloth at `points`.
    pub fn draw(&self, points: &Points, options: &Options) -> Picture {
        let mut framebuffer = self.framebuffer();
        let (stats, _) = self.draw_into(&mut framebuffer, points, options);
        let [width, height] = self.scene.render.size;
        let (rgb, depth, ids) = (framebuffer.rgb(), framebuffer.depth(), framebuffer.ids());
        Picture { width, height, rgb, depth, ids, stats }
    }

    /// Draws into a framebuffer made by [`Renderer::framebuffer`], which is cleared first.
    pub fn draw_into(
        &self,
        framebuffer: &mut Framebuffer,
        points: &Points,
        options: &Options,
    ) -> (Stats, Stages) {
        let objects = Object::all(&self.scene, points, options.springs);
        let call = |object| match options.shading {
            Shading::F32 => self.draw_call::<Wide<f32>>(object),
            Shading::F64 => self.draw_call::<Wide<f64>>(object),
        };
        let calls: Vec<_> = objects.iter().map(call).collect();
        raster::draw(framebuffer, round(self.scene.render.background), &calls, options.ids)
    }
}
