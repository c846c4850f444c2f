//! Textures: what is decoded is what the file says, what cannot be decoded is an error that names
//! the file, and the built-in set is what its generator paints.

#![expect(clippy::unwrap_used, reason = "a helper that fails is a test that fails")]

mod built_in;
mod decoding;
mod seams;
mod sources;
mod upright;

#[path = "../../../examples/make_textures/paint/mod.rs"]
mod paint;

use std::io::Cursor;

use image::{DynamicImage, ImageFormat};

/// The bytes of an image file.
fn encode(image: &DynamicImage, format: ImageFormat) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    image.write_to(&mut bytes, format).unwrap();
    bytes.into_inner()
}
