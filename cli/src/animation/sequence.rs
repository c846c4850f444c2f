//! A PNG file for each picture.
//!
//! Each file has a text chunk (keyword `drape`) with the fingerprint of what it shows, so that a later run
//! keeps the pictures of the same scene and draws the others again.

use std::fs::{self, File};
use std::io::BufReader;
use std::path::{Path, PathBuf};

use super::fingerprint::Fingerprint;
use super::pattern::Pattern;
use crate::session::files::atomic;
use drape::error::{Error, Kind, Result};
use drape::render::Picture;

/// The keyword of the text chunk.
const KEYWORD: &str = "drape";

/// Numbered pictures, some of which may be there from an earlier run.
pub(crate) struct Sequence<'a> {
    pub(crate) pattern: &'a Pattern,
    pub(crate) fingerprint: Fingerprint,
}

impl Sequence<'_> {
    /// Whether picture `number` is there, complete, and shows `frame` of the same scene.
    pub(crate) fn has(&self, number: u64, frame: u64) -> bool {
        is_complete(&self.pattern.path(number), &self.fingerprint.text(frame))
    }

    /// Removes the pictures from number `count` on that an earlier, longer run has left; returns those files that
    /// have such a name and are not of this program.
    ///
    /// # Errors
    /// [`Kind::Io`] when one cannot be removed.
    pub(crate) fn remove_from(&self, count: u64) -> Result<Vec<PathBuf>> {
        let late = self.pattern.files().into_iter().filter(|(number, _)| *number >= count);
        let (own, others): (Vec<PathBuf>, Vec<PathBuf>) =
            late.map(|(_, path)| path).partition(|path| File::open(path).is_ok_and(is_own));
        for path in own {
            fs::remove_file(&path).map_err(|e| {
                Error::new(Kind::Io, format!("cannot remove `{}` of an earlier run: {e}", path.display()))
            })?;
        }
        Ok(others)
    }

    /// Writes picture `number`, which shows `frame`.
    ///
    /// # Errors
    /// As [`atomic::write`].
    pub(crate) fn write(&self, number: u64, frame: u64, picture: &Picture) -> Result<()> {
        let size = [picture.width, picture.height];
        write(&self.pattern.path(number), size, &picture.rgb, &self.fingerprint.text(frame))
    }
}

/// Writes a picture (three bytes a pixel, top row first) with a text chunk.
///
/// # Errors
/// As [`atomic::write`]; [`Kind::Internal`] when `rgb` is not of that size.
fn write(path: &Path, [width, height]: [u32; 2], rgb: &[u8], text: &str) -> Result<()> {
    let bytes = encode(width, height, rgb, text)
        .map_err(|e| Error::new(Kind::Internal, format!("cannot encode PNG: {e}")))?;
    atomic::write(path, &bytes)
}

fn encode(width: u32, height: u32, rgb: &[u8], text: &str) -> Result<Vec<u8>, ::png::EncodingError> {
    let mut bytes = Vec::new();
    let mut encoder = ::png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(::png::ColorType::Rgb);
    encoder.set_depth(::png::BitDepth::Eight);
    encoder.set_compression(::png::Compression::Fast);
    encoder.set_filter(::png::Filter::Adaptive);
    encoder.add_text_chunk(KEYWORD.into(), text.into())?;
    let mut writer = encoder.write_header()?;
    writer.write_image_data(rgb)?;
    writer.finish()?;
    Ok(bytes)
}

/// Whether `path` is a complete picture with this text chunk.
fn is_complete(path: &Path, text: &str) -> bool {
    File::open(path).is_ok_and(|file| has_text(file, text).unwrap_or(false)) && ends(path)
}

fn has_text(file: File, text: &str) -> Result<bool, ::png::DecodingError> {
    let mut reader = ::png::Decoder::new(BufReader::new(file)).read_info()?;
    let texts = &reader.info().uncompressed_latin1_text;
    if !texts.iter().any(|chunk| chunk.keyword == KEYWORD && chunk.text == text) {
        return Ok(false);
    }
    let mut pixels = vec![0; reader.output_buffer_size().unwrap_or(0)];
    reader.next_frame(&mut pixels)?;
    reader.finish()?;
    Ok(true)
}

/// Whether a file is a picture that this program has numbered.
fn is_own(file: File) -> bool {
    let reader = ::png::Decoder::new(BufReader::new(file)).read_info();
    reader.is_ok_and(|reader| {
        reader.info().uncompressed_latin1_text.iter().any(|chunk| chunk.keyword == KEYWORD)
    })
}

/// Whether the last chunk is there, which a decoder does not ask for.
fn ends(path: &Path) -> bool {
    fs::read(path).is_ok_and(|bytes| bytes.ends_with(b"IEND\xAE\x42\x60\x82"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_a_complete_file_with_the_same_text_counts() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("0.png");
        write(&path, [2, 1], &[1, 2, 3, 4, 5, 6], "scene a").unwrap();
        let bytes = fs::read(&path).unwrap();
        assert!(is_complete(&path, "scene a") && !is_complete(&path, "scene b"));
        assert_eq!(drape::output::png::read(&path).unwrap().rgba, [[1, 2, 3, 255], [4, 5, 6, 255]]);
        for cut in 0..bytes.len() {
            fs::write(&path, &bytes[..cut]).unwrap();
            assert!(!is_complete(&path, "scene a"), "cut to {cut} of {} bytes", bytes.len());
        }
        for flipped in 0..bytes.len() {
            let mut bytes = bytes.clone();
            bytes[flipped] ^= 4;
            fs::write(&path, &bytes).unwrap();
            assert!(!is_complete(&path, "scene a"), "byte {flipped} changed");
        }
        assert!(!is_complete(&dir.path().join("none.png"), "scene a") && !is_complete(dir.path(), "scene a"));
    }
}
