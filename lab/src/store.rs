//! Finished results, one file each, named by a hash of what they depend on. A study that was stopped
//! continues where it was; after a change of the scene, the matrix, the textures or the version of the
//! program no outdated result is found. Stored times are those of the machine at the time of the run.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};

use serde::Serialize;
use serde::de::DeserializeOwned;

use drape::error::{Error, Kind, Result};
use drape::math::StateHash;

/// Writes a file as a whole or not at all.
pub type WriteFile = fn(&Path, &[u8]) -> Result<()>;

/// A folder of finished results, and how many were computed and found.
#[derive(Debug)]
pub struct Store {
    folder: PathBuf,
    write: WriteFile,
    made: AtomicU64,
    found: AtomicU64,
}

impl Store {
    /// The store in `folder`, which is created if it is missing; `write` writes its files.
    ///
    /// # Errors
    /// [`Kind::Io`] when that fails.
    pub fn new(folder: &Path, write: WriteFile) -> Result<Self> {
        fs::create_dir_all(folder).map_err(|e| {
            Error::new(Kind::Io, format!("cannot make the folder `{}`: {e}", folder.display()))
        })?;
        Ok(Self { folder: folder.to_owned(), write, made: AtomicU64::new(0), found: AtomicU64::new(0) })
    }

    /// How many runs were computed, and how many were found.
    pub fn counts(&self) -> [u64; 2] {
        [&self.made, &self.found].map(|count| count.load(Ordering::Relaxed))
    }

    /// The result of `key`, if a readable one is stored.
    pub(crate) fn get<T: DeserializeOwned>(&self, key: u64) -> Option<T> {
        serde_json::from_slice(&fs::read(self.path(key)).ok()?).ok()
    }

    /// Counts a stored result that is used.
    pub(crate) fn count_found(&self) {
        self.found.fetch_add(1, Ordering::Relaxed);
    }

    /// Stores a result that was just computed.
    ///
    /// # Errors
    /// [`Kind::Io`] when it cannot be written.
    pub(crate) fn put(&self, key: u64, result: &impl Serialize) -> Result<()> {
        self.made.fetch_add(1, Ordering::Relaxed);
        let text = serde_json::to_string(result)
            .map_err(|e| Error::new(Kind::Internal, format!("cannot write JSON: {e}")))?;
        (self.write)(&self.path(key), text.as_bytes())
    }

    fn path(&self, key: u64) -> PathBuf {
        self.folder.join(format!("{key:016x}.json"))
    }
}

/// The key of a result of a `kind`: a hash of `inputs`, all that it depends on, and of the version.
pub(crate) fn key(kind: &str, inputs: &impl std::fmt::Debug) -> u64 {
    let mut hash = StateHash::default();
    hash.write(format!("{} {kind} {inputs:?}", env!("CARGO_PKG_VERSION")).as_bytes());
    hash.finish()
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
        store.count_found();
        assert_eq!((store.get(7), store.counts()), (Some(0.3), [2, 1]));
    }
}
