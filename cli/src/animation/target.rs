//! What `animate` writes to, and how it knows its own pictures again.

use std::path::{Path, PathBuf};

use crate::animation::apng::Apng;
use crate::animation::gif::Gif;
use crate::animation::mp4::{Mp4, find_ffmpeg};
use crate::animation::sequence::Pattern;
use crate::animation::{Animation, Format};
use drape::error::{Error, Kind, Result};
use drape::math::StateHash;
use drape::render::{Options, Renderer};
use drape::scene::Scene;

/// A file or a sequence of files.
pub(crate) enum Target {
    /// A PNG for each picture.
    Sequence(Pattern),
    /// An animated PNG.
    Apng(PathBuf),
    /// A GIF.
    Gif(PathBuf),
    /// A film by ffmpeg.
    Mp4(PathBuf),
}

impl Target {
    /// What a path stands for.
    ///
    /// # Errors
    /// [`Kind::Usage`] when it is none of these.
    pub(crate) fn parse(path: &Path) -> Result<Self> {
        let ending = path.extension().map(|ending| ending.to_string_lossy().to_lowercase());
        let target = match ending.as_deref() {
            Some("png") => Pattern::parse(path).map(Self::Sequence),
            Some("apng") => Some(Self::Apng(path.into())),
            Some("gif") => Some(Self::Gif(path.into())),
            Some("mp4") => Some(Self::Mp4(path.into())),
            _ => None,
        };
        target.ok_or_else(|| {
            Error::new(Kind::Usage, format!("`{}` is no animation", path.display())).with_help(
                "name an .apng, .gif or .mp4, or PNG files with a place for the number: frames/%04d.png",
            )
        })
    }

    /// The names of the pictures, if each has a file.
    pub(crate) fn pattern(&self) -> Option<&Pattern> {
        match self {
            Self::Sequence(pattern) => Some(pattern),
            _ => None,
        }
    }

    /// Finds out before long work whether there is a program to encode with.
    pub(crate) fn check(&self, format: Format) -> Result<()> {
        match self {
            Self::Mp4(path) => find_ffmpeg(path, format.fps),
            _ => Ok(()),
        }
    }

    /// The file for `count` pictures; none if each has its own.
    pub(crate) fn open(&self, format: Format, count: u64) -> Result<Option<Box<dyn Animation>>> {
        let pictures = || {
            u32::try_from(count)
                .map_err(|_| Error::new(Kind::Usage, format!("{count} pictures are too many")))
        };
        Ok(match self {
            Self::Sequence(_) => None,
            Self::Apng(path) => Some(Box::new(Apng::create(path, format, pictures()?)?)),
            Self::Gif(path) => Some(Box::new(Gif::create(path, format)?)),
            Self::Mp4(path) => Some(Box::new(Mp4::create(path, format)?)),
        })
    }

    /// The error of a signal, which says what stays.
    pub(crate) fn stopped(&self, error: Error) -> Error {
        match (self, error.kind) {
            (Self::Sequence(_), Kind::Signal(number)) => {
                Error::new(error.kind, format!("stopped by signal {number}; the pictures so far are whole"))
                    .with_help("the same command goes on from there")
            }
            _ => error,
        }
    }
}

/// What pictures say of themselves: a hash of all that decides how a simulated frame looks (the
/// scene with every default and change, the options, the textures, the version of this program),
/// and the frame.
pub(crate) struct Marks(u64);

impl Marks {
    /// The marks of pictures of `scene`.
    pub(crate) fn new(scene: &Scene, renderer: &Renderer, options: &Options) -> Self {
        let mut looks = scene.clone();
        // How many frames there are says nothing of how one looks.
        looks.render.time = 0.0;
        let mut hash = StateHash::default();
        hash.write(format!("{} {looks:?} {options:?}", env!("CARGO_PKG_VERSION")).as_bytes());
        renderer.hash_textures(&mut hash);
        Self(hash.finish())
    }

    /// What the picture of `frame` says.
    pub(crate) fn mark(&self, frame: u64) -> String {
        format!("scene {:016x} frame {frame}", self.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ending_decides() {
        let kind = |path: &str| Target::parse(Path::new(path));
        assert!(matches!(kind("a/%04d.png"), Ok(Target::Sequence(_))));
        assert!(matches!(kind("a.apng"), Ok(Target::Apng(_))));
        assert!(matches!(kind("a.GIF"), Ok(Target::Gif(_))));
        assert!(matches!(kind("a.b.mp4"), Ok(Target::Mp4(_))));
        for wrong in ["-", "a", "a.png", "a.webm", "%04d", ".gif", "%d/a.png"] {
            assert_eq!(kind(wrong).err().map(|e| e.kind), Some(Kind::Usage), "{wrong}");
        }
    }
}
