//! GIF: at most 256 colours in a picture, times in hundredths of a second.
//!
//! Picture k is shown from round(100 k / fps) to round(100 (k + 1) / fps) hundredths, so that
//! rounding never adds up: after any number of pictures the clock is at most half a hundredth off.
//! Each picture but the first holds only the rectangle that changes, with a [`Palette`] of its own, which is exact
//! up to 256 colours. The animation repeats for ever.

use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::Path;

use gif::{DisposalMethod, Encoder, EncodingError, Frame, Repeat};

use super::changes::{Changes, Rectangle};
use super::format::{Animation, Format, Playback};
use super::palette::Palette;
use crate::session::files::staged::Staged;
use drape::error::{Error, Kind, Result};

/// Most pictures per second: players show delays below two hundredths as ten.
const MAX_FPS: u16 = 50;

/// The row of the table.
pub(crate) const GIF: Format = Format {
    ending: "gif",
    note: "at most 256 colours in a picture and 50 pictures per second",
    max_fps: MAX_FPS,
    check: |_, _| Ok(()),
    create: |path, playback, _| Ok(Box::new(Gif::create(path, playback)?)),
};

/// A GIF that is being written.
struct Gif {
    staged: Staged,
    encoder: Encoder<BufWriter<File>>,
    changes: Changes,
    fps: u16,
    pictures: u64,
}

impl Gif {
    /// A file at `path`.
    ///
    /// # Errors
    /// [`Kind::Io`] when it cannot be written; [`Kind::Usage`] when a side has more than 65535
    /// pixels or the rate is above [`MAX_FPS`].
    fn create(path: &Path, playback: Playback) -> Result<Self> {
        let Playback { width, height, fps, .. } = playback;
        let (Ok(w), Ok(h), 1..=MAX_FPS) = (u16::try_from(width), u16::try_from(height), fps) else {
            let message = format!("a GIF cannot hold {width} x {height} pixels at {fps} pictures per second");
            let help = format!("at most {0} x {0} pixels at {MAX_FPS} pictures per second", u16::MAX);
            return Err(Error::new(Kind::Usage, message).with_help(help));
        };
        let staged = Staged::create(path)?;
        let encoder = header(BufWriter::new(staged.file()?), w, h).map_err(|e| failed(&staged, e))?;
        Ok(Self { staged, encoder, changes: Changes::new(width), fps, pictures: 0 })
    }
}

impl Animation for Gif {
    fn add(&mut self, rgb: &[u8]) -> Result<()> {
        let (rectangle, pixels) = self.changes.next(rgb);
        let frame = frame(rectangle, &pixels, delay(self.pictures, self.fps));
        self.pictures += 1;
        self.encoder.write_frame(&frame).map_err(|e| failed(&self.staged, e))
    }

    fn finish(self: Box<Self>) -> Result<()> {
        let Self { staged, encoder, .. } = *self;
        let mut writer = encoder.into_inner().map_err(|e| failed(&staged, e))?;
        writer.flush().map_err(|e| staged.failed(&e))?;
        drop(writer);
        staged.finish()
    }
}

fn header(
    writer: BufWriter<File>,
    width: u16,
    height: u16,
) -> Result<Encoder<BufWriter<File>>, EncodingError> {
    let mut encoder = Encoder::new(writer, width, height, &[])?;
    encoder.set_repeat(Repeat::Infinite)?;
    Ok(encoder)
}

fn frame(rectangle: Rectangle, pixels: &[u8], delay: u16) -> Frame<'static> {
    let side = |pixels: usize| u16::try_from(pixels).unwrap_or(u16::MAX);
    let Rectangle { left, top, width, height } = rectangle;
    let (palette, buffer) = Palette::of(pixels);
    Frame {
        left: side(left),
        top: side(top),
        width: side(width),
        height: side(height),
        delay,
        dispose: DisposalMethod::Keep,
        palette: Some(palette.into_bytes()),
        buffer: buffer.into(),
        ..Frame::default()
    }
}

/// How long picture `k` is shown, in hundredths of a second.
fn delay(k: u64, fps: u16) -> u16 {
    let fps = u64::from(fps);
    let start = |k: u64| (200 * k + fps) / (2 * fps);
    u16::try_from(start(k + 1) - start(k)).unwrap_or(u16::MAX)
}

fn failed(staged: &Staged, cause: EncodingError) -> Error {
    match cause {
        EncodingError::Io(cause) => staged.failed(&cause),
        other => Error::new(Kind::Internal, format!("cannot encode GIF: {other}")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn delays_never_drift() {
        for fps in 1..=MAX_FPS {
            let mut clock = 0;
            for k in 0..1000 {
                // Twice the distance from the exact time, in hundredths times fps.
                let off = 2 * (i64::from(fps) * clock - 100 * i64::try_from(k).unwrap());
                assert!(off.abs() <= i64::from(fps), "fps {fps}, picture {k}: {clock}");
                clock += i64::from(delay(k, fps));
                assert!(delay(k, fps) >= 2, "players take a shorter delay as ten");
            }
        }
        let thirds: Vec<u16> = (0..6).map(|k| delay(k, 30)).collect();
        assert_eq!(thirds, [3, 4, 3, 3, 4, 3]);
    }
}
