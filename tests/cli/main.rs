//! What the program `drape` promises; `tests/README.md` has a line for each file.

#![allow(
    clippy::unwrap_used,
    clippy::cast_possible_truncation,
    reason = "a test may panic, and numbers are small"
)]

mod animate;
mod binary;
mod browser;
mod comparing;
mod checking;
mod choose;
mod contact;
mod damaged;
mod disk;
mod docs;
mod errors;
mod everywhere;
mod extremes;
mod faults;
mod files;
mod films;
mod gallery;
mod golden;
mod goldens;
mod injected;
mod killed;
mod limits;
mod live;
#[path = "../support/mistakes.rs"]
mod mistakes;
mod outside_text;
mod pages;
mod parts;
mod positions;
mod provenance;
mod readers;
mod readme;
#[path = "../support/repository.rs"]
mod repository;
mod results;
mod scratch;
mod sequences;
mod signals;
mod simulating;
mod states;
mod sweep;
mod sweep_spec;
#[path = "../../examples/textbook_cloth.rs"]
mod textbook_cloth;
mod texts;
mod threads;
mod unread;
mod verify;
mod without_effect;
