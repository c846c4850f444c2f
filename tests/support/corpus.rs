//! The inputs in `fuzz/corpus/`, which fuzzing found or begins with.

use std::fs;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// Most files and bytes of a target's inputs.
const MOST: (usize, u64) = (60, 100 << 10);

/// Calls `run`, the body of the fuzz target, with every input of `target`; fails with the names of those that panic.
pub(crate) fn run_all(target: &str, run: fn(&[u8])) {
    let folder = crate::repository::path("fuzz/corpus").join(target);
    let mut files: Vec<_> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.sort();
    let bytes: u64 = files.iter().map(|file| fs::metadata(file).unwrap().len()).sum();
    assert!(
        (10..=MOST.0).contains(&files.len()) && bytes <= MOST.1,
        "{} files of {bytes} bytes",
        files.len()
    );
    files.retain(|file| {
        let bytes = fs::read(file).unwrap();
        catch_unwind(AssertUnwindSafe(|| run(&bytes))).is_err()
    });
    assert!(files.is_empty(), "{files:?}");
}
