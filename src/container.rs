//! What stands where in a file with pictures, without decoding it: decoders stop early, and neither miss the end nor see
//! what follows it.

/// The chunks of a PNG, each with its name, as far as they are whole.
pub fn png_chunks(bytes: &[u8]) -> impl Iterator<Item = ([u8; 4], &[u8])> {
    let mut rest = bytes.strip_prefix(b"\x89PNG\r\n\x1a\n").unwrap_or_default();
    std::iter::from_fn(move || {
        let (length, after) = rest.split_first_chunk::<4>()?;
        let (kind, content) = after.split_first_chunk::<4>()?;
        let length = usize::try_from(u32::from_be_bytes(*length)).ok()?;
        // A checksum of four bytes follows.
        rest = content.get(length.checked_add(4)?..)?;
        Some((*kind, &content[..length]))
    })
}

/// Where a PNG ends; none if it is cut short.
pub fn png_end(bytes: &[u8]) -> Option<usize> {
    let mut end = 8;
    png_chunks(bytes).find_map(|(kind, content)| {
        end += 12 + content.len();
        (kind == *b"IEND").then_some(end)
    })
}

/// Whether an animated PNG has a picture before the animation that is no part of it: the one that programs without
/// animation show.
pub fn has_cover(bytes: &[u8]) -> bool {
    let first = png_chunks(bytes).find(|(kind, _)| [*b"fcTL", *b"IDAT"].contains(kind));
    first.is_some_and(|(kind, _)| kind == *b"IDAT")
}

/// Where a JPEG ends, by its end-of-image marker (ITU-T T.81, annex B); none if it is cut short, where a decoder would fill
/// the missing rest with grey. Segments are stepped over, since a thumbnail in one has its own end.
pub fn jpeg_end(bytes: &[u8]) -> Option<usize> {
    let is_marker = |pair: &[u8]| pair[0] == 0xFF && !matches!(pair[1], 0x00 | 0xD0..=0xD7 | 0xFF);
    let mut at = 2;
    loop {
        at += bytes.get(at..)?.windows(2).position(is_marker)? + 2;
        if bytes[at - 1] == 0xD9 {
            return Some(at);
        }
        at += usize::from(u16::from_be_bytes(*bytes.get(at..)?.first_chunk()?));
    }
}

/// Where a GIF ends; none if it is damaged, which the decoder tells.
pub fn gif_end(bytes: &[u8]) -> Option<usize> {
    let colors = |flags: u8| if flags & 0x80 == 0 { 0 } else { 6 << (flags & 7) };
    let mut at = 13 + colors(*bytes.get(10)?);
    loop {
        at += match *bytes.get(at)? {
            b';' => return Some(at + 1),
            b',' => 11 + colors(*bytes.get(at + 9)?),
            b'!' => 2,
            _ => return None,
        };
        while let length @ 1.. = *bytes.get(at)? {
            at += 1 + usize::from(length);
        }
        at += 1;
    }
}
