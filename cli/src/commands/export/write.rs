//! Writing meshes: the files that belong to one path.

use std::collections::BTreeMap;
use std::ops::Range;
use std::path::{Path, PathBuf};

use super::format::Format;
use crate::animation::pattern::Pattern;
use crate::session::Session;
use crate::session::files::atomic;
use crate::session::files::outputs;
use crate::session::files::target::{Content, is_stdout};
use drape::error::{Error, Kind, Result};
use drape::output::gltf::{self, Motion};
use drape::output::part::Part;
use drape::output::png::{self, Effort};
use drape::output::provenance::Provenance;
use drape::output::{obj, ply};
use drape::scene::{Collider, Material, Needs, Scene};
use drape::texture::Texture;
use drape::texture_source::TextureSource;

/// Where meshes are written to, and how.
pub(super) struct Writer<'a> {
    pub(super) path: &'a Path,
    pub(super) format: Format,
    /// The names of numbered files, if there is one for each frame.
    pub(super) pattern: Option<Pattern>,
    pub(super) materials: bool,
    pub(super) source: &'a TextureSource,
}

impl Writer<'_> {
    /// Checks, before long work, that the files, the textures `names` beside them and `others` can be written.
    pub(super) fn check<'n>(
        &self,
        inputs: &[PathBuf],
        names: impl Iterator<Item = &'n String> + Clone,
        frames: &Range<u64>,
        others: &[(&Path, Content)],
    ) -> Result<()> {
        if self.materials && (is_stdout(self.path) || self.format == Format::Ply) {
            return Err(Error::new(Kind::Usage, "--materials writes files beside an .obj file")
                .with_help("name an .obj or a .glb file, or leave out --materials"));
        }
        let content = if self.format == Format::Obj { Content::Text } else { Content::Binary };
        let outputs: Vec<PathBuf> = match &self.pattern {
            Some(pattern) if !pattern.folder().as_os_str().is_empty() && !pattern.folder().exists() => {
                vec![pattern.folder().to_path_buf()]
            }
            Some(pattern) => (0..frames.end - frames.start).take(1).map(|k| pattern.path(k)).collect(),
            None => vec![self.path.to_path_buf()],
        };
        let library = self.library().filter(|_| self.pattern.is_none());
        let meshes = outputs.iter().chain(&library).map(|path| (path.as_path(), content));
        // Of numbered files the folder may not be there yet, and then has no texture of the user.
        let is_there = |path: &PathBuf| self.pattern.is_none() || path.exists();
        let textures: Vec<PathBuf> = self.beside(names.clone()).into_iter().filter(is_there).collect();
        let read: Vec<PathBuf> = inputs.iter().cloned().chain(self.source.files(names)).collect();
        let textures = textures.iter().map(|path| (path.as_path(), Content::Binary));
        outputs::check(&read, meshes.chain(others.iter().copied()).chain(textures))?;
        Ok(())
    }

    /// The textures that are written, each read once; with `objects` those of all objects.
    ///
    /// # Errors
    /// As [`TextureSource::texture`].
    pub(super) fn textures(&self, scene: &Scene, objects: bool) -> Result<BTreeMap<String, Texture>> {
        let cloth = scene.cloth.iter().map(|cloth| &cloth.material);
        let others = scene.colliders.iter().filter(|_| objects).map(Collider::material);
        let mut textures = BTreeMap::new();
        for name in cloth.chain(others).flat_map(|material| self.names(material)) {
            textures.insert(name.clone(), self.source.texture(name)?);
        }
        Ok(textures)
    }

    /// The names of the textures that are written for a material.
    fn names<'m>(&self, material: &'m Material) -> impl Iterator<Item = &'m String> + use<'m> {
        let needs = Needs::of(material.shader);
        let kept = [
            (needs.texture && self.has_materials(), &material.texture),
            (needs.height_map && self.library().is_some(), &material.height_map),
        ];
        kept.into_iter().filter(|(written, _)| *written).map(|(_, name)| name)
    }

    /// Where the textures `names` are written, beside the file of the materials.
    fn beside<'n>(&self, names: impl Iterator<Item = &'n String>) -> Vec<PathBuf> {
        let library = self.library();
        let path = |name: &String| Some(library.as_ref()?.with_file_name(format!("{name}.png")));
        names.filter_map(path).collect()
    }

    /// Whether the files have materials.
    fn has_materials(&self) -> bool {
        self.materials || self.format == Format::Glb
    }

    /// Writes all in one file; one that has a place for it says `provenance` of itself, with the hash of the state.
    pub(super) fn whole(
        &self,
        parts: Vec<Part<'_>>,
        motion: Option<&Motion>,
        provenance: (u64, &Provenance),
    ) -> Result<()> {
        match self.format {
            Format::Glb => {
                let bytes = gltf::encode(&parts, motion, Some(provenance), |name| self.texture(name))?;
                atomic::write(self.path, &bytes)
            }
            _ => self.write(self.path, &parts),
        }
    }

    /// Writes numbered file `k`.
    pub(super) fn frame(&self, k: u64, parts: &[Part<'_>]) -> Result<()> {
        let Some(pattern) = &self.pattern else { return Ok(()) };
        outputs::make_folder(pattern.folder())?;
        self.write(&pattern.path(k), parts)
    }

    fn write(&self, path: &Path, parts: &[Part<'_>]) -> Result<()> {
        if self.format == Format::Ply {
            return atomic::write(path, &ply::encode(parts)?);
        }
        let library = self.library();
        let name = library.as_ref().and_then(|path| path.file_name()).map(|name| name.to_string_lossy());
        if name.as_ref().is_some_and(|name| name.contains(char::is_control)) {
            let message =
                "the file of the materials has a control character in its name, which an OBJ cannot hold";
            return Err(Error::new(Kind::Usage, message).with_help("name the mesh otherwise"));
        }
        if let Some(library) = &library {
            atomic::write(library, obj::materials(parts).as_bytes())?;
            self.write_textures(library, parts)?;
        }
        atomic::write(path, obj::encode(parts, name.as_deref())?.as_bytes())
    }

    /// The file of the materials of an OBJ: that of all numbered files has the name of the folder.
    fn library(&self) -> Option<PathBuf> {
        let wanted = self.materials && self.format == Format::Obj;
        let path = match &self.pattern {
            Some(pattern) => pattern.folder().join("materials.mtl"),
            None => self.path.with_extension("mtl"),
        };
        wanted.then_some(path)
    }

    /// Writes the textures that the materials of `parts` name beside their file.
    fn write_textures(&self, library: &Path, parts: &[Part<'_>]) -> Result<()> {
        for name in parts.iter().flat_map(|part| self.names(part.material)) {
            atomic::write(&library.with_file_name(format!("{name}.png")), &self.texture(name)?)?;
        }
        Ok(())
    }

    /// The PNG of a texture.
    fn texture(&self, name: &str) -> Result<Vec<u8>> {
        let texture = self.source.texture(name)?;
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 0 to 255")]
        let level = |c: f32| (c * 255.0).round_ties_even() as u8;
        let rgb: Vec<u8> = texture.texels().iter().flat_map(|&[r, g, b, _]| [r, g, b].map(level)).collect();
        let side = |n: usize| u32::try_from(n).unwrap_or(u32::MAX);
        png::encode(side(texture.width()), side(texture.height()), &rgb, Effort::Small)
    }

    /// Warns of numbered files from `count` on, which an earlier, longer run has left.
    pub(super) fn stale(&self, count: u64, session: &Session) {
        if let Some(pattern) = &self.pattern {
            pattern.caution(|number| number >= count, &session.ui);
        }
    }
}
