//! A scene that is run several times, loaded anew with the changes of each run.

use std::path::PathBuf;

use drape::error::Result;
use drape::scene::{self, Overrides, Scene};

/// A scene file and changes to it.
#[derive(Clone, Debug)]
pub struct Source {
    /// The scene file.
    pub path: PathBuf,
    /// Changes from the command line; those of a run come after them.
    pub overrides: Overrides,
}

impl Source {
    /// The scene with `sets` as the last changes.
    ///
    /// # Errors
    /// As [`scene::load`].
    pub fn scene(&self, sets: &[String]) -> Result<Scene> {
        let mut overrides = self.overrides.clone();
        overrides.sets.extend_from_slice(sets);
        Ok(scene::load(&self.path, &overrides)?.scene)
    }
}
