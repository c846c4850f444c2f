//! PNG files: 8 bits a channel, the same bytes for the same picture.

use std::io::Cursor;
use std::path::Path;

use ::png::{BitDepth, Compression, DecodeOptions, Decoder, Encoder, EncodingError, Filter};
use image::codecs::png::PngDecoder;
use image::error::LimitErrorKind;
use image::{ColorType, DynamicImage, ImageDecoder, ImageError, Limits};

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
    encode_with(width, height, samples, effort, &[])
}

/// As [`encode`], with a text chunk (`tEXt`) before the pixels for each keyword and text.
///
/// # Errors
/// As [`encode`]; [`Kind::Internal`] too for a keyword or text that is not in Latin-1.
pub fn encode_with(
    width: u32,
    height: u32,
    samples: &[u8],
    effort: Effort,
    texts: &[(String, String)],
) -> Result<Vec<u8>> {
    let pixels = u64::from(width) * u64::from(height);
    let color = match samples.len() as u64 {
        count if pixels > 0 && Some(count) == pixels.checked_mul(3) => ::png::ColorType::Rgb,
        count if pixels > 0 && Some(count) == pixels.checked_mul(4) => ::png::ColorType::Rgba,
        count => {
            return Err(Error::new(Kind::Internal, format!("{count} samples for {width} x {height} pixels")));
        }
    };
    let compression = match effort {
        Effort::Fast => Compression::Fast,
        Effort::Small => Compression::High,
    };
    let mut bytes = Vec::new();
    let mut encoder = Encoder::new(&mut bytes, width, height);
    encoder.set_color(color);
    encoder.set_depth(BitDepth::Eight);
    encoder.set_compression(compression);
    encoder.set_filter(Filter::Adaptive);
    write(encoder, samples, texts)
        .map_err(|e| Error::new(Kind::Internal, format!("cannot encode PNG: {e}")))?;
    Ok(bytes)
}

fn write(
    mut encoder: Encoder<'_, &mut Vec<u8>>,
    samples: &[u8],
    texts: &[(String, String)],
) -> std::result::Result<(), EncodingError> {
    for (keyword, text) in texts {
        encoder.add_text_chunk(keyword.clone(), text.clone())?;
    }
    let mut writer = encoder.write_header()?;
    writer.write_image_data(samples)?;
    writer.finish()
}

/// The keywords and texts of the text chunks (`tEXt`) in PNG bytes, also of those after the pixels.
///
/// # Errors
/// [`Kind::Io`] when the bytes are no PNG, are cut short, or a checksum is wrong.
pub fn texts(bytes: &[u8]) -> Result<Vec<(String, String)>> {
    let read = fenced(|| read_texts(bytes)).unwrap_or_else(|why| Err(why.to_owned()));
    read.map_err(|why| Error::new(Kind::Io, why))
}

fn read_texts(bytes: &[u8]) -> Result<Vec<(String, String)>, String> {
    let mut options = DecodeOptions::default();
    options.set_skip_ancillary_crc_failures(false);
    let mut reader =
        Decoder::new_with_options(Cursor::new(bytes), options).read_info().map_err(|e| e.to_string())?;
    reader.finish().map_err(|e| e.to_string())?;
    let chunks = &reader.info().uncompressed_latin1_text;
    Ok(chunks.iter().map(|chunk| (chunk.keyword.clone(), chunk.text.clone())).collect())
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

/// Why a decoder refuses a picture, with the number of the limit where it is one.
pub fn refusal(error: &ImageError) -> String {
    match error {
        ImageError::Limits(limit) => match (limit.kind(), Limits::default().max_alloc) {
            (LimitErrorKind::DimensionError, _) => format!("it has more than {MAX_SIDE} pixels a side"),
            (LimitErrorKind::InsufficientMemory, Some(most)) => format!("it takes more than {most} bytes"),
            _ => error.to_string(),
        },
        error => error.to_string(),
    }
}

/// The picture in PNG bytes; the error says what is wrong with them.
fn decode(bytes: &[u8]) -> Result<Pixels, String> {
    let mut limits = Limits::default();
    limits.max_image_width = Some(MAX_SIDE);
    limits.max_image_height = Some(MAX_SIDE);
    let decoder = PngDecoder::with_limits(Cursor::new(bytes), limits).map_err(|e| refusal(&e))?;
    // Cutting 16 bits down to 8 would hide differences.
    if !matches!(decoder.color_type(), ColorType::L8 | ColorType::La8 | ColorType::Rgb8 | ColorType::Rgba8) {
        return Err("it has 16 bits a channel; only 8 are compared".to_owned());
    }
    let decoded = DynamicImage::from_decoder(decoder).map_err(|e| refusal(&e))?.into_rgba8();
    let rgba = decoded.pixels().map(|pixel| pixel.0).collect();
    Ok(Pixels { width: decoded.width(), height: decoded.height(), rgba })
}

#[cfg(test)]
mod tests {
    use super::*;
    use image::codecs::png::PngEncoder;
    use image::{ExtendedColorType, ImageEncoder};
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
    fn texts_are_read_back_and_leave_the_pixels_alone() {
        let given = [("a:b", "{\"x\":1}"), ("Title", "plain")].map(|(k, t)| (k.to_owned(), t.to_owned()));
        let [plain, told] =
            [&[][..], &given].map(|texts| encode_with(2, 1, &[7; 6], Effort::Fast, texts).unwrap());
        assert_eq!(decode(&plain).unwrap(), decode(&told).unwrap());
        assert_eq!((texts(&plain).unwrap(), texts(&told).unwrap()), (Vec::new(), given.to_vec()));
        for end in 0..told.len() - 4 {
            assert!(texts(&told[..end]).is_err(), "cut to {end} of {} bytes", told.len());
        }
        let place = told.windows(5).position(|window| window == b"plain").unwrap();
        let mut changed = told;
        changed[place] = b'P';
        assert_eq!(texts(&changed).unwrap_err().kind, Kind::Io, "a checksum guards every text");
        let latin = [("a".to_owned(), "\u{1f600}".to_owned())];
        assert_eq!(encode_with(1, 1, &[0; 3], Effort::Fast, &latin).unwrap_err().kind, Kind::Internal);
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

    #[test]
    fn a_picture_beyond_a_limit_is_told_which() {
        let mut bytes = Vec::new();
        let encoder = PngEncoder::new(&mut bytes);
        encoder.write_image(&[0; MAX_SIDE as usize + 1], MAX_SIDE + 1, 1, ExtendedColorType::L8).unwrap();
        assert_eq!(decode(&bytes).unwrap_err(), "it has more than 16384 pixels a side");
    }
}
