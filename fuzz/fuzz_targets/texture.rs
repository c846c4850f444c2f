#![no_main]

#[path = "../bodies/texture.rs"]
mod texture;

use libfuzzer_sys::fuzz_target;

fuzz_target!(
    init: {
        // libFuzzer's hook ends the process at every panic; those within the fence are errors of the file.
        let end = std::panic::take_hook();
        std::panic::set_hook(Box::new(move |panic| {
            if !drape::fence::is_within() {
                end(panic);
            }
        }));
    },
    |bytes: &[u8]| texture::run(bytes)
);
