//! What a path on the command line stands for: a file, a device or pipe, or standard output (`-`).

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use drape::error::{Error, Kind, Result};

/// The number of the signal for a pipe whose reader has closed it.
pub(crate) const SIGPIPE: u8 = 13;

/// Whether a terminal may show the content of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Content {
    /// Lines of text.
    Text,
    /// Bytes that a terminal cannot show.
    Binary,
}

/// What a path stands for once links are followed.
pub(crate) enum Target {
    /// Standard output.
    Stdout,
    /// A device or pipe, which cannot be replaced.
    Stream(PathBuf),
    /// A regular file, which may not exist yet.
    File(PathBuf),
}

/// Whether `path` stands for standard output.
pub(crate) fn is_stdout(path: &Path) -> bool {
    path.as_os_str() == "-"
}

/// Follows links and tells regular files from devices. A link to nothing names the file to make.
///
/// # Errors
/// [`Kind::Io`] when `path` is a folder or cannot be followed.
pub(crate) fn target(path: &Path) -> Result<Target> {
    if is_stdout(path) {
        return Ok(Target::Stdout);
    }
    match fs::metadata(path) {
        Ok(found) if found.is_dir() => Err(is_folder(path)),
        Ok(found) if found.is_file() => {
            fs::canonicalize(path).map(Target::File).map_err(|e| failed(path, &e))
        }
        Ok(_) => Ok(Target::Stream(path.to_path_buf())),
        Err(_) if ends_with_separator(path) => Err(is_folder(path)),
        // An endless chain of links is not reported as absent, so this recursion ends.
        Err(e) if e.kind() == io::ErrorKind::NotFound => match fs::read_link(path) {
            Ok(link) => target(&folder(path).join(link)),
            Err(_) => Ok(Target::File(path.to_path_buf())),
        },
        Err(e) => Err(failed(path, &e)),
    }
}

fn ends_with_separator(path: &Path) -> bool {
    path.as_os_str().as_encoded_bytes().last().is_some_and(|&byte| std::path::is_separator(byte.into()))
}

/// The folder that holds the file named by `path`; `.` for a bare file name.
pub(crate) fn folder(path: &Path) -> &Path {
    path.parent().filter(|parent| !parent.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

fn is_folder(path: &Path) -> Error {
    Error::new(Kind::Io, format!("cannot write `{}`: it is a folder", path.display()))
        .with_help("name a file in that folder")
}

/// The error of a temporary file that cannot be made in the system's folder for them.
pub(crate) fn no_temporary(cause: &io::Error) -> Error {
    let folder = std::env::temp_dir();
    let error =
        Error::new(Kind::Io, format!("cannot make a temporary file in `{}`: {cause}", folder.display()));
    error.with_help("set TMPDIR to a folder that exists and can be written to")
}

/// The error of a failed write. A closed pipe counts as the signal for it.
pub(crate) fn failed(path: &Path, cause: &io::Error) -> Error {
    if cause.kind() == io::ErrorKind::BrokenPipe {
        return Error::new(Kind::Signal(SIGPIPE), "the reader has closed the pipe");
    }
    let error = Error::new(Kind::Io, format!("cannot write `{}`: {cause}", path.display()));
    if !is_stdout(path) && !folder(path).exists() {
        return error.with_help(format!("the folder `{}` does not exist", folder(path).display()));
    }
    error
}
