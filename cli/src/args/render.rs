//! What a picture looks like, as given on the command line.

use std::path::PathBuf;

use clap::builder::PossibleValuesParser;
use clap::builder::TypedValueParser;

use drape::cubemap::FACES;
use drape::mesh::SpringKinds;
use drape::render::Options;
use drape::scene::{Collider, MAX_RESOLUTION, Plan, Scene, Shader};
use drape::texture_source::{ENDINGS, TextureSource};

/// Changes to how a scene is drawn.
#[derive(clap::Args)]
pub(crate) struct Look {
    /// Draw every object with this shader
    #[arg(long, value_name = "NAME", value_parser = shader())]
    shader: Option<Shader>,
    /// Width and height in pixels, 1 to 16384
    #[arg(long, value_name = "WxH", value_parser = size)]
    size: Option<[u32; 2]>,
    /// Samples per pixel: 1, 4, 8 or 16
    #[arg(long, value_name = "N", value_parser = samples)]
    samples: Option<u32>,
    /// Latitude count of the drawn spheres, 2 to 1000
    #[arg(short = 'a', value_name = "N", value_parser = clap::value_parser!(u32).range(2..=i64::from(MAX_RESOLUTION)))]
    latitudes: Option<u32>,
    /// Longitude count of the drawn spheres, 3 to 1000
    #[arg(short = 'o', value_name = "N", value_parser = clap::value_parser!(u32).range(3..=i64::from(MAX_RESOLUTION)))]
    longitudes: Option<u32>,
    /// Springs that a wireframe shows, separated by commas (default: those of the cloth)
    #[arg(long, value_name = "KINDS", value_parser = springs)]
    springs: Option<SpringKinds>,
    /// Take all textures from this folder (texture_1.png .. and cube/posx.png ..); it replaces the built-in set
    #[arg(long, value_name = "DIR")]
    textures: Option<PathBuf>,
}

/// What is told where `pictures` show the background alone.
pub(crate) fn nothing_seen(pictures: &str) -> String {
    format!(
        "warning: nothing is seen in {pictures}: no object is where the camera looks\n  \
         = help: look at camera.target, camera.distance, camera.near and camera.far, and at the moment, --time"
    )
}

impl Look {
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

    /// Where textures come from.
    pub(crate) fn textures(&self) -> TextureSource {
        self.textures.clone().map_or(TextureSource::BuiltIn, TextureSource::Folder)
    }

    /// Every file of the folder that may be read as a texture of `scene`.
    pub(crate) fn inputs(&self, scene: &Scene) -> Vec<PathBuf> {
        let plan = Plan::of(scene);
        let faces = plan.environments.iter().flat_map(|cube| FACES.map(|face| format!("{cube}/{face}")));
        let names: Vec<String> = plan.textures.iter().cloned().chain(faces).collect();
        let file = |folder: &PathBuf, name: &str, ending| folder.join(format!("{name}.{ending}"));
        let folders = self.textures.iter();
        let files = folders.flat_map(|folder| {
            names.iter().flat_map(move |name| ENDINGS.map(|ending| file(folder, name, ending)))
        });
        files.filter(|path| path.is_file()).collect()
    }

    /// What is asked of the picture besides the scene.
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

/// Reads a width and a height, each 1 to 16384 pixels.
pub(crate) fn size(text: &str) -> Result<[u32; 2], String> {
    let side = |digits: &str| digits.parse().ok().filter(|pixels| (1..=16_384).contains(pixels));
    let read = || {
        let (width, height) = text.split_once('x')?;
        Some([side(width)?, side(height)?])
    };
    read().ok_or_else(|| "a size is WxH such as 1024x800, each 1 to 16384".to_owned())
}

fn samples(text: &str) -> Result<u32, String> {
    let count = text.parse().ok().filter(|count| [1, 4, 8, 16].contains(count));
    count.ok_or_else(|| "allowed are 1, 4, 8 and 16".to_owned())
}

fn springs(text: &str) -> Result<SpringKinds, String> {
    let mut kinds = SpringKinds { structural: false, shearing: false, bending: false };
    for name in text.split(',') {
        match name {
            "structural" => kinds.structural = true,
            "shearing" => kinds.shearing = true,
            "bending" => kinds.bending = true,
            _ => return Err(format!("`{name}` is none of structural, shearing, bending")),
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
