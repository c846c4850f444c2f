//! The scene files that are built into the program: the stock scenes and the patches for pictures.

use std::path::Path;

use crate::error::{Error, Kind, Result};

/// A file of the repository: its path from there and its text.
macro_rules! files {
    ($($path:literal),* $(,)?) => {
        [$(($path, include_str!(concat!("../../", $path)))),*]
    };
}

/// The stock scenes.
pub(super) const SCENES: [(&str, &str); 6] = files![
    "scenes/pinned2.json",
    "scenes/pinned4.json",
    "scenes/sphere.json",
    "scenes/plane.json",
    "scenes/selfCollision.json",
    "scenes/table.json",
];

const PATCHES: [(&str, &str); 2] = files!["scenes/look/ball.json", "scenes/look/draped.json"];

/// The bytes of the built-in file that stands at `path` in the repository.
///
/// # Errors
/// [`Kind::Io`] when there is none.
pub(super) fn read(path: &Path) -> Result<Vec<u8>> {
    let file = SCENES.iter().chain(&PATCHES).find(|(known, _)| Path::new(known) == path);
    file.map(|(_, text)| text.as_bytes().to_vec())
        .ok_or_else(|| Error::new(Kind::Io, format!("no built-in file is called `{}`", path.display())))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_known_files_are_there() {
        assert!(read(Path::new("scenes/sphere.json")).unwrap().starts_with(b"{"));
        assert_eq!(read(Path::new("sphere.json")).unwrap_err().kind, Kind::Io);
    }
}
