//! What the process would leave behind if it ended at once: temporary files, and programs that it runs. Its normal
//! end drops their owners; an end in the middle calls [`remove`].

use std::collections::BTreeMap;
use std::fs;
use std::path::PathBuf;
use std::process::Child;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// One thing to remove.
#[derive(Debug)]
pub(crate) enum Leftover {
    /// A temporary file.
    File(PathBuf),
    /// A program that runs.
    Program(Arc<Mutex<Child>>),
}

/// Keeps an entry in the list until it is dropped.
#[derive(Debug)]
pub(crate) struct Listed(u64);

/// The list, and the number of its next entry.
static LIST: Mutex<(u64, BTreeMap<u64, Leftover>)> = Mutex::new((0, BTreeMap::new()));

/// Enters `leftover` into the list.
pub(crate) fn list(leftover: Leftover) -> Listed {
    let mut guard = locked(&LIST);
    let (next, entries) = &mut *guard;
    *next += 1;
    entries.insert(*next, leftover);
    Listed(*next)
}

/// Removes everything that is listed, since the process ends now.
pub(crate) fn remove() {
    // Programs first: one that still runs could write its file again.
    let mut entries: Vec<_> = std::mem::take(&mut locked(&LIST).1).into_values().collect();
    entries.sort_by_key(|entry| matches!(entry, Leftover::File(_)));
    for entry in entries {
        // What is gone already needs no removal, and there is no one left to be told of the rest.
        let _ = match entry {
            Leftover::File(path) => fs::remove_file(path),
            Leftover::Program(child) => locked(&child).kill(),
        };
    }
}

impl Drop for Listed {
    fn drop(&mut self) {
        locked(&LIST).1.remove(&self.0);
    }
}

/// The content of a lock. It is poisoned only by a panic, after which its content still holds.
pub(crate) fn locked<T>(lock: &Mutex<T>) -> MutexGuard<'_, T> {
    lock.lock().unwrap_or_else(PoisonError::into_inner)
}
