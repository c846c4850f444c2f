//! Files of every kind become the right numbers, or an error.

use drape::error::Kind;
use drape::texture::{MAX_SIDE, Texture};
use image::{DynamicImage, GrayAlphaImage, GrayImage, ImageBuffer, ImageFormat, Luma, Rgb, Rgba, RgbaImage};
use proptest::prelude::*;

use super::encode;

fn png(image: impl Into<DynamicImage>) -> Vec<u8> {
    encode(&image.into(), ImageFormat::Png)
}

/// A picture with a different colour in every texel.
fn rgb(width: u32, height: u32) -> DynamicImage {
    let byte = |n: u32| u8::try_from(n % 256).unwrap();
    image::RgbImage::from_fn(width, height, |x, y| Rgb([byte(x * 7), byte(y * 11), byte(x + y)])).into()
}

fn decode(bytes: &[u8]) -> Texture {
    Texture::decode("sample", bytes).unwrap()
}

fn texels(bytes: &[u8]) -> Vec<[f32; 4]> {
    decode(bytes).texels().to_vec()
}

#[test]
fn all_256_bytes_survive_the_way_to_unit_numbers_and_back() {
    let all: Vec<u8> = (0..=255).collect();
    let texture = decode(&png(GrayImage::from_raw(16, 16, all.clone()).unwrap()));
    for (&byte, texel) in all.iter().zip(texture.texels()) {
        let unit = f32::from(byte) / 255.0;
        assert_eq!(texel, &[unit, unit, unit, 1.0], "byte {byte}");
        assert_eq!((texel[0] * 255.0).round(), f32::from(byte), "byte {byte} comes back");
    }
}

#[test]
fn all_65536_words_are_rounded_once() {
    let all: Vec<u16> = (0..=u16::MAX).collect();
    let image = ImageBuffer::<Luma<u16>, _>::from_raw(256, 256, all.clone()).unwrap();
    for (&word, texel) in all.iter().zip(texels(&png(image))) {
        let unit = f32::from(word) / 65535.0;
        assert_eq!(texel, [unit, unit, unit, 1.0], "word {word}");
    }
}

/// Half of a texel of 8 bits is none, and without being asked nothing is packed.
#[test]
fn only_texels_of_8_bits_are_packed() {
    let packed = |rgb: &[[f32; 3]], asked: bool| {
        let texture = Texture::from_rgb(2, 1, rgb).unwrap();
        texture.for_look_ups(asked).packed.map(<[u32]>::to_vec)
    };
    let eight = [[1.0, 0.2, 0.0], [0.0, 0.0, 128.0 / 255.0]];
    assert_eq!(packed(&eight, true), Some(vec![0x0000_33FF, 0x0080_0000]));
    assert_eq!(packed(&eight, false), None);
    assert_eq!(packed(&[[1.0, 0.2, 0.0], [0.0, 0.0, 127.5 / 255.0]], true), None);
}

#[test]
fn every_channel_layout_gives_rgb_and_one() {
    let unit8 = |c: [u8; 3]| [f32::from(c[0]) / 255.0, f32::from(c[1]) / 255.0, f32::from(c[2]) / 255.0, 1.0];
    let grey_alpha = GrayAlphaImage::from_raw(2, 1, vec![9, 0, 200, 77]).unwrap();
    assert_eq!(texels(&png(grey_alpha)), [unit8([9; 3]), unit8([200; 3])], "grey and alpha");
    let image = rgb(5, 3);
    let expected: Vec<_> = image.to_rgb8().pixels().map(|p| unit8(p.0)).collect();
    assert_eq!(texels(&png(image)), expected, "RGB");
    let rgba = RgbaImage::from_raw(2, 1, vec![1, 2, 3, 0, 250, 251, 252, 128]).unwrap();
    assert_eq!(texels(&png(rgba)), [unit8([1, 2, 3]), unit8([250, 251, 252])], "RGBA");

    let words = [0x0102_u16, 0x8001, 0xFFFE];
    let expected = [words.map(|w| f32::from(w) / 65535.0)].map(|[r, g, b]| [r, g, b, 1.0]);
    let rgb16 = ImageBuffer::<Rgb<u16>, _>::from_raw(1, 1, words.to_vec()).unwrap();
    assert_eq!(texels(&png(rgb16)), expected, "RGB at 16 bits");
    let rgba16 = ImageBuffer::<Rgba<u16>, _>::from_raw(1, 1, [&words[..], &[7]].concat()).unwrap();
    assert_eq!(texels(&png(rgba16)), expected, "RGBA at 16 bits");
}

#[test]
fn rows_run_from_the_top_and_columns_from_the_left() {
    let texture = decode(&png(rgb(5, 3)));
    assert_eq!((texture.width(), texture.height()), (5, 3));
    assert_eq!(texture.texel(4, 0), [28.0 / 255.0, 0.0, 4.0 / 255.0, 1.0]);
    assert_eq!(texture.texel(0, 2), [0.0, 22.0 / 255.0, 2.0 / 255.0, 1.0]);
}

/// A JPEG of one flat colour loses next to nothing, in colour and in grey.
#[test]
fn jpeg_is_decoded() {
    for (color, tolerance) in [([200, 90, 30], 3.0), ([128, 128, 128], 0.0)] {
        let image: DynamicImage = image::RgbImage::from_pixel(17, 9, Rgb(color)).into();
        let texture = decode(&encode(&image, ImageFormat::Jpeg));
        assert_eq!((texture.width(), texture.height()), (17, 9));
        for texel in texture.texels() {
            for (&got, want) in texel.iter().zip(color.map(f32::from)) {
                assert!((got * 255.0 - want).abs() <= tolerance + 1e-3, "{texel:?} for {color:?}");
            }
            assert_eq!(texel[3], 1.0);
        }
    }
    let grey: DynamicImage = GrayImage::from_pixel(8, 8, Luma([64])).into();
    assert_eq!(
        texels(&encode(&grey, ImageFormat::Jpeg)),
        [[64.0 / 255.0, 64.0 / 255.0, 64.0 / 255.0, 1.0]; 64]
    );
}

fn assert_refused(bytes: &[u8], reason: &str) {
    let error = Texture::decode("walls/stone.png", bytes).unwrap_err();
    assert_eq!(error.kind, Kind::Scene, "{error}");
    assert!(error.message.contains("walls/stone.png"), "names the file: {error}");
    assert!(error.message.contains(reason), "says {reason:?}: {error}");
}

#[test]
fn other_formats_and_nothing_are_refused() {
    for bytes in [&b""[..], b"GIF89a\x01\x00\x01\x00\x00\x00\x00;", b"P3 1 1 255 0 0 0", b"\xFF", b"\x89PNG"]
    {
        assert_refused(bytes, "neither a PNG nor a JPEG");
    }
}

/// Each cut, down to the last byte: a decoder that fills the rest with grey would pass none.
#[test]
fn a_file_cut_short_is_refused_at_every_length() {
    for (format, signature) in [(ImageFormat::Png, 8), (ImageFormat::Jpeg, 3)] {
        let whole = encode(&rgb(20, 20), format);
        decode(&whole);
        for length in signature..whole.len() {
            assert_refused(&whole[..length], "cut short");
        }
    }
}

/// A thumbnail in front of the picture has an end of its own, which is not the end of the file.
#[test]
fn the_end_of_a_thumbnail_is_not_the_end_of_a_jpeg() {
    let mut bytes = encode(&rgb(20, 20), ImageFormat::Jpeg);
    let plain = texels(&bytes);
    bytes.splice(2..2, [0xFF, 0xE1, 0, 6, 0xFF, 0xD8, 0xFF, 0xD9]);
    assert_eq!(texels(&bytes), plain);
    bytes.truncate(bytes.len() - 2);
    assert_refused(&bytes, "cut short");
}

#[test]
fn a_corrupt_checksum_is_refused() {
    let mut bytes = png(rgb(20, 20));
    let middle = bytes.len() / 2;
    bytes[middle] ^= 0x10;
    assert_refused(&bytes, "cannot be decoded");
}

/// The size is refused from the header alone: the files hold no picture at all.
#[test]
fn a_bomb_is_refused_before_anything_is_allocated() {
    for (width, height) in [(MAX_SIDE + 1, 1), (1, MAX_SIDE + 1), (MAX_SIDE, MAX_SIDE), (8192, 8193)] {
        let header = [width.to_be_bytes(), height.to_be_bytes()].concat();
        let bomb = png_of(&[(b"IHDR", &[&header[..], &[8, 2, 0, 0, 0]].concat()), (b"IDAT", &[])]);
        assert_refused(&bomb, &format!("{width} x {height} is too large"));
    }
    let header = [[0x7F, 0xFF, 0xFF, 0xFF, 0x7F, 0xFF, 0xFF, 0xFF, 8, 2, 0, 0, 0]].concat();
    assert_refused(&png_of(&[(b"IHDR", &header), (b"IDAT", &[])]), "");
}

/// Four texels of two bits that point into a palette of three colours.
#[test]
fn a_palette_is_looked_up() {
    let stored_row = [0x78, 1, 1, 2, 0, 0xFD, 0xFF, 0, 0b00_01_10_01, 0, 0x5C, 0, 0x5B];
    let bytes = png_of(&[
        (b"IHDR", &[0, 0, 0, 4, 0, 0, 0, 1, 2, 3, 0, 0, 0]),
        (b"PLTE", &[255, 0, 0, 0, 255, 0, 0, 0, 255]),
        (b"tRNS", &[0, 128]),
        (b"IDAT", &stored_row),
    ]);
    let [red, green, blue] = [[1.0, 0.0, 0.0, 1.0], [0.0, 1.0, 0.0, 1.0], [0.0, 0.0, 1.0, 1.0]];
    assert_eq!(texels(&bytes), [red, green, blue, green]);
}

/// A PNG of these chunks and an end.
fn png_of(chunks: &[(&[u8; 4], &[u8])]) -> Vec<u8> {
    let mut bytes = b"\x89PNG\r\n\x1a\n".to_vec();
    for (kind, data) in chunks.iter().chain(&[(b"IEND", &[][..])]) {
        let body = [&kind[..], data].concat();
        bytes.extend(u32::try_from(data.len()).unwrap().to_be_bytes());
        bytes.extend(&body);
        bytes.extend(crc32(&body).to_be_bytes());
    }
    bytes
}

fn crc32(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(!0_u32, |crc, &byte| {
        (0..8).fold(crc ^ u32::from(byte), |c, _| if c & 1 == 1 { (c >> 1) ^ 0xEDB8_8320 } else { c >> 1 })
    })
}

#[test]
fn the_longest_side_is_accepted() {
    for (width, height) in [(MAX_SIDE, 1), (1, MAX_SIDE)] {
        let image = GrayImage::from_pixel(width, height, Luma([3]));
        let texture = decode(&png(image));
        assert_eq!((texture.width(), texture.height()), (width as usize, height as usize));
    }
}

proptest! {
    /// Damage anywhere is an error or a picture, and an error always names the file.
    #[test]
    fn damaged_files_never_panic(at in 0..2000_usize, bits in 1..=255_u8, jpeg: bool) {
        let mut bytes = encode(&rgb(20, 20), if jpeg { ImageFormat::Jpeg } else { ImageFormat::Png });
        let at = at % bytes.len();
        bytes[at] ^= bits;
        if let Err(error) = Texture::decode("damaged", &bytes) {
            prop_assert_eq!(error.kind, Kind::Scene);
            prop_assert!(error.message.contains("damaged"));
        }
    }
}

#[test]
fn from_rgb_wants_exactly_width_times_height() {
    let rgb = [[0.0, 0.5, 1.0], [0.25, 0.75, 0.125]];
    assert_eq!(Texture::from_rgb(1, 2, &rgb).unwrap().texel(0, 1), [0.25, 0.75, 0.125, 1.0]);
    for (width, height) in [(2, 2), (1, 1), (0, 2), (usize::MAX, 2)] {
        assert_eq!(Texture::from_rgb(width, height, &rgb).unwrap_err().kind, Kind::Internal);
    }
    assert_eq!(Texture::from_rgb(0, 0, &[]).unwrap_err().kind, Kind::Internal);
}
