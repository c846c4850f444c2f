//! A PNG file for each picture.
//!
//! Each is the file that `render` writes of the same moment. It says of what it is, so that a later run keeps the
//! pictures of the same scene and draws the others again.

use std::fs;
use std::path::{Path, PathBuf};

use super::pattern::Pattern;
use crate::session::files::atomic;
use drape::bounded;
use drape::error::{Error, Kind, Result};
use drape::math::StateHash;
use drape::output::png::{self, Effort, Pixels};
use drape::output::provenance::{Arguments, Provenance, hex};
use drape::render::Picture;

/// Numbered pictures, some of which may be there from an earlier run.
pub(crate) struct Sequence<'a> {
    pub(crate) pattern: &'a Pattern,
    /// What every picture says of itself, but for its frame and hashes.
    pub(crate) provenance: Provenance,
    /// Width and height.
    pub(crate) size: [u32; 2],
}

impl Sequence<'_> {
    /// Whether picture `number` is there, complete, and shows `frame` of the same scene.
    pub(crate) fn has(&self, number: u64, frame: u64) -> bool {
        let there = whole(&self.pattern.path(number), self.size);
        there.is_some_and(|there| there.is_like(&self.of(frame)))
    }

    /// Removes the pictures from number `count` on that an earlier, longer run has left; returns those files that
    /// have such a name and are not of this program.
    ///
    /// # Errors
    /// [`Kind::Io`] when one cannot be removed.
    pub(crate) fn remove_from(&self, count: u64) -> Result<Vec<PathBuf>> {
        let late = self.pattern.files().into_iter().filter(|(number, _)| *number >= count);
        let (own, others): (Vec<PathBuf>, Vec<PathBuf>) =
            late.map(|(_, path)| path).partition(|path| said(path).is_some());
        for path in own {
            fs::remove_file(&path).map_err(|e| {
                Error::new(Kind::Io, format!("cannot remove `{}` of an earlier run: {e}", path.display()))
            })?;
        }
        Ok(others)
    }

    /// Writes picture `number`, which shows `frame`, whose state has the hash `state`.
    ///
    /// # Errors
    /// As [`atomic::write`].
    pub(crate) fn write(&self, number: u64, frame: u64, state: u64, picture: &Picture) -> Result<()> {
        let texts = self.of(frame).of_picture(state, picture.hash()).texts();
        let bytes = png::encode_with(picture.width, picture.height, &picture.rgb, Effort::Fast, &texts)?;
        atomic::write(&self.pattern.path(number), &bytes)
    }

    /// What the picture of `frame` says of itself.
    fn of(&self, frame: u64) -> Provenance {
        let arguments = Arguments { frame: Some(frame), ..self.provenance.arguments.clone() };
        Provenance { arguments, ..self.provenance.clone() }
    }
}

/// What a picture says of itself, if it is whole to its last byte, of this size, and has the colours that it says.
fn whole(path: &Path, size: [u32; 2]) -> Option<Provenance> {
    let provenance = said(path)?;
    let Pixels { width, height, rgba } = png::read(path).ok()?;
    let mut hash = StateHash::default();
    rgba.iter().for_each(|[rgb @ .., _]| hash.write(rgb));
    if [width, height] != size || provenance.picture != Some(hex(hash.finish())) {
        return None;
    }
    bounded::read(path, bounded::MOST).ok()?.ends_with(b"IEND\xAE\x42\x60\x82").then_some(provenance)
}

/// What a picture of this program says of itself.
fn said(path: &Path) -> Option<Provenance> {
    Provenance::from_texts(&png::texts(&bounded::read(path, bounded::MOST).ok()?).ok()?).ok()?
}

#[cfg(test)]
mod tests {
    use super::*;
    use drape::raster::Stats;

    #[test]
    fn only_a_complete_file_of_the_same_frame_and_scene_counts() {
        let dir = tempfile::tempdir().unwrap();
        let pattern = Pattern::parse(&dir.path().join("%d.png")).unwrap().unwrap();
        let path = pattern.path(0);
        let of = |scene: &str| Provenance { scene: scene.to_owned(), ..Provenance::default() };
        let [a, b] =
            ["a", "b"].map(|scene| Sequence { pattern: &pattern, provenance: of(scene), size: [2, 1] });
        let (rgb, depth, stats) = (vec![1, 2, 3, 4, 5, 6], vec![0.0; 2], Stats::default());
        let picture = Picture { width: 2, height: 1, rgb, depth, ids: Vec::new(), stats };
        a.write(0, 7, 1, &picture).unwrap();
        let bytes = fs::read(&path).unwrap();
        let larger = Sequence { pattern: &pattern, provenance: of("a"), size: [2, 2] };
        assert!(!larger.has(0, 7), "of another size");
        assert!(a.has(0, 7) && !a.has(0, 8) && !a.has(1, 7) && !b.has(0, 7));
        assert_eq!(png::read(&path).unwrap().rgba, [[1, 2, 3, 255], [4, 5, 6, 255]]);
        for cut in 0..bytes.len() {
            fs::write(&path, &bytes[..cut]).unwrap();
            assert!(!a.has(0, 7), "cut to {cut} of {} bytes", bytes.len());
        }
        for flipped in 0..bytes.len() {
            let mut bytes = bytes.clone();
            bytes[flipped] ^= 4;
            fs::write(&path, &bytes).unwrap();
            assert!(!a.has(0, 7), "byte {flipped} changed");
        }
        let texts = a.of(7).of_picture(1, picture.hash()).texts();
        fs::write(&path, png::encode_with(2, 1, &[9; 6], Effort::Fast, &texts).unwrap()).unwrap();
        assert!(!a.has(0, 7), "other colours under the same words");
        fs::remove_file(&path).unwrap();
        fs::create_dir(&path).unwrap();
        assert!(!a.has(0, 7));
    }
}
