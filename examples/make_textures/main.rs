//! Paints the built-in textures: `cargo run --release --example make_textures -- DIR`.
//!
//! The same bytes come out on every machine: no picture was taken or downloaded, all is computed.

mod paint;

use std::error::Error;
use std::path::Path;

use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{ExtendedColorType, ImageEncoder};

fn main() -> Result<(), Box<dyn Error>> {
    let folder = std::env::args_os().nth(1).ok_or("give the folder to write to")?;
    let folder = Path::new(&folder);
    std::fs::create_dir_all(folder.join("cube"))?;
    for (name, picture) in paint::all() {
        std::fs::write(folder.join(format!("{name}.png")), png(&picture)?)?;
    }
    Ok(())
}

/// An RGB PNG at 8 bits, packed as tightly as the encoder can.
fn png(picture: &paint::Picture) -> Result<Vec<u8>, Box<dyn Error>> {
    let mut bytes = Vec::new();
    let encoder = PngEncoder::new_with_quality(&mut bytes, CompressionType::Best, FilterType::Adaptive);
    let side = u32::try_from(paint::SIZE)?;
    encoder.write_image(picture.as_flattened(), side, side, ExtendedColorType::Rgb8)?;
    Ok(bytes)
}
