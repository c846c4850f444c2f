//! GIF: at most 256 colours in a picture, times in hundredths of a second.
//!
//! Picture k is shown from round(100 k / fps) to round(100 (k + 1) / fps) hundredths, so that
//! rounding never adds up: after any number of pictures the clock is at most half a hundredth off.
//! Each picture but the first holds only the rectangle that changes, with a [`Palette`] of its own, which is exact
//! up to 256 colours. The animation repeats for ever.
//!
//! What the file says of itself is a comment: a line `keyword=text` for each text. Readers look for a comment in
//! front of the pictures, whose hash is known behind them, so two hashes are filled in at the end.

use std::fs::File;
use std::io::{self, BufWriter, Read, Seek, SeekFrom, Write};
use std::path::Path;

use gif::{AnyExtension, DisposalMethod, Encoder, EncodingError, Extension, Frame, Repeat};

use super::changes::Rectangle;
use super::comment::comment;
use super::format::{Animation, Format, Playback};
use super::reduced::{Patch, Reduced};
use super::seen::Seen;
use crate::session::files::staged::Staged;
use drape::error::{Error, Kind, Result};
use drape::output::provenance::Provenance;

/// Most pictures per second: players show delays below two hundredths as ten.
const MAX_FPS: u16 = 50;

/// The row of the table.
pub(crate) const GIF: Format = Format {
    ending: "gif",
    note: "at most 256 colours in a picture and 50 pictures per second",
    max_fps: MAX_FPS,
    says: true,
    check: |_, _| Ok(()),
    create: |path, playback, _, provenance| Ok(Box::new(Gif::create(path, playback, &provenance)?)),
};

/// A GIF that is being written.
struct Gif {
    staged: Staged,
    encoder: Encoder<BufWriter<File>>,
    reduced: Reduced,
    fps: u16,
    pictures: u64,
    seen: Seen,
}

impl Gif {
    /// A file at `path`.
    ///
    /// # Errors
    /// [`Kind::Io`] when it cannot be written; [`Kind::Usage`] when a side has more than 65535
    /// pixels or the rate is above [`MAX_FPS`].
    fn create(path: &Path, playback: Playback, provenance: &Provenance) -> Result<Self> {
        let Playback { width, height, fps, .. } = playback;
        let (Ok(w), Ok(h), 1..=MAX_FPS) = (u16::try_from(width), u16::try_from(height), fps) else {
            let message = format!("a GIF cannot hold {width} x {height} pixels at {fps} pictures per second");
            let help = format!("at most {0} x {0} pixels at {MAX_FPS} pictures per second", u16::MAX);
            return Err(Error::new(Kind::Usage, message).with_help(help));
        };
        let staged = Staged::create(path)?;
        let comment = comment(&provenance.of_picture(0, 0).texts());
        let encoder =
            header(BufWriter::new(staged.file()?), w, h, &comment).map_err(|e| failed(&staged, e))?;
        Ok(Self { staged, encoder, reduced: Reduced::new(width), fps, pictures: 0, seen: Seen::default() })
    }
}

impl Animation for Gif {
    fn add(&mut self, rgb: &[u8]) -> Result<()> {
        let delay = delay(self.pictures, self.fps);
        let frame = frame(self.reduced.next(rgb), delay);
        self.seen.add(self.reduced.seen(), milliseconds(delay));
        self.pictures += 1;
        self.encoder.write_frame(&frame).map_err(|e| failed(&self.staged, e))
    }

    fn finish(self: Box<Self>, state: u64) -> Result<()> {
        let Self { staged, encoder, seen, .. } = *self;
        let mut writer = encoder.into_inner().map_err(|e| failed(&staged, e))?;
        writer.flush().map_err(|e| staged.failed(&e))?;
        drop(writer);
        let known = Provenance::default().of_picture(state, seen.hash());
        fill_in(&mut staged.file()?, &known).map_err(|e| staged.failed(&e))?;
        staged.finish()
    }
}

/// Writes the two hashes of `known`, the first lines of the comment, over those that were reserved.
fn fill_in(file: &mut File, known: &Provenance) -> io::Result<()> {
    let mut start = [0; 256];
    let read = file.read(&mut start)?;
    let start = &start[..read];
    for (keyword, hash) in known.texts().iter().take(2) {
        let place = start.windows(keyword.len()).position(|window| window == keyword.as_bytes());
        let place = place.ok_or_else(|| io::Error::other("the comment is not where it was written"))?;
        file.seek(SeekFrom::Start((place + keyword.len() + 1) as u64))?;
        file.write_all(hash.as_bytes())?;
    }
    Ok(())
}

fn header(
    writer: BufWriter<File>,
    width: u16,
    height: u16,
    comment: &str,
) -> Result<Encoder<BufWriter<File>>, EncodingError> {
    let mut encoder = Encoder::new(writer, width, height, &[])?;
    encoder.set_repeat(Repeat::Infinite)?;
    encoder.write_raw_extension(AnyExtension(Extension::Comment as u8), &[comment.as_bytes()])?;
    Ok(encoder)
}

fn frame(patch: Patch, delay: u16) -> Frame<'static> {
    let side = |pixels: usize| u16::try_from(pixels).unwrap_or(u16::MAX);
    let Patch { rectangle: Rectangle { left, top, width, height }, palette, indices } = patch;
    Frame {
        left: side(left),
        top: side(top),
        width: side(width),
        height: side(height),
        delay,
        dispose: DisposalMethod::Keep,
        palette: Some(palette),
        buffer: indices.into(),
        ..Frame::default()
    }
}

/// How long picture `k` is shown, in hundredths of a second.
pub(crate) fn delay(k: u64, fps: u16) -> u16 {
    let fps = u64::from(fps);
    let start = |k: u64| (200 * k + fps) / (2 * fps);
    u16::try_from(start(k + 1) - start(k)).unwrap_or(u16::MAX)
}

/// A time in hundredths of a second as a fraction of milliseconds.
pub(crate) fn milliseconds(hundredths: u16) -> [u32; 2] {
    [10 * u32::from(hundredths), 1]
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
