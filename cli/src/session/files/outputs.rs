//! Checks of what a command will write, before any long work.

use std::fs;
use std::path::{Path, PathBuf};

use super::atomic;
use super::target::{Content, folder, is_stdout};
use drape::error::{Error, Kind, Result};

/// Checks that every output can be written, that no two are the same file, and that none is an input.
///
/// # Errors
/// [`Kind::Usage`] for a clash, or binary content on a terminal; [`Kind::Io`] otherwise.
pub(crate) fn check<'a>(
    inputs: &[PathBuf],
    outputs: impl IntoIterator<Item = (&'a Path, Content)>,
) -> Result<()> {
    let read: Vec<PathBuf> = inputs.iter().map(|path| identity(path)).collect();
    let mut taken: Vec<PathBuf> = Vec::new();
    for (path, content) in outputs {
        let file = identity(path);
        if read.contains(&file) {
            let message = format!("the output `{}` is also an input", path.display());
            return Err(Error::new(Kind::Usage, message).with_help("name another file for the output"));
        }
        if taken.contains(&file) {
            let message = format!("`{}` is named for two outputs", path.display());
            return Err(Error::new(Kind::Usage, message).with_help("name a file for each output"));
        }
        atomic::check_writable(path, content)?;
        taken.push(file);
    }
    Ok(())
}

/// Whether one of the outputs is standard output.
pub(crate) fn takes_stdout(outputs: &[&Option<PathBuf>]) -> bool {
    outputs.iter().filter_map(|path| path.as_deref()).any(is_stdout)
}

/// Checks that standard output is not used for both a file and a printed result.
///
/// # Errors
/// [`Kind::Usage`] if it is.
pub(crate) fn check_stdout(bytes: bool, text: bool) -> Result<()> {
    if bytes && text {
        return Err(Error::new(
            Kind::Usage,
            "standard output cannot carry both the file `-` and the printed result",
        )
        .with_help("name a file instead of `-`, or leave out --json and other options that print"));
    }
    Ok(())
}

/// Checks that a file name has no ending, or `ending`.
///
/// # Errors
/// [`Kind::Usage`] if it does.
pub(crate) fn check_ending(path: &Path, ending: &str) -> Result<()> {
    match path.extension() {
        Some(other) if !other.eq_ignore_ascii_case(ending) => {
            let message = format!("`{}` does not end in .{ending}", path.display());
            Err(Error::new(Kind::Usage, message).with_help(format!("name a .{ending} file")))
        }
        _ => Ok(()),
    }
}

/// Creates the folder `path` and its parents, where they are missing.
///
/// # Errors
/// [`Kind::Io`] when it cannot be created.
pub(crate) fn make_folder(path: &Path) -> Result<()> {
    fs::create_dir_all(path)
        .map_err(|e| Error::new(Kind::Io, format!("cannot create the folder `{}`: {e}", path.display())))
}

/// A path that is the same for all names of one file, if the file or its folder exists.
fn identity(path: &Path) -> PathBuf {
    let in_folder = || Some(fs::canonicalize(folder(path)).ok()?.join(path.file_name()?));
    if is_stdout(path) {
        return path.to_path_buf();
    }
    fs::canonicalize(path).ok().or_else(in_folder).unwrap_or_else(|| path.to_path_buf())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::slice;

    #[test]
    fn clashes_are_found_under_any_name() {
        let dir = tempfile::tempdir().unwrap();
        let scene = dir.path().join("scene.json");
        fs::write(&scene, "{}").unwrap();
        let other = |name: &str| dir.path().join(name);
        let kind = |outputs: &[&Path]| {
            check(slice::from_ref(&scene), outputs.iter().map(|&path| (path, Content::Text)))
                .map_err(|e| e.kind)
        };
        assert_eq!(kind(&[&other("a"), &other("b")]), Ok(()));
        assert_eq!(kind(&[&other("a"), &other("./a")]), Err(Kind::Usage));
        assert_eq!(kind(&[&other("./scene.json")]), Err(Kind::Usage));
        assert_eq!(kind(&[Path::new("-"), Path::new("-")]), Err(Kind::Usage));
        assert_eq!(kind(&[&other("no/a")]), Err(Kind::Io));
    }
}
