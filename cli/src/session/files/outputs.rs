//! Where a command writes: checked before any long work.

use std::fs;
use std::path::{Path, PathBuf};

use super::atomic;
use super::target::{Content, folder, is_stdout};
use drape::error::{Error, Kind, Result};

/// Checks that every output can be written, that no two are the same file, and that none is an
/// input.
///
/// # Errors
/// [`Kind::Usage`] for a clash or binary content on a terminal, [`Kind::Io`] otherwise.
pub(crate) fn check<'a>(
    inputs: &[&Path],
    outputs: impl IntoIterator<Item = (&'a Path, Content)>,
) -> Result<()> {
    let read: Vec<PathBuf> = inputs.iter().map(|path| identity(path)).collect();
    let mut taken: Vec<PathBuf> = Vec::new();
    for (path, content) in outputs {
        let file = identity(path);
        if read.contains(&file) {
            let message = format!("`{}` would be read and then overwritten", path.display());
            return Err(Error::new(Kind::Usage, message).with_help("give the output a name of its own"));
        }
        if taken.contains(&file) {
            let message = format!("`{}` is named twice on the command line", path.display());
            return Err(Error::new(Kind::Usage, message).with_help("give every output its own file"));
        }
        atomic::check_writable(path, content)?;
        taken.push(file);
    }
    Ok(())
}

/// Whether one of the outputs is standard output, so that nothing else may go there.
pub(crate) fn takes_stdout(outputs: &[&Option<PathBuf>]) -> bool {
    outputs.iter().filter_map(|path| path.as_deref()).any(is_stdout)
}

/// Checks that standard output is not asked to carry bytes and text at once.
///
/// # Errors
/// [`Kind::Usage`] if it is.
pub(crate) fn check_stdout(bytes: bool, text: bool) -> Result<()> {
    if bytes && text {
        return Err(Error::new(Kind::Usage, "standard output cannot carry a file and a report")
            .with_help("name a file instead of `-`"));
    }
    Ok(())
}

/// Checks that a file name does not promise another format than `ending`.
///
/// # Errors
/// [`Kind::Usage`] if it does.
pub(crate) fn check_ending(path: &Path, ending: &str) -> Result<()> {
    match path.extension() {
        Some(other) if !other.eq_ignore_ascii_case(ending) => {
            let message = format!("`{}` does not end in .{ending}", path.display());
            Err(Error::new(Kind::Usage, message).with_help(format!("only .{ending} files are written here")))
        }
        _ => Ok(()),
    }
}

/// Makes the folder `path` and those around it, if they are not there.
///
/// # Errors
/// [`Kind::Io`] when it cannot be made.
pub(crate) fn make_folder(path: &Path) -> Result<()> {
    fs::create_dir_all(path)
        .map_err(|e| Error::new(Kind::Io, format!("cannot make the folder `{}`: {e}", path.display())))
}

/// A path that two names of one file share, if the file or its folder is there.
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

    #[test]
    fn clashes_are_found_under_any_name() {
        let dir = tempfile::tempdir().unwrap();
        let scene = dir.path().join("scene.json");
        fs::write(&scene, "{}").unwrap();
        let other = |name: &str| dir.path().join(name);
        let kind = |outputs: &[&Path]| {
            check(&[&scene], outputs.iter().map(|&path| (path, Content::Text))).map_err(|e| e.kind)
        };
        assert_eq!(kind(&[&other("a"), &other("b")]), Ok(()));
        assert_eq!(kind(&[&other("a"), &other("./a")]), Err(Kind::Usage));
        assert_eq!(kind(&[&other("./scene.json")]), Err(Kind::Usage));
        assert_eq!(kind(&[Path::new("-"), Path::new("-")]), Err(Kind::Usage));
        assert_eq!(kind(&[&other("no/a")]), Err(Kind::Io));
    }
}
