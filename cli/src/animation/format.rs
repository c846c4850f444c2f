//! What a format of animations is.

use std::path::Path;

use drape::error::Result;
use drape::output::provenance::Provenance;

/// Most pictures per second of any format.
pub(crate) const MAX_FPS: u16 = 1000;

/// A format that holds all pictures in one file.
pub(crate) struct Format {
    /// The extension of its file names, in lower case.
    pub(crate) ending: &'static str,
    /// What the help says of it besides the ending; may be empty.
    pub(crate) note: &'static str,
    /// Most pictures per second.
    pub(crate) max_fps: u16,
    /// Whether a file has a place for what it says of itself.
    pub(crate) says: bool,
    /// Checks, before long work, that a file at this path can be encoded.
    pub(crate) check: fn(&Path, Playback) -> Result<()>,
    /// Starts a file.
    pub(crate) create: Create,
}

/// Starts a file at this path for this many pictures, which says this of itself if the format has a place for it.
pub(crate) type Create = fn(&Path, Playback, u64, Provenance) -> Result<Box<dyn Animation>>;

/// The size and the speed of an animation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Playback {
    /// Width in pixels (>= 1).
    pub(crate) width: u32,
    /// Height in pixels (>= 1).
    pub(crate) height: u32,
    /// Pictures per second (>= 1).
    pub(crate) fps: u16,
    /// The colour of the background, with which a format fills up sizes that it does not have.
    pub(crate) background: [u8; 3],
}

/// A file that is being encoded. It appears only when it is complete.
pub(crate) trait Animation: Send {
    /// Encodes the next picture: three bytes a pixel, top row first.
    ///
    /// # Errors
    /// [`Kind::Io`](drape::error::Kind::Io) when it cannot be written.
    fn add(&mut self, rgb: &[u8]) -> Result<()>;

    /// Completes the file, whose states have the hash `state`. Without this call there is none.
    ///
    /// # Errors
    /// As [`Animation::add`].
    fn finish(self: Box<Self>, state: u64) -> Result<()>;
}
