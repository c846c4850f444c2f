//! Which way a picture is to be turned before it is shown, by the Exif data in its file.
//!
//! Decoders look in one place, or take the last of several; this finds what programs that show pictures find.

use std::borrow::Cow;
use std::io::Cursor;

use image::metadata::Orientation;

use crate::container::png_chunks;

/// The tag of the orientation.
const TAG: u16 = 0x0112;

/// What stands before the data in a JPEG, and in PNGs of some programs.
const NAME: &[u8] = b"Exif\0\0";

/// The keyword of the text in which programs kept Exif data before PNG had a chunk for them.
const PROFILE: &[u8] = b"Raw profile type exif";

/// How the picture in the file `bytes` is to be turned and mirrored; not at all where nothing is said of it.
pub fn orientation(bytes: &[u8]) -> Orientation {
    let data = in_jpeg(bytes).or_else(|| in_png(bytes));
    data.and_then(|tiff| of_tiff(&tiff)).unwrap_or(Orientation::NoTransforms)
}

/// The first Exif segment of a JPEG: a second one is not what the picture is shown by.
fn in_jpeg(bytes: &[u8]) -> Option<Cow<'_, [u8]>> {
    let mut rest = bytes.strip_prefix(b"\xFF\xD8")?;
    loop {
        // Any number of 0xFF may stand before a marker.
        let fill = rest.iter().take_while(|byte| **byte == 0xFF).count();
        let (marker, segment) = rest.get(fill.max(1)..)?.split_first()?;
        let length = usize::from(u16::from_be_bytes(*segment.first_chunk()?));
        let content = segment.get(2..length)?;
        match (marker, content.strip_prefix(NAME)) {
            (0xE1, Some(data)) => return Some(Cow::Borrowed(data)),
            // The pixels begin.
            (0xDA, _) => return None,
            _ => rest = &segment[length..],
        }
    }
}

/// The Exif data of a PNG: its chunk, which may stand after the pixels, or the text of older programs.
fn in_png(bytes: &[u8]) -> Option<Cow<'_, [u8]>> {
    match png_chunks(bytes).find(|(kind, _)| kind == b"eXIf") {
        Some((_, content)) => Some(Cow::Borrowed(content.strip_prefix(NAME).unwrap_or(content))),
        None => in_text(bytes).map(Cow::Owned),
    }
}

/// The Exif data that a PNG holds as text: a name and a length, each on a line, and hexadecimal digits.
fn in_text(bytes: &[u8]) -> Option<Vec<u8>> {
    png_chunks(bytes).find(|(kind, content)| {
        [*b"tEXt", *b"zTXt"].contains(kind)
            && content.strip_prefix(PROFILE).is_some_and(|rest| rest.starts_with(&[0]))
    })?;
    let reader = png::Decoder::new(Cursor::new(bytes)).read_info().ok()?;
    let info = reader.info();
    let plain = info.uncompressed_latin1_text.iter().map(|chunk| (&chunk.keyword, Some(chunk.text.clone())));
    let packed = info.compressed_latin1_text.iter().map(|chunk| (&chunk.keyword, chunk.get_text().ok()));
    let text = plain.chain(packed).find(|(keyword, _)| keyword.as_bytes() == PROFILE)?.1?;
    let mut lines = text.trim_start().lines().skip(1);
    lines.next()?;
    let digits: Vec<u8> =
        lines.flat_map(str::chars).filter_map(|c| c.to_digit(16)?.try_into().ok()).collect();
    let data: Vec<u8> = digits.as_chunks::<2>().0.iter().map(|[high, low]| 16 * high + low).collect();
    Some(data.strip_prefix(NAME).map_or_else(|| data.clone(), <[u8]>::to_vec))
}

/// The orientation in the first directory of a TIFF; that of a thumbnail is in the second.
fn of_tiff(tiff: &[u8]) -> Option<Orientation> {
    let big = match tiff.first_chunk()? {
        b"MM\0*" => true,
        b"II*\0" => false,
        _ => return None,
    };
    let short = |bytes: [u8; 2]| if big { u16::from_be_bytes(bytes) } else { u16::from_le_bytes(bytes) };
    let long = |bytes: [u8; 4]| if big { u32::from_be_bytes(bytes) } else { u32::from_le_bytes(bytes) };
    let start = usize::try_from(long(*tiff[4..].first_chunk()?)).ok()?;
    let directory = tiff.get(start..)?;
    let count = usize::from(short(*directory.first_chunk()?));
    let (entries, _) = directory[2..].as_chunks::<12>();
    let [_, _, k0, k1, _, _, _, _, a, b, c, d] =
        *entries.iter().take(count).find(|entry| short([entry[0], entry[1]]) == TAG)?;
    // Exif says SHORT; some programs write LONG.
    let value = match short([k0, k1]) {
        3 => u8::try_from(short([a, b])).ok()?,
        4 => u8::try_from(long([a, b, c, d])).ok()?,
        _ => return None,
    };
    Orientation::from_exif(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A TIFF whose first directory has one entry, and the directory after it another.
    fn tiff(order: &[u8; 4], entries: [[u8; 12]; 2]) -> Vec<u8> {
        let [start, one, next] = match order {
            b"MM\0*" => [&[0, 0, 0, 8][..], &[0, 1], &[0, 0, 0, 26]],
            _ => [&[8, 0, 0, 0][..], &[1, 0], &[26, 0, 0, 0]],
        };
        [order, start, one, &entries[0], next, one, &entries[1], &[0; 4]].concat()
    }

    #[test]
    fn the_first_directory_says_the_orientation_in_either_order_and_any_width() {
        let other = [1, 1, 3, 0, 1, 0, 0, 0, 6, 0, 0, 0];
        for (order, entry) in [
            (b"II*\0", [0x12, 1, 3, 0, 1, 0, 0, 0, 6, 0, 0, 0]),
            (b"II*\0", [0x12, 1, 4, 0, 1, 0, 0, 0, 6, 0, 0, 0]),
            (b"MM\0*", [1, 0x12, 0, 3, 0, 0, 0, 1, 0, 6, 0, 0]),
            (b"MM\0*", [1, 0x12, 0, 4, 0, 0, 0, 1, 0, 0, 0, 6]),
        ] {
            let found = of_tiff(&tiff(order, [entry, other]));
            assert_eq!(found, Some(Orientation::Rotate90), "{entry:?}");
            assert_eq!(of_tiff(&tiff(order, [other, entry])), None, "{entry:?} of a thumbnail");
        }
        let [none, nine] = [0, 9].map(|value| [0x12, 1, 3, 0, 1, 0, 0, 0, value, 0, 0, 0]);
        assert_eq!([none, nine].map(|entry| of_tiff(&tiff(b"II*\0", [entry, other]))), [None; 2]);
    }

    #[test]
    fn the_first_exif_segment_of_a_jpeg_counts() {
        let segment = |value: u8| {
            let entry = [0x12, 1, 3, 0, 1, 0, 0, 0, value, 0, 0, 0];
            [b"\xFF\xE1\0\x36".as_slice(), NAME, &tiff(b"II*\0", [entry; 2]), &[0; 2]].concat()
        };
        let jpeg = |first: &[u8], second: &[u8]| [b"\xFF\xD8", first, second, b"\xFF\xD9"].concat();
        assert_eq!(segment(1).len(), 2 + 0x36);
        let other = b"\xFF\xE1\0\x06http".as_slice();
        assert_eq!(orientation(&jpeg(&segment(6), &segment(1))), Orientation::Rotate90);
        assert_eq!(orientation(&jpeg(&segment(1), &segment(6))), Orientation::NoTransforms);
        assert_eq!(orientation(&jpeg(other, &segment(6))), Orientation::Rotate90);
    }

    #[test]
    fn what_is_cut_short_says_nothing() {
        let whole = tiff(b"II*\0", [[0x12, 1, 3, 0, 1, 0, 0, 0, 6, 0, 0, 0]; 2]);
        let jpeg =
            [b"\xFF\xD8\xFF\xFF\xE1\0\x3A".as_slice(), NAME, &whole[..44], b"\0\0\0\0\0\0\xFF\xD9"].concat();
        assert_eq!(orientation(&jpeg), Orientation::Rotate90);
        for length in 0..jpeg.len() {
            let _ = orientation(&jpeg[..length]);
        }
        for length in 0..22 {
            assert_eq!(of_tiff(&whole[..length]), None, "{length}");
        }
        assert_eq!(orientation(b""), Orientation::NoTransforms);
    }
}
