//! Animated PNG: true colour, a picture's delay is the exact fraction 1 / fps of a second.
//!
//! Each picture but the first holds only the rectangle that changes (PNG specification, third
//! edition, `fcTL`: dispose `NONE`, blend `SOURCE`). The animation repeats for ever.

use std::fs::File;
use std::path::Path;

use super::changes::{Changes, Rectangle};
use super::format::{Animation, Format, MAX_FPS, Playback};
use crate::session::files::staged::Staged;
use drape::error::{Error, Kind, Result};

/// The row of the table.
pub(crate) const APNG: Format = Format {
    ending: "apng",
    note: "an animated PNG, lossless",
    max_fps: MAX_FPS,
    check: |_, _| Ok(()),
    create: |path, playback, pictures| Ok(Box::new(Apng::create(path, playback, pictures)?)),
};

/// An animated PNG that is being written.
struct Apng {
    staged: Staged,
    writer: ::png::Writer<File>,
    changes: Changes,
}

impl Apng {
    /// A file at `path` for exactly `pictures` pictures.
    ///
    /// # Errors
    /// [`Kind::Io`] when it cannot be written, [`Kind::Usage`] for more pictures than the format can count.
    fn create(path: &Path, playback: Playback, pictures: u64) -> Result<Self> {
        let pictures = u32::try_from(pictures).map_err(|_| {
            Error::new(
                Kind::Usage,
                format!("{pictures} pictures are too many for an APNG, which counts up to {}", u32::MAX),
            )
        })?;
        let staged = Staged::create(path)?;
        let writer = header(staged.file()?, playback, pictures).map_err(|e| failed(&staged, e))?;
        Ok(Self { staged, writer, changes: Changes::new(playback.width) })
    }
}

impl Animation for Apng {
    fn add(&mut self, rgb: &[u8]) -> Result<()> {
        let (rectangle, pixels) = self.changes.next(rgb);
        picture(&mut self.writer, rectangle, &pixels).map_err(|e| failed(&self.staged, e))
    }

    fn finish(self: Box<Self>) -> Result<()> {
        let Self { staged, writer, .. } = *self;
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
