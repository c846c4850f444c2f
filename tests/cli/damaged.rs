//! Pictures on which the decoder itself fails: an error of the file, not of the program.

use super::errors::fails;
use crate::scratch::Scratch;
use std::fs;

/// A picture of one pixel whose palette has four bytes, no multiple of three: the decoder panics.
const PALETTE: [u8; 83] = [
    0x89, 0x50, 0x4E, 0x47, 0x0D, 0x0A, 0x1A, 0x0A, 0x00, 0x00, 0x00, 0x0D, 0x49, 0x48, 0x44, 0x52, 0x00,
    0x00, 0x00, 0x01, 0x00, 0x00, 0x00, 0x01, 0x08, 0x03, 0x00, 0x00, 0x00, 0x28, 0xCB, 0x34, 0xBB, 0x00,
    0x00, 0x00, 0x04, 0x50, 0x4C, 0x54, 0x45, 0x01, 0x01, 0x01, 0x01, 0x63, 0xC1, 0xA2, 0xFF, 0x00, 0x00,
    0x00, 0x0A, 0x49, 0x44, 0x41, 0x54, 0x78, 0x9C, 0x63, 0x60, 0x00, 0x00, 0x00, 0x02, 0x00, 0x01, 0x48,
    0xAF, 0xA4, 0x71, 0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4E, 0x44, 0xAE, 0x42, 0x60, 0x82,
];

#[test]
fn a_texture_on_which_the_decoder_fails_is_3() {
    let scratch = Scratch::new();
    fs::create_dir(scratch.path("set")).unwrap();
    fs::write(scratch.path("set/texture_1.png"), PALETTE).unwrap();
    let arguments = ["render", "small.json", "out.png", "--shader", "texture", "--textures", "set"];
    let (error, _) = fails(&scratch, &[&arguments[..], &["--frame", "0"]].concat(), 3, "scene");
    assert!(error["error"].as_str().unwrap().contains("texture_1.png"), "{error}");
    assert_eq!(scratch.names(), ["set", "small.json"]);
}

#[test]
fn a_picture_on_which_the_decoder_fails_is_6_in_compare() {
    let scratch = Scratch::new();
    fs::write(scratch.path("a.png"), PALETTE).unwrap();
    for arguments in [&["compare", "a.png", "a.png"][..], &["compare", "a.png", "a.png", "--mask", "a.png"]] {
        let (error, _) = fails(&scratch, arguments, 6, "io");
        assert!(error["error"].as_str().unwrap().contains("a.png"), "{error}");
    }
}
