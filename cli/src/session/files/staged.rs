//! A file that is written piece by piece and appears when it is complete.

use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};

use super::atomic;
use super::target::{Target, failed, no_temporary, target};
use super::temporary::Temporary;
use drape::error::Result;

/// A temporary file that [`Staged::finish`] renames to its place; dropped before that, it is removed.
#[derive(Debug)]
pub(crate) struct Staged {
    path: PathBuf,
    temporary: Temporary,
}

impl Staged {
    /// A temporary file for `path`, whose present content stays until [`Staged::finish`].
    ///
    /// # Errors
    /// As [`atomic::write`].
    pub(crate) fn create(path: &Path) -> Result<Self> {
        let temporary = match target(path)? {
            Target::File(file) => Temporary::beside(&file).map_err(|e| failed(path, &e))?,
            Target::Stdout | Target::Stream(_) => {
                Temporary::in_system_folder().map_err(|e| no_temporary(&e))?
            }
        };
        Ok(Self { path: path.to_path_buf(), temporary })
    }

    /// The file to write to.
    ///
    /// # Errors
    /// [`Kind::Io`](drape::error::Kind::Io) when it cannot be opened again.
    pub(crate) fn file(&self) -> Result<File> {
        self.temporary.reopen().map_err(|e| self.failed(&e))
    }

    /// The path of the temporary file, for another program to write to.
    pub(crate) fn temporary(&self) -> &Path {
        self.temporary.path()
    }

    /// The error of a failed write to [`Staged::file`].
    pub(crate) fn failed(&self, cause: &io::Error) -> drape::error::Error {
        failed(&self.path, cause)
    }

    /// Renames the file to its place.
    ///
    /// # Errors
    /// As [`atomic::write`].
    pub(crate) fn finish(self) -> Result<()> {
        let Self { path, temporary } = self;
        let Target::File(file) = target(&path)? else {
            let bytes = fs::read(temporary.path()).map_err(|e| failed(&path, &e))?;
            return atomic::write(&path, &bytes);
        };
        temporary.persist(&file).map_err(|e| failed(&path, &e))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::Write;

    #[test]
    fn a_file_appears_whole_or_not_at_all() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("out");
        fs::write(&path, "old").unwrap();
        for finishes in [false, true] {
            let staged = Staged::create(&path).unwrap();
            staged.file().unwrap().write_all(b"new").unwrap();
            assert_eq!(fs::read(&path).unwrap(), b"old");
            if finishes {
                staged.finish().unwrap();
            } else {
                drop(staged);
            }
            assert_eq!(fs::read_dir(dir.path()).unwrap().count(), 1, "no temporary file stays");
        }
        assert_eq!(fs::read(&path).unwrap(), b"new");
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn a_device_gets_the_bytes() {
        let staged = Staged::create(Path::new("/dev/full")).unwrap();
        staged.file().unwrap().write_all(b"x").unwrap();
        assert_eq!(staged.finish().unwrap_err().kind, drape::error::Kind::Io);
    }
}
