//! Files that belong to results, such as pictures: they stand beside them, and the result has the hash of their bytes.

use serde::{Deserialize, Serialize};

use super::{Address, Entry, Store, checksum};
use drape::bounded;
use drape::error::Result;

/// A result that is a file alone.
#[derive(Serialize, Deserialize)]
struct Alone {
    /// The hash of the file's bytes.
    file: String,
}

impl Store {
    /// Writes the file with this `ending` that belongs to the result at `key`, which is put after it; returns the hash
    /// of its bytes.
    ///
    /// # Errors
    /// [`drape::error::Kind::Io`] when it cannot be written.
    pub(crate) fn attach(&self, key: Address, ending: &str, bytes: &[u8]) -> Result<String> {
        self.write(&self.beside(key, ending), bytes)?;
        Ok(checksum(bytes))
    }

    /// The bytes of a file that belongs to the result at `key`, if they have this hash.
    pub(crate) fn attached(&self, key: Address, ending: &str, hash: &str) -> Option<Vec<u8>> {
        bounded::read(&self.beside(key, ending), bounded::MOST).ok().filter(|bytes| checksum(bytes) == hash)
    }

    /// Stores a result that is a file alone.
    ///
    /// # Errors
    /// As [`Store::attach`] and [`Store::put`].
    pub(crate) fn put_file(&self, key: Address, ending: &str, bytes: &[u8]) -> Result<()> {
        let file = self.attach(key, ending, bytes)?;
        self.put(key, &Alone { file })
    }

    /// What `read` reads in the file that is the result at `key`, if it is there; notes a damaged one.
    pub(crate) fn get_file<T>(
        &self,
        key: Address,
        ending: &str,
        read: impl FnOnce(&[u8]) -> Result<T>,
    ) -> Option<T> {
        let entry = match self.read::<Alone>(key) {
            Entry::Whole(Alone { file }) => {
                let bytes = self.attached(key, ending, &file);
                bytes.and_then(|bytes| read(&bytes).ok()).map_or(Entry::Damaged, Entry::Whole)
            }
            Entry::Missing => Entry::Missing,
            Entry::Damaged => Entry::Damaged,
        };
        self.whole(key, entry)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::store::{WriteFile, key};
    use std::fs;

    #[test]
    fn a_file_is_a_result_while_its_bytes_are_those_that_were_written() {
        let folder = tempfile::tempdir().unwrap();
        let write: WriteFile = |path, bytes| {
            fs::write(path, bytes).unwrap();
            Ok(())
        };
        let store = Store::new(folder.path(), write).unwrap();
        let key = key("test", &1);
        let get = || store.get_file(key, ".bin", |bytes| Ok(bytes.to_vec()));
        assert_eq!((get(), store.take_damaged().len()), (None, 0));
        store.put_file(key, ".bin", b"one").unwrap();
        assert_eq!((get(), store.take_damaged().len()), (Some(b"one".to_vec()), 0));
        let file = store.beside(key, ".bin");
        for damage in [&b"onf"[..], b"on", b""] {
            fs::write(&file, damage).unwrap();
            assert_eq!((get(), store.take_damaged()), (None, vec![store.path(key)]), "{damage:?}");
        }
        fs::remove_file(&file).unwrap();
        assert_eq!((get(), store.take_damaged().len(), store.take_damaged().len()), (None, 1, 0));
    }
}
