//! The comment of a GIF: lines `keyword=text`, and how they are found again.

/// The comment that holds these keywords and texts.
pub(crate) fn comment(texts: &[(String, String)]) -> String {
    let lines: Vec<String> = texts.iter().map(|(keyword, text)| format!("{keyword}={text}")).collect();
    lines.join("\n")
}

/// The keywords and texts in the comments of GIF bytes before the first picture; nothing if there are none.
pub(crate) fn texts(bytes: &[u8]) -> Vec<(String, String)> {
    let comments = comments(bytes).unwrap_or_default();
    let comments = String::from_utf8_lossy(&comments);
    let pairs = comments.lines().filter_map(|line| line.split_once('='));
    pairs.map(|(keyword, text)| (keyword.to_owned(), text.to_owned())).collect()
}

/// The bytes of the comment extensions (GIF89a, 24) before the first picture, one after the other.
fn comments(bytes: &[u8]) -> Option<Vec<u8>> {
    // Signature, size, and a table of colours if the flag says so.
    let flags = *bytes.get(10)?;
    let colors = if flags & 0x80 == 0 { 0 } else { 3 << ((flags & 7) + 1) };
    let mut rest = bytes.get(13 + colors..)?;
    let mut comments = Vec::new();
    while let [0x21, label, blocks @ ..] = rest {
        rest = blocks;
        loop {
            let (&length, block) = rest.split_first()?;
            let (block, behind) = block.split_at_checked(usize::from(length))?;
            rest = behind;
            if length == 0 {
                break;
            }
            if *label == 0xFE {
                comments.extend_from_slice(block);
            }
        }
    }
    Some(comments)
}

#[cfg(test)]
mod tests {
    use super::*;
    use gif::{AnyExtension, Encoder, Repeat};

    #[test]
    fn a_comment_of_many_blocks_is_found_behind_other_extensions() {
        let given = [("drape:a".to_owned(), "x=y".repeat(300)), ("drape:b".to_owned(), "{}".to_owned())];
        for palette in [&[][..], &[0; 12]] {
            let mut bytes = Vec::new();
            let mut encoder = Encoder::new(&mut bytes, 2, 1, palette).unwrap();
            encoder.set_repeat(Repeat::Infinite).unwrap();
            encoder.write_raw_extension(AnyExtension(0xFE), &[comment(&given).as_bytes()]).unwrap();
            drop(encoder);
            assert_eq!(texts(&bytes), given);
            for end in 0..bytes.len() - 2 {
                assert_ne!(texts(&bytes[..end]), given, "cut to {end} of {} bytes", bytes.len());
            }
        }
    }
}
