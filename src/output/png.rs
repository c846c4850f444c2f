//! PNG files: 8 bits a channel, the same bytes for the same picture.

use std::io::Cursor;
use std::path::Path;

use image::codecs::png::{CompressionType, FilterType, PngDecoder, PngEncoder};
use image::{ColorType, DynamicImage, ExtendedColorType, ImageDecoder, ImageEncoder, Limits};

use crate::bounded;
use crate::error::{Error, Kind, Result};
use crate::fence::fenced;

/// Largest width and height that is read, in pixels.
const MAX_SIDE: u32 = 16_384;

/// How hard the encoder works.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Effort {
    /// Several times faster than small, about twice the size: for sequences.
    #[default]
    Fast,
    /// As small as the encoder can: for files that are kept under version control.
    Small,
}

/// A decoded picture with alpha, top row first.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Pixels {
    /// Width in pixels (>= 1).
    pub width: u32,
    /// Height in pixels (>= 1).
    pub height: u32,
    /// `width * height` pixels: red, green, blue, alpha.
    pub rgba: Vec<[u8; 4]>,
}

/// PNG bytes of `samples`: three (red, green, blue) or four (and alpha) per pixel, top row first.
///
/// # Errors
/// [`Kind::Internal`] when the number of samples is neither `3 * width * height` nor
/// `4 * width * height`.
pub fn encode(width: u32, height: u32, samples: &[u8], effort: Effort) -> Result<Vec<u8>> {
    let pixels = u64::from(width) * u64::from(height);
    let color = match samples.len() as u64 {
        count if pixels > 0 && Some(count) == pixels.checked_mul(3) => ExtendedColorType::Rgb8,
        count if pixels > 0 && Some(count) == pixels.checked_mul(4) => ExtendedColorType::Rgba8,
        count => {
            return Err(Error::new(Kind::Internal, format!("{count} samples for {width} x {height} pixels")));
        }
    };
    let (compression, filter) = match effort {
        Effort::Fast => (CompressionType::Fast, FilterType::Adaptive),
        Effort::Small => (CompressionType::Best, FilterType::Adaptive),
    };
    let mut bytes = Vec::new();
    PngEncoder::new_with_quality(&mut bytes, compression, filter)
        .write_image(samples, width, height, color)
        .map_err(|e| Error::new(Kind::Internal, format!("cannot encode PNG: {e}")))?;
    Ok(bytes)
}

/// The picture in the PNG file at `path`.
///
/// # Errors
/// [`Kind::Io`] when the file cannot be read or is no PNG of 8 bits a channel and at most
/// 16384 x 16384 pixels.
pub fn read(path: &Path) -> Result<Pixels> {
    let failed = |cause: String| Error::new(Kind::Io, format!("cannot read `{}`: {cause}", path.display()));
    let bytes = bounded::read(path, bounded::MOST).map_err(|e| failed(e.to_string()))?;
    fenced(|| decode(&bytes)).unwrap_or_else(|why| Err(why.to_owned())).map_err(failed)
}

/// The picture in PNG bytes; the error says what is wrong with them.
fn decode(bytes: &[u8]) -> Result<Pixels, String> {
    let mut limits = Limits::default();
    limits.max_image_width = Some(MAX_SIDE);
    limits.max_image_height = Some(MAX_SIDE);
    let decoder = PngDecoder::with_limits(Cursor::new(bytes), limits).map_err(|e| e.to_string())?;
    // Cutting 16 bits down to 8 would hide differences.
    if !matches!(decoder.color_type(), ColorType::L8 | ColorType::La8 | ColorType::Rgb8 | ColorType::Rgba8) {
        return Err("it has 16 bits a channel; only 8 are compared".to_owned());
    }
    let decoded = DynamicImage::from_decoder(decoder).map_err(|e| e.to_string())?.into_rgba8();
    let rgba = decoded.pixels().map(|pixel| pixel.0).collect();
    Ok(Pixels { width: decoded.width(), height: decoded.height(), rgba })
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn decoding_gives_back_what_was_encoded(
            (width, height) in (1_u32..20, 1_u32..20),
            channels in 3_usize..=4,
            seed in any::<u64>(),
            effort in prop_oneof![Just(Effort::Fast), Just(Effort::Small)],
        ) {
            let count = width as usize * height as usize * channels;
            let samples: Vec<u8> =
                (0..count as u64).map(|i| crate::math::splitmix64(seed ^ i).to_le_bytes()[0]).collect();
            let bytes = encode(width, height, &samples, effort).unwrap();
            prop_assert_eq!(&bytes, &encode(width, height, &samples, effort).unwrap());
            let back = decode(&bytes).unwrap();
            prop_assert_eq!((back.width, back.height), (width, height));
            let expected: Vec<[u8; 4]> = samples
                .chunks_exact(channels)
                .map(|p| [p[0], p[1], p[2], p.get(3).copied().unwrap_or(255)])
                .collect();
            prop_assert_eq!(back.rgba, expected);
        }
    }

    #[test]
    fn small_is_smaller_than_fast() {
        let samples: Vec<u8> = (0..64_u8).flat_map(|y| (0..64_u8).flat_map(move |x| [x, y, x ^ y])).collect();
        let size = |effort| encode(64, 64, &samples, effort).unwrap().len();
        assert!(size(Effort::Small) < size(Effort::Fast), "{} {}", size(Effort::Small), size(Effort::Fast));
    }

    #[test]
    fn samples_that_do_not_fit_are_refused() {
        for (width, height, count) in [(2, 2, 11), (2, 2, 4), (0, 0, 0), (u32::MAX, u32::MAX, 3)] {
            let error = encode(width, height, &vec![0; count], Effort::Fast).unwrap_err();
            assert_eq!(error.kind, Kind::Internal);
        }
    }

    #[test]
    fn broken_files_and_wide_channels_are_refused() {
        let whole = encode(8, 8, &[7; 192], Effort::Small).unwrap();
        assert!(decode(&[]).is_err());
        assert!(decode(&whole[..whole.len() - 20]).is_err());
        let mut flipped = whole.clone();
        flipped[45] ^= 0x10;
        assert!(decode(&flipped).is_err(), "a checksum guards every chunk");
        let mut wide = Vec::new();
        PngEncoder::new(&mut wide).write_image(&[0; 2], 1, 1, ExtendedColorType::L16).unwrap();
        assert!(decode(&wide).unwrap_err().contains("16 bits"));
    }
}
