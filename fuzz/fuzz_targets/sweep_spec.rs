#![no_main]

#[path = "../bodies/sweep_spec.rs"]
mod sweep_spec;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| sweep_spec::run(bytes));
