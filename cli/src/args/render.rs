//! The arguments for how a scene is drawn.

use std::path::PathBuf;

use clap::builder::{PossibleValue, PossibleValuesParser};

use super::flag::{flag, help, size, whole};
use super::provenance::ProvenanceArgs;
use super::textures;
use crate::session::ui::Ui;
use drape::cubemap::FACES;
use drape::math::StateHash;
use drape::mesh::SpringKinds;
use drape::output::provenance::{Arguments, Provenance, hex};
use drape::render::{Options, Renderer};
use drape::scene::{ColliderKind, Flag, Images, Loaded, Scene, Shader};
use drape::texture_source::TextureSource;

/// Changes to how a scene is drawn.
#[derive(clap::Args)]
pub(crate) struct RenderArgs {
    /// Draw every object with this shader
    #[arg(long, value_name = "NAME", value_parser = shader())]
    shader: Option<String>,
    #[arg(long, value_name = "WxH", value_parser = size, help = help("", "render.size"))]
    size: Option<String>,
    #[arg(long, value_name = "N", value_parser = whole("render.samples"), help = help("", "render.samples"))]
    samples: Option<String>,
    #[arg(short = 'a', value_name = "N", value_parser = whole("sphere.resolution.0"),
          help = help("Latitude count of the mesh of each sphere", "sphere.resolution"))]
    latitudes: Option<String>,
    #[arg(short = 'o', value_name = "N", value_parser = whole("sphere.resolution.1"),
          help = help("Longitude count of the mesh of each sphere", "sphere.resolution"))]
    longitudes: Option<String>,
    /// Springs that the wireframe shader draws: structural, shearing, bending, separated by commas (default: those
    /// that the cloth has)
    #[arg(long, value_name = "KINDS", value_parser = springs)]
    springs: Option<SpringKinds>,
    /// Read all textures from this folder (texture_1.png, ..., cube/posx.png, ...) instead of the built-in set
    #[arg(long, value_name = "DIR")]
    textures: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) provenance: ProvenanceArgs,
}

/// Warns of `pictures` that show only the background.
pub(crate) fn warn_of_nothing_visible(pictures: &str, ui: &Ui) {
    ui.caution(
        &format!("no object is visible in {pictures}"),
        "check camera.target, camera.distance, camera.near and camera.far, and the time of the picture",
    );
}

impl RenderArgs {
    /// The changes to a scene.
    pub(crate) fn flags(&self) -> Vec<Flag> {
        let one = |name, path, value: &Option<String>| value.as_ref().map(|value| flag(name, path, value));
        let shader = self.shader.iter().flat_map(|shader| {
            let of = |key: &str| flag("--shader", &format!("{key}.*.material.shader"), shader);
            let objects = ["cloth"].into_iter().chain(ColliderKind::ALL.iter().map(|kind| kind.key()));
            objects.map(of).collect::<Vec<_>>()
        });
        let others = [
            one("--size", "render.size", &self.size),
            one("--samples", "render.samples", &self.samples),
            one("-a", "sphere.*.resolution.0", &self.latitudes),
            one("-o", "sphere.*.resolution.1", &self.longitudes),
        ];
        shader.chain(others.into_iter().flatten()).collect()
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
        self.textures().files(names.iter())
    }

    /// Warns of options that change nothing in `scene`, and of textures whose transparency is not drawn.
    pub(crate) fn caution(&self, scene: &Scene, renderer: &Renderer, ui: &Ui) {
        textures::caution(self.textures.as_deref(), scene, ui);
        let lines = scene.cloth.as_ref().is_some_and(|cloth| cloth.material.shader == Shader::Wireframe);
        let no_spheres = scene.spheres().next().is_none();
        for (given, acts, option, needs) in [
            (
                self.springs.is_some(),
                lines,
                "--springs",
                "only the shader `wireframe` draws the springs of a cloth",
            ),
            (self.latitudes.is_some(), !no_spheres, "-a", "the scene has no sphere"),
            (self.longitudes.is_some(), !no_spheres, "-o", "the scene has no sphere"),
            (
                self.shader.is_some(),
                scene.materials().next().is_some(),
                "--shader",
                "the scene has no object",
            ),
        ] {
            if given && !acts {
                ui.caution(&format!("{option} has no effect: {needs}"), "");
            }
        }
        for name in renderer.transparent_textures() {
            textures::caution_of_transparency(name, ui);
        }
    }

    /// What a picture of the scene in `loaded` says of itself, but for its textures; `arguments` is what is shown.
    pub(crate) fn provenance(&self, loaded: &Loaded, arguments: Arguments) -> Provenance {
        let arguments = Arguments { springs: self.springs.map(names_of_springs), ..arguments };
        self.provenance.of(loaded, arguments)
    }

    /// The hash of the textures that are drawn, if there are any that are not built in.
    pub(crate) fn texture_hash(&self, scene: &Scene, renderer: &Renderer) -> Option<String> {
        self.textures.as_ref().and_then(|_| texture_hash(scene, renderer))
    }

    /// The options of the renderer that are not in the scene.
    pub(crate) fn options(&self, ids: bool) -> Options {
        Options { springs: self.springs, ids, ..Options::default() }
    }
}

fn shader() -> PossibleValuesParser {
    PossibleValuesParser::new(
        Shader::NAMES.iter().map(|(name, shader)| PossibleValue::new(*name).help(shader.meaning())),
    )
}

/// The hash of the textures that are drawn, if there are any.
pub(crate) fn texture_hash(scene: &Scene, renderer: &Renderer) -> Option<String> {
    let mut hash = StateHash::default();
    renderer.hash_textures(&mut hash);
    textures::are_read(scene).then(|| hex(hash.finish()))
}

/// The kinds as [`springs`] reads them.
fn names_of_springs(kinds: SpringKinds) -> String {
    let SpringKinds { structural, shearing, bending } = kinds;
    let named = [(structural, "structural"), (shearing, "shearing"), (bending, "bending")];
    let names: Vec<&str> = named.into_iter().filter(|(drawn, _)| *drawn).map(|(_, name)| name).collect();
    names.join(",")
}

/// Reads kinds of springs.
pub(crate) fn springs(text: &str) -> Result<SpringKinds, String> {
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
    fn spring_kinds_are_a_list() {
        assert_eq!(springs("bending"), Ok(SpringKinds { structural: false, shearing: false, bending: true }));
        assert_eq!(
            springs("shearing,structural"),
            Ok(SpringKinds { structural: true, shearing: true, bending: false })
        );
        for text in ["bending", "structural,shearing", "structural,shearing,bending"] {
            assert_eq!(springs(text).map(names_of_springs), Ok(text.to_owned()));
        }
        assert!(springs("").is_err() && springs("structural,").is_err() && springs("all").is_err());
    }
}
