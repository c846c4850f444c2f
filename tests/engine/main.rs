//! What the engine promises, a folder a subject; `tests/README.md` has a line for each file.

#![allow(
    clippy::unwrap_used,
    clippy::cast_possible_truncation,
    reason = "a test may panic, and numbers are small"
)]

mod cloth;
mod contact;
mod corpora;
#[path = "../support/corpus.rs"]
mod corpus;
mod dependencies;
mod gl;
mod integrators;
mod layers;
mod output;
mod pages;
mod promises;
mod raster;
mod render;
#[path = "../support/repository.rs"]
mod repository;
mod scene;
#[path = "../support/scenes/mod.rs"]
mod scenes;
mod shader;
mod states;
mod support;
#[path = "../../examples/textbook_cloth.rs"]
mod textbook_cloth;
mod textures;
