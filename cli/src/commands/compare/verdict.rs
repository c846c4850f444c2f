//! What all comparisons share: names, and the error of a difference.

use std::path::Path;

use drape::error::{Error, Kind, Result};

/// A path as it is printed.
pub(super) fn shown(path: impl AsRef<Path>) -> String {
    path.as_ref().display().to_string()
}

/// An error of [`Kind::Difference`], unless `same`.
pub(super) fn verdict(same: bool, message: impl Fn() -> String) -> Result<()> {
    if same { Ok(()) } else { Err(Error::new(Kind::Difference, message())) }
}
