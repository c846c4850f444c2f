#![no_main]

#[path = "../bodies/positions.rs"]
mod positions;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| positions::run(bytes));
