//! The mask: which pixels are compared.

use std::path::Path;

use drape::error::{Error, Kind, Result};
use drape::output::compare::Difference;
use drape::output::png::{self, Pixels};

/// A picture in which black pixels stand for what is left out.
pub(super) struct Mask {
    name: String,
    picture: Pixels,
}

impl Mask {
    /// Reads a PNG.
    ///
    /// # Errors
    /// [`Kind::Io`] when it cannot be read; [`Kind::Nothing`] when it leaves out everything.
    pub(super) fn read(path: &Path) -> Result<Self> {
        let mask = Self { name: path.display().to_string(), picture: png::read(path)? };
        if !(0..mask.picture.rgba.len()).any(|i| mask.counts(i)) {
            let message = format!("the mask `{}` is all black: no pixel is left to compare", mask.name);
            return Err(Error::new(Kind::Nothing, message).with_help("white marks what is compared"));
        }
        Ok(mask)
    }

    /// Whether pixel `i` is compared.
    fn counts(&self, i: usize) -> bool {
        self.picture.rgba[i][..3] != [0; 3]
    }

    /// The difference of two pictures where the mask is not black.
    ///
    /// # Errors
    /// [`Kind::Usage`] when the mask has another size.
    pub(super) fn difference(&self, [a, b]: &[Pixels; 2]) -> Result<Difference> {
        let Pixels { width, height, .. } = self.picture;
        if let Some(other) = [a, b].into_iter().find(|other| (other.width, other.height) != (width, height)) {
            let message = format!(
                "the mask `{}` has {width} x {height} pixels, and a picture {} x {}",
                self.name, other.width, other.height
            );
            return Err(Error::new(Kind::Usage, message).with_help("a mask has the size of the pictures"));
        }
        Ok(Difference::between_where(a, b, |i| self.counts(i)))
    }
}
