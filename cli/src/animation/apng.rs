//! Animated PNG: true colour, a picture's delay is the exact fraction 1 / fps of a second.
//!
//! Each picture but the first holds only the rectangle that changes (PNG specification, third
//! edition, `fcTL`: dispose `NONE`, blend `SOURCE`). The animation repeats for ever. What it says of itself stands behind
//! the pictures, as their hash is known last.

use std::fs::File;
use std::path::Path;

use ::png::text_metadata::TEXtChunk;

use super::changes::{Changes, Rectangle};
use super::format::{Animation, Format, MAX_FPS, Playback};
use super::seen::Seen;
use crate::session::files::staged::Staged;
use drape::error::{Error, Kind, Result};
use drape::output::provenance::Provenance;

/// The row of the table.
pub(crate) const APNG: Format = Format {
    ending: "apng",
    note: "an animated PNG, lossless",
    max_fps: MAX_FPS,
    says: true,
    check: |_, _| Ok(()),
    create: |path, playback, pictures, provenance| {
        Ok(Box::new(Apng::create(path, playback, pictures, provenance)?))
    },
};

/// An animated PNG that is being written.
struct Apng {
    staged: Staged,
    writer: ::png::Writer<File>,
    changes: Changes,
    fps: u16,
    seen: Seen,
    provenance: Provenance,
}

impl Apng {
    /// A file at `path` for exactly `pictures` pictures.
    ///
    /// # Errors
    /// [`Kind::Io`] when it cannot be written, [`Kind::Usage`] for more pictures than the format can count.
    fn create(path: &Path, playback: Playback, pictures: u64, provenance: Provenance) -> Result<Self> {
        let pictures = u32::try_from(pictures).map_err(|_| {
            Error::new(
                Kind::Usage,
                format!("{pictures} pictures are too many for an APNG, which counts up to {}", u32::MAX),
            )
        })?;
        let staged = Staged::create(path)?;
        let writer = header(staged.file()?, playback, pictures).map_err(|e| failed(&staged, e))?;
        let changes = Changes::new(playback.width);
        Ok(Self { staged, writer, changes, fps: playback.fps, seen: Seen::default(), provenance })
    }
}

impl Animation for Apng {
    fn add(&mut self, rgb: &[u8]) -> Result<()> {
        self.seen.add(rgb, [1000, u32::from(self.fps)]);
        let (rectangle, pixels) = self.changes.next(rgb);
        picture(&mut self.writer, rectangle, &pixels).map_err(|e| failed(&self.staged, e))
    }

    fn finish(self: Box<Self>, state: u64) -> Result<()> {
        let Self { staged, mut writer, seen, provenance, .. } = *self;
        for (keyword, text) in provenance.of_picture(state, seen.hash()).texts() {
            writer.write_text_chunk(&TEXtChunk::new(keyword, text)).map_err(|e| failed(&staged, e))?;
        }
        writer.finish().map_err(|e| failed(&staged, e))?;
        staged.finish()
    }
}

fn header(
    file: File,
    playback: Playback,
    pictures: u32,
) -> Result<::png::Writer<File>, ::png::EncodingError> {
    let mut encoder = ::png::Encoder::new(file, playback.width, playback.height);
    encoder.set_color(::png::ColorType::Rgb);
    encoder.set_depth(::png::BitDepth::Eight);
    encoder.set_compression(::png::Compression::High);
    encoder.set_filter(::png::Filter::Adaptive);
    encoder.set_animated(pictures, 0)?;
    encoder.set_frame_delay(1, playback.fps)?;
    encoder.set_blend_op(::png::BlendOp::Source)?;
    encoder.set_dispose_op(::png::DisposeOp::None)?;
    encoder.validate_sequence(true);
    encoder.write_header()
}

fn picture(
    writer: &mut ::png::Writer<File>,
    rectangle: Rectangle,
    pixels: &[u8],
) -> Result<(), ::png::EncodingError> {
    let side = |pixels: usize| u32::try_from(pixels).unwrap_or(u32::MAX);
    let Rectangle { left, top, width, height } = rectangle;
    // Each is held against the other, so the old place gives way first.
    writer.reset_frame_position()?;
    writer.set_frame_dimension(side(width), side(height))?;
    writer.set_frame_position(side(left), side(top))?;
    writer.write_image_data(pixels)
}

fn failed(staged: &Staged, cause: ::png::EncodingError) -> Error {
    match cause {
        ::png::EncodingError::IoError(cause) => staged.failed(&cause),
        other => Error::new(Kind::Internal, format!("cannot encode APNG: {other}")),
    }
}
