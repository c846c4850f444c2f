#![no_main]

#[path = "../bodies/raster.rs"]
mod raster;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| raster::run(bytes));
