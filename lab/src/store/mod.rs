//! Finished results, one file each, named by a hash of what they depend on.
//!
//! Work that was stopped continues where it was, and any number of workers may share a folder: a result appears
//! whole or not at all, and whoever computes one writes the same bytes. After a change of the scene, the settings, the
//! textures or the version of the program no outdated result is found. Stored times are those of the machine at the
//! time of the run.
//!
//! A file has the result as a line of JSON and, as a second line, the hash of the first. The folder has
//! subfolders by the first two digits of the names, so that none has too many files.
//!
//! A *claim* says that a worker has begun a result. It is only a hint, so that others begin elsewhere: work that
//! ignores claims is right too, and a claim whose worker is gone loses nothing.

mod address;
mod attached;

use std::fs::{self, File};
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Mutex, PoisonError};

use serde::Serialize;
use serde::de::DeserializeOwned;

pub use address::Address;
use drape::bounded;
use drape::error::{Error, Kind, Result};
use drape::math::StateHash;

/// Writes a file as a whole or not at all.
pub type WriteFile = fn(&Path, &[u8]) -> Result<()>;

/// The ending of the files of results.
const ENDING: &str = ".jsonl";

/// A folder of finished results, and how many were computed, found, and found damaged.
#[derive(Debug)]
pub struct Store {
    folder: PathBuf,
    write: WriteFile,
    made: AtomicU64,
    found: AtomicU64,
    damaged: Mutex<Vec<PathBuf>>,
}

/// What the store has of a result.
#[derive(Clone, Debug, PartialEq)]
pub enum Entry<T> {
    /// No file.
    Missing,
    /// A file that is not whole, or was changed.
    Damaged,
    /// The result.
    Whole(T),
}

impl Store {
    /// The store in `folder`, which is created if it is missing; `write` writes its files.
    ///
    /// # Errors
    /// [`Kind::Io`] when that fails.
    pub fn new(folder: &Path, write: WriteFile) -> Result<Self> {
        make_folder(folder)?;
        let [made, found] = [0, 0].map(AtomicU64::new);
        Ok(Self { folder: folder.to_owned(), write, made, found, damaged: Mutex::default() })
    }

    /// How many results were computed, and how many were found.
    pub fn counts(&self) -> [u64; 2] {
        [&self.made, &self.found].map(|count| count.load(Ordering::Relaxed))
    }

    /// The files of damaged results that were asked for since the last call, each of which is to be made again.
    pub fn take_damaged(&self) -> Vec<PathBuf> {
        std::mem::take(&mut self.damaged.lock().unwrap_or_else(PoisonError::into_inner))
    }

    /// The result at `key`, if a whole one is stored; notes a damaged one.
    pub(crate) fn get<T: DeserializeOwned>(&self, key: Address) -> Option<T> {
        self.whole(key, self.read(key))
    }

    /// The result in the entry at `key`, if it is whole; notes a damaged one.
    fn whole<T>(&self, key: Address, entry: Entry<T>) -> Option<T> {
        match entry {
            Entry::Whole(result) => Some(result),
            Entry::Missing => None,
            Entry::Damaged => {
                self.damaged.lock().unwrap_or_else(PoisonError::into_inner).push(self.path(key));
                None
            }
        }
    }

    /// What is stored at `key`.
    pub(crate) fn read<T: DeserializeOwned>(&self, key: Address) -> Entry<T> {
        match bounded::read_text(&self.path(key), bounded::MOST) {
            Ok(text) => decode(&text).map_or(Entry::Damaged, Entry::Whole),
            Err(e) if e.kind() == ErrorKind::NotFound => Entry::Missing,
            Err(_) => Entry::Damaged,
        }
    }

    /// Whether there is a file for the result at `key`.
    pub(crate) fn has(&self, key: Address) -> bool {
        self.path(key).exists()
    }

    /// Counts a stored result that is used.
    pub(crate) fn count_found(&self) {
        self.found.fetch_add(1, Ordering::Relaxed);
    }

    /// Stores a result that was just computed.
    ///
    /// # Errors
    /// [`Kind::Io`] when it cannot be written.
    pub(crate) fn put(&self, key: Address, result: &impl Serialize) -> Result<()> {
        self.made.fetch_add(1, Ordering::Relaxed);
        let line = serde_json::to_string(result)
            .map_err(|e| Error::new(Kind::Internal, format!("cannot write JSON: {e}")))?;
        self.write(&self.path(key), format!("{line}\n\"{}\"\n", checksum(line.as_bytes())).as_bytes())
    }

    /// Writes a file into the store, whole or not at all; its folder is created if it is missing.
    fn write(&self, path: &Path, bytes: &[u8]) -> Result<()> {
        path.parent().map_or(Ok(()), make_folder)?;
        (self.write)(path, bytes)
    }

    /// The result at `key`, or what `make` makes, which is put there.
    ///
    /// # Errors
    /// Those of `make`, and as [`Store::put`].
    pub(crate) fn kept<T: Serialize + DeserializeOwned>(
        &self,
        key: Address,
        make: impl FnOnce() -> Result<T>,
    ) -> Result<T> {
        if let Some(found) = self.get(key) {
            self.count_found();
            return Ok(found);
        }
        let made = make()?;
        self.put(key, &made)?;
        Ok(made)
    }

    /// How many results there are.
    ///
    /// # Errors
    /// [`Kind::Io`] when the folder cannot be read.
    pub fn count(&self) -> Result<u64> {
        let mut count = 0;
        for folder in list(&self.folder)?.filter(|name| name.len() == 2) {
            count += list(&self.folder.join(folder))?.filter(|name| name.ends_with(ENDING)).count() as u64;
        }
        Ok(count)
    }

    /// Claims the result at `key`; false if another worker has.
    ///
    /// # Errors
    /// [`Kind::Io`] when that cannot be written.
    pub(crate) fn claim(&self, key: Address) -> Result<bool> {
        let path = self.claim_path(key);
        path.parent().map_or(Ok(()), make_folder)?;
        match File::create_new(&path) {
            Ok(_) => Ok(true),
            Err(e) if e.kind() == ErrorKind::AlreadyExists => Ok(false),
            Err(e) => Err(Error::new(Kind::Io, format!("cannot write `{}`: {e}", path.display()))),
        }
    }

    /// Takes a claim back, whoever made it: the result is there.
    pub(crate) fn release(&self, key: Address) {
        // A claim that stays says nothing about a result that is there.
        let _ = fs::remove_file(self.claim_path(key));
    }

    /// The file beside the result at `key` with another ending.
    fn beside(&self, key: Address, ending: &str) -> PathBuf {
        let name = key.to_string();
        self.folder.join(name.get(..2).unwrap_or_default()).join(name + ending)
    }

    fn path(&self, key: Address) -> PathBuf {
        self.beside(key, ENDING)
    }

    fn claim_path(&self, key: Address) -> PathBuf {
        self.folder.join("claims").join(key.to_string())
    }
}

/// The result in the text of a file.
fn decode<T: DeserializeOwned>(text: &str) -> Option<T> {
    let (line, rest) = text.split_once('\n')?;
    let whole = rest.strip_suffix('\n')?.trim_matches('"') == checksum(line.as_bytes());
    serde_json::from_str(line).ok().filter(|_| whole)
}

/// The hash of `bytes` in hexadecimal digits.
fn checksum(bytes: &[u8]) -> String {
    let mut hash = StateHash::default();
    hash.write(bytes);
    format!("{:016x}", hash.finish())
}

fn make_folder(folder: &Path) -> Result<()> {
    fs::create_dir_all(folder)
        .map_err(|e| Error::new(Kind::Io, format!("cannot make the folder `{}`: {e}", folder.display())))
}

/// The names in a folder.
fn list(folder: &Path) -> Result<impl Iterator<Item = String>> {
    let entries = fs::read_dir(folder)
        .map_err(|e| Error::new(Kind::Io, format!("cannot read the folder `{}`: {e}", folder.display())))?;
    Ok(entries.filter_map(|entry| entry.ok()?.file_name().into_string().ok()))
}

/// The address of a result of a `kind`: a hash of `inputs`, all that it depends on, and of the version.
pub(crate) fn key(kind: &str, inputs: &impl std::fmt::Debug) -> Address {
    Address::of(kind, &format!("{inputs:?}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn store(folder: &Path) -> Store {
        let write: WriteFile = |path, bytes| {
            fs::write(path, bytes).unwrap();
            Ok(())
        };
        Store::new(&folder.join("cells"), write).unwrap()
    }

    #[test]
    fn a_result_is_kept_and_a_broken_file_is_no_result() {
        let folder = tempfile::tempdir().unwrap();
        let store = store(folder.path());
        let [one, other] = [7, 8].map(|n| key("test", &n));
        store.put(one, &0.1).unwrap();
        assert_eq!([store.read::<f64>(one), store.read(other)], [Entry::Whole(0.1), Entry::Missing]);
        let bytes = fs::read(store.path(one)).unwrap();
        for cut in 0..bytes.len() {
            fs::write(store.path(one), &bytes[..cut]).unwrap();
            assert_eq!(store.read::<f64>(one), Entry::Damaged, "cut to {cut} bytes");
        }
        for changed in 0..bytes.len() {
            let mut bytes = bytes.clone();
            bytes[changed] ^= 4;
            fs::write(store.path(one), &bytes).unwrap();
            assert_eq!(
                (store.read::<f64>(one), store.get::<f64>(one)),
                (Entry::Damaged, None),
                "byte {changed}"
            );
        }
        store.put(one, &0.3).unwrap();
        store.count_found();
        assert_eq!((store.get(one), store.counts(), store.count()), (Some(0.3), [2, 1], Ok(1)));
    }

    #[test]
    fn a_claim_is_made_once_until_it_is_taken_back() {
        let folder = tempfile::tempdir().unwrap();
        let store = store(folder.path());
        let one = key("test", &1);
        assert_eq!(
            [store.claim(one), store.claim(one), store.claim(key("test", &2))],
            [Ok(true), Ok(false), Ok(true)]
        );
        store.release(one);
        assert_eq!((store.claim(one), store.count()), (Ok(true), Ok(0)));
    }
}
