//! Where the repository is, for the tests of every crate in it.

use std::path::{Path, PathBuf};

/// A file or folder of the repository, whose top holds `Cargo.lock`.
pub(crate) fn path(name: &str) -> PathBuf {
    let package = Path::new(env!("CARGO_MANIFEST_DIR"));
    let top = package.ancestors().find(|folder| folder.join("Cargo.lock").exists());
    top.unwrap_or(package).join(name)
}
