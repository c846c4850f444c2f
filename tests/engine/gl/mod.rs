//! Pictures against a real GL driver.

mod harness;
mod parity;
