//! The arguments for how a scene is drawn.

use std::path::PathBuf;

use clap::builder::PossibleValuesParser;
use clap::builder::TypedValueParser;

use crate::session::ui::Ui;
use drape::cubemap::FACES;
use drape::mesh::SpringKinds;
use drape::render::Options;
use drape::scene::{Collider, Images, MAX_RESOLUTION, Scene, Shader};
use drape::texture_source::{ENDINGS, TextureSource};

/// Changes to how a scene is drawn.
#[derive(clap::Args)]
pub(crate) struct RenderArgs {
    /// Draw every object with this shader
    #[arg(long, value_name = "NAME", value_parser = shader())]
    shader: Option<Shader>,
    /// Width and height of the picture in pixels, each 1 to 16384 (default: the scene's render.size)
    #[arg(long, value_name = "WxH", value_parser = size)]
    size: Option<[u32; 2]>,
    /// Samples per pixel: 1, 4, 8 or 16 (default: the scene's render.samples)
    #[arg(long, value_name = "N", value_parser = samples)]
    samples: Option<u32>,
    /// Latitude count of the mesh of each sphere, 2 to 1000
    #[arg(short = 'a', value_name = "N", value_parser = clap::value_parser!(u32).range(2..=i64::from(MAX_RESOLUTION)))]
    latitudes: Option<u32>,
    /// Longitude count of the mesh of each sphere, 3 to 1000
    #[arg(short = 'o', value_name = "N", value_parser = clap::value_parser!(u32).range(3..=i64::from(MAX_RESOLUTION)))]
    longitudes: Option<u32>,
    /// Springs that the wireframe shader draws: structural, shearing, bending, separated by commas (default: those
    /// that the cloth has)
    #[arg(long, value_name = "KINDS", value_parser = springs)]
    springs: Option<SpringKinds>,
    /// Read all textures from this folder (texture_1.png, ..., cube/posx.png, ...) instead of the built-in set
    #[arg(long, value_name = "DIR")]
    textures: Option<PathBuf>,
}

/// Warns of `pictures` that show only the background.
pub(crate) fn warn_of_nothing_visible(pictures: &str, ui: &Ui) {
    ui.caution(
        &format!("no object is visible in {pictures}"),
        "check camera.target, camera.distance, camera.near and camera.far, and the time of the picture",
    );
}

impl RenderArgs {
    /// Writes the changes into `scene`.
    pub(crate) fn apply(&self, scene: &mut Scene) {
        scene.render.size = self.size.unwrap_or(scene.render.size);
        scene.render.samples = self.samples.unwrap_or(scene.render.samples);
        for collider in &mut scene.colliders {
            if let Collider::Sphere(sphere) = collider {
                let [latitudes, longitudes] = sphere.resolution;
                sphere.resolution =
                    [self.latitudes.unwrap_or(latitudes), self.longitudes.unwrap_or(longitudes)];
            }
        }
        if let Some(shader) = self.shader {
            scene.materials_mut().for_each(|material| material.shader = shader);
        }
    }

    /// Where textures are read from.
    pub(crate) fn textures(&self) -> TextureSource {
        self.textures.clone().map_or(TextureSource::BuiltIn, TextureSource::Folder)
    }

    /// Every file of the folder of textures that may be read for `scene`.
    pub(crate) fn inputs(&self, scene: &Scene) -> Vec<PathBuf> {
        let images = Images::of(scene);
        let faces = images.environments.iter().flat_map(|cube| FACES.map(|face| format!("{cube}/{face}")));
        let names: Vec<String> = images.textures.iter().cloned().chain(faces).collect();
        let file = |folder: &PathBuf, name: &str, ending| folder.join(format!("{name}.{ending}"));
        let folders = self.textures.iter();
        let files = folders.flat_map(|folder| {
            names.iter().flat_map(move |name| ENDINGS.map(|ending| file(folder, name, ending)))
        });
        files.filter(|path| path.is_file()).collect()
    }

    /// The options of the renderer that are not in the scene.
    pub(crate) fn options(&self, ids: bool) -> Options {
        Options { springs: self.springs, ids, ..Options::default() }
    }
}

fn shader() -> impl TypedValueParser<Value = Shader> {
    PossibleValuesParser::new(Shader::NAMES.iter().map(|(name, _)| *name)).try_map(|name| {
        let found = Shader::NAMES.iter().find(|(other, _)| *other == name);
        found.map(|(_, shader)| *shader).ok_or("there is no such shader")
    })
}

/// Parses a width and a height, each 1 to 16384 pixels.
pub(crate) fn size(text: &str) -> Result<[u32; 2], String> {
    let side = |digits: &str| digits.parse().ok().filter(|pixels| (1..=16_384).contains(pixels));
    let read = || {
        let (width, height) = text.split_once('x')?;
        Some([side(width)?, side(height)?])
    };
    read().ok_or_else(|| "expected WxH, such as 1024x800, each from 1 to 16384".to_owned())
}

fn samples(text: &str) -> Result<u32, String> {
    let count = text.parse().ok().filter(|count| [1, 4, 8, 16].contains(count));
    count.ok_or_else(|| "expected 1, 4, 8 or 16".to_owned())
}

fn springs(text: &str) -> Result<SpringKinds, String> {
    let mut kinds = SpringKinds { structural: false, shearing: false, bending: false };
    for name in text.split(',') {
        match name {
            "structural" => kinds.structural = true,
            "shearing" => kinds.shearing = true,
            "bending" => kinds.bending = true,
            _ => return Err(format!("`{name}` is not structural, shearing or bending")),
        }
    }
    Ok(kinds)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_and_samples_have_bounds() {
        assert_eq!(size("1024x800"), Ok([1024, 800]));
        assert_eq!(size("1x16384"), Ok([1, 16384]));
        for text in ["", "x", "0x1", "1x0", "16385x1", "1024", "-1x1", "1x1x1", "1 x 1", "99999999999x1"] {
            assert!(size(text).is_err(), "{text}");
        }
        for text in ["0", "2", "3", "32", "-4", "4.0"] {
            assert!(samples(text).is_err(), "{text}");
        }
        assert_eq!(samples("16"), Ok(16));
    }

    #[test]
    fn spring_kinds_are_a_list() {
        assert_eq!(springs("bending"), Ok(SpringKinds { structural: false, shearing: false, bending: true }));
        assert_eq!(
            springs("shearing,structural"),
            Ok(SpringKinds { structural: true, shearing: true, bending: false })
        );
        assert!(springs("").is_err() && springs("structural,").is_err() && springs("all").is_err());
    }
}
