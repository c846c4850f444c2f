//! A PNG file for each picture, numbered: `pictures/%04d.png` is `pictures/0000.png` and so on.
//!
//! Each file says in a text chunk (keyword `drape`) what it shows, so that pictures of an earlier
//! run can be told from those of another scene.

use std::fs::{self, File};
use std::io::BufReader;
use std::path::{Path, PathBuf};

use crate::session::files::atomic;
use drape::error::{Error, Kind, Result};

/// The keyword of the text chunk.
const KEYWORD: &str = "drape";

/// Most digits that a number is filled up to.
const MAX_DIGITS: usize = 19;

/// The names of numbered files.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Pattern {
    folder: PathBuf,
    before: String,
    digits: usize,
    after: String,
}

impl Pattern {
    /// The pattern in a path whose file name holds one `%d`, or `%04d` for at least four digits.
    /// None if there is no such place, or several, or `%` elsewhere in the name.
    pub(crate) fn parse(path: &Path) -> Option<Self> {
        let (before, rest) = path.file_name()?.to_str()?.split_once('%')?;
        let (digits, after) = rest.split_once('d')?;
        let digits = match digits.strip_prefix('0') {
            Some(digits) => digits.parse().ok().filter(|digits| (1..=MAX_DIGITS).contains(digits))?,
            None if digits.is_empty() => 1,
            None => return None,
        };
        let folder = path.parent()?.to_path_buf();
        (!after.contains('%')).then(|| Self { folder, before: before.into(), digits, after: after.into() })
    }

    /// The folder of all files; empty for the current one.
    pub(crate) fn folder(&self) -> &Path {
        &self.folder
    }

    /// The file of picture `number`.
    pub(crate) fn path(&self, number: u64) -> PathBuf {
        let Self { folder, before, digits, after } = self;
        folder.join(format!("{before}{number:0digits$}{after}"))
    }

    /// The number of the picture whose file name `path` has, in whatever folder.
    pub(crate) fn number(&self, path: &Path) -> Option<u64> {
        let name = path.file_name()?.to_str()?;
        let number = name.strip_prefix(&self.before)?.strip_suffix(&self.after)?.parse().ok()?;
        (self.path(number).file_name() == path.file_name()).then_some(number)
    }
}

/// Writes a picture (three bytes a pixel, top row first) that says of itself `mark`.
///
/// # Errors
/// As [`atomic::write`]; [`Kind::Internal`] when `rgb` is not of that size.
pub(crate) fn write(path: &Path, [width, height]: [u32; 2], rgb: &[u8], mark: &str) -> Result<()> {
    let bytes = encode(width, height, rgb, mark)
        .map_err(|e| Error::new(Kind::Internal, format!("cannot encode PNG: {e}")))?;
    atomic::write(path, &bytes)
}

fn encode(width: u32, height: u32, rgb: &[u8], mark: &str) -> Result<Vec<u8>, ::png::EncodingError> {
    let mut bytes = Vec::new();
    let mut encoder = ::png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(::png::ColorType::Rgb);
    encoder.set_depth(::png::BitDepth::Eight);
    encoder.set_compression(::png::Compression::Fast);
    encoder.set_filter(::png::Filter::Adaptive);
    encoder.add_text_chunk(KEYWORD.into(), mark.into())?;
    let mut writer = encoder.write_header()?;
    writer.write_image_data(rgb)?;
    writer.finish()?;
    Ok(bytes)
}

/// Whether `path` is a whole picture that says of itself `mark`.
pub(crate) fn is_whole(path: &Path, mark: &str) -> bool {
    File::open(path).is_ok_and(|file| has_mark(file, mark).unwrap_or(false)) && ends(path)
}

fn has_mark(file: File, mark: &str) -> Result<bool, ::png::DecodingError> {
    let mut reader = ::png::Decoder::new(BufReader::new(file)).read_info()?;
    let texts = &reader.info().uncompressed_latin1_text;
    if !texts.iter().any(|text| text.keyword == KEYWORD && text.text == mark) {
        return Ok(false);
    }
    let mut pixels = vec![0; reader.output_buffer_size().unwrap_or(0)];
    reader.next_frame(&mut pixels)?;
    reader.finish()?;
    Ok(true)
}

/// Whether the last chunk is there, which a decoder does not ask for.
fn ends(path: &Path) -> bool {
    fs::read(path).is_ok_and(|bytes| bytes.ends_with(b"IEND\xAE\x42\x60\x82"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pattern_has_one_place_for_the_number() {
        let name = |text: &str| Pattern::parse(Path::new(text)).map(|pattern| pattern.path(7));
        for (pattern, file) in [
            ("a/%04d.png", "a/0007.png"),
            ("%d.png", "7.png"),
            ("a b/x%03dy.png", "a b/x007y.png"),
            ("100%/%01d.png", "100%/7.png"),
        ] {
            assert_eq!(name(pattern), Some(file.into()), "{pattern}");
            let pattern = Pattern::parse(Path::new(pattern)).unwrap();
            assert_eq!(pattern.number(Path::new(file)), Some(7));
            assert_eq!(pattern.number(Path::new("a/00000000007.png")), None);
        }
        for wrong in ["a.png", "%d/a.png", "%.png", "%4d.png", "%00d.png", "%020d.png", "%d%d.png", "%x.png"]
        {
            assert_eq!(name(wrong), None, "{wrong}");
        }
        assert_eq!(Pattern::parse(Path::new("%02d.png")).unwrap().path(12345), Path::new("12345.png"));
    }

    #[test]
    fn only_a_whole_file_with_the_same_mark_counts() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("0.png");
        write(&path, [2, 1], &[1, 2, 3, 4, 5, 6], "scene a").unwrap();
        let bytes = fs::read(&path).unwrap();
        assert!(is_whole(&path, "scene a") && !is_whole(&path, "scene b"));
        assert_eq!(drape::output::png::read(&path).unwrap().rgba, [[1, 2, 3, 255], [4, 5, 6, 255]]);
        for cut in 0..bytes.len() {
            fs::write(&path, &bytes[..cut]).unwrap();
            assert!(!is_whole(&path, "scene a"), "cut to {cut} of {} bytes", bytes.len());
        }
        for flipped in 0..bytes.len() {
            let mut bytes = bytes.clone();
            bytes[flipped] ^= 4;
            fs::write(&path, &bytes).unwrap();
            assert!(!is_whole(&path, "scene a"), "byte {flipped} changed");
        }
        assert!(!is_whole(&dir.path().join("none.png"), "scene a") && !is_whole(dir.path(), "scene a"));
    }
}
