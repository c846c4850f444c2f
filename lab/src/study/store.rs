//! Finished results, one file each, named by what they depend on: a study that was stopped goes on
//! where it was, and one whose scene, matrix or textures have changed, or the version of the program,
//! finds nothing that is out of date. Times are those of the machine as it was then.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};

use serde::Serialize;
use serde::de::DeserializeOwned;

use drape::error::{Error, Kind, Result};

/// Writes a file as a whole or not at all.
pub type WriteFile = fn(&Path, &[u8]) -> Result<()>;

/// A folder of finished results, and how many were made and found.
#[derive(Debug)]
pub struct Store {
    folder: PathBuf,
    write: WriteFile,
    made: AtomicU64,
    found: AtomicU64,
}

impl Store {
    /// The store in `folder`, which is made if it is not there; `write` writes its files.
    ///
    /// # Errors
    /// [`Kind::Io`] when that fails.
    pub fn new(folder: &Path, write: WriteFile) -> Result<Self> {
        fs::create_dir_all(folder).map_err(|e| {
            Error::new(Kind::Io, format!("cannot make the folder `{}`: {e}", folder.display()))
        })?;
        Ok(Self { folder: folder.to_owned(), write, made: AtomicU64::new(0), found: AtomicU64::new(0) })
    }

    /// How many runs were made, and how many results were found.
    pub fn counts(&self) -> [u64; 2] {
        [&self.made, &self.found].map(|count| count.load(Ordering::Relaxed))
    }

    /// The result called `key`, if a readable one is kept.
    pub(super) fn get<T: DeserializeOwned>(&self, key: u64) -> Option<T> {
        serde_json::from_slice(&fs::read(self.path(key)).ok()?).ok()
    }

    /// Notes that a kept result was used.
    pub(super) fn note_found(&self) {
        self.found.fetch_add(1, Ordering::Relaxed);
    }

    /// Keeps a result that was just made.
    ///
    /// # Errors
    /// [`Kind::Io`] when it cannot be written.
    pub(super) fn put(&self, key: u64, result: &impl Serialize) -> Result<()> {
        self.made.fetch_add(1, Ordering::Relaxed);
        let text = serde_json::to_string(result)
            .map_err(|e| Error::new(Kind::Internal, format!("cannot write JSON: {e}")))?;
        (self.write)(&self.path(key), text.as_bytes())
    }

    fn path(&self, key: u64) -> PathBuf {
        self.folder.join(format!("{key:016x}.json"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_result_is_kept_and_a_broken_file_is_no_result() {
        let folder = tempfile::tempdir().unwrap();
        let store = Store::new(&folder.path().join("cells"), |path, bytes| {
            fs::write(path, bytes).unwrap();
            Ok(())
        })
        .unwrap();
        store.put(7, &0.1).unwrap();
        assert_eq!([store.get::<f64>(7), store.get(8)], [Some(0.1), None]);
        fs::write(store.path(7), "{").unwrap();
        assert_eq!(store.get::<f64>(7), None);
        store.put(7, &0.3).unwrap();
        store.note_found();
        assert_eq!((store.get(7), store.counts()), (Some(0.3), [2, 1]));
    }
}
