//! The file that is verified: what it says of itself, and what a reader sees of it.

use std::path::Path;

use image::ImageFormat;

use crate::animation::comment;
use crate::animation::reel::{Reel, Shown};
use crate::animation::seen::Seen;
use drape::bounded;
use drape::error::{Error, Kind, Result};
use drape::math::StateHash;
use drape::output::png::{self, Pixels};
use drape::output::provenance::{Provenance, hex};

/// A picture or an animation.
pub(super) struct File {
    name: String,
    bytes: Vec<u8>,
    /// What it says of itself.
    pub(super) provenance: Provenance,
    /// Whether its colours are reduced as those of a GIF.
    pub(super) is_gif: bool,
}

impl File {
    /// Reads the file at `path`.
    ///
    /// # Errors
    /// [`Kind::Io`] when it is no picture, or what it says of itself is damaged; [`Kind::Nothing`] when it says
    /// nothing.
    pub(super) fn read(path: &Path) -> Result<Self> {
        let name = path.display().to_string();
        let failed = |why: &dyn std::fmt::Display| {
            Error::new(Kind::Io, format!("cannot read `{}`: {why}", path.display()))
        };
        let bytes = bounded::read(path, bounded::MOST).map_err(|e| failed(&e))?;
        let format = image::guess_format(&bytes).ok();
        let texts = match format {
            Some(ImageFormat::Png) => png::texts(&bytes).map_err(|e| failed(&e.message))?,
            Some(ImageFormat::Gif) => comment::texts(&bytes),
            Some(ImageFormat::Jpeg) => Vec::new(),
            _ => return Err(no_picture(&name)),
        };
        let provenance = Provenance::from_texts(&texts).map_err(|e| failed(&e.message))?;
        let provenance = provenance.ok_or_else(|| says_nothing(&name))?;
        Ok(Self { name, bytes, provenance, is_gif: format == Some(ImageFormat::Gif) })
    }

    /// Its pictures.
    pub(super) fn pictures(&self) -> Result<Reel> {
        Reel::of(self.name.clone(), self.bytes.clone())
    }

    /// What a reader sees of it.
    pub(super) fn seen(&self) -> Result<AsSeen> {
        let mut pictures = self.pictures()?;
        let (mut still, mut seen) = (StateHash::default(), Seen::default());
        let (moves, plays, mut count, mut size) = (pictures.moves(), pictures.plays, 0, [0; 2]);
        while let Some(Shown { pixels, delay }) = pictures.next()? {
            count += 1;
            size = [pixels.width, pixels.height];
            let rgb = colors(&pixels);
            match delay {
                Some((numerator, denominator)) => seen.add(&rgb, [numerator, denominator]),
                None => still.write(&rgb),
            }
        }
        let hash = hex(if moves { seen.hash() } else { still.finish() });
        Ok(AsSeen { hash, pictures: count, plays, size })
    }
}

/// What a reader sees of a file.
pub(super) struct AsSeen {
    /// The hash of its pictures, and of their times.
    pub(super) hash: String,
    pub(super) pictures: u64,
    /// How often an animation is shown; 0 for ever.
    pub(super) plays: u32,
    /// Width and height in pixels.
    pub(super) size: [u32; 2],
}

/// Red, green and blue of each pixel, and alpha too where one is not opaque, so that it has another hash.
pub(super) fn colors(pixels: &Pixels) -> Vec<u8> {
    let opaque = pixels.rgba.iter().all(|pixel| pixel[3] == u8::MAX);
    let kept = if opaque { 3 } else { 4 };
    pixels.rgba.iter().flat_map(|pixel| &pixel[..kept]).copied().collect()
}

fn no_picture(name: &str) -> Error {
    let message = format!("cannot read `{name}`: it is no PNG, animated PNG or GIF");
    Error::new(Kind::Io, message)
        .with_help("what meshes and positions say of themselves is for other programs")
}

fn says_nothing(name: &str) -> Error {
    let message = format!("`{name}` says nothing of itself, so there is nothing to verify");
    Error::new(Kind::Nothing, message).with_help(
        "`drape render`, `animate` and `gallery` write pictures that do; other programs may remove what they say",
    )
}
