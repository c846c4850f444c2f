//! What the measurements promise; `tests/README.md` has a line for each file.

#![allow(
    clippy::unwrap_used,
    clippy::cast_possible_truncation,
    reason = "a test may panic, and numbers are small"
)]

mod choose;
mod corpora;
#[path = "../support/corpus.rs"]
mod corpus;
mod findings;
mod grader;
mod horizon;
mod random_scenes;
#[path = "../support/repository.rs"]
mod repository;
mod samples;
mod stability_map;
mod study;

/// Writes a file of a store.
fn write(path: &std::path::Path, bytes: &[u8]) -> drape::error::Result<()> {
    std::fs::write(path, bytes).unwrap();
    Ok(())
}
