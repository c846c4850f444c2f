//! A web page of picture comparisons, with the pictures inside it.

use std::fmt::Write;

use super::compare::difference_picture;
use super::png::{self, Effort, Pixels};
use crate::error::Result;

/// One comparison on the page.
pub struct Row<'a> {
    /// What is compared.
    pub title: &'a str,
    /// What was found, one line.
    pub verdict: &'a str,
    /// The expected and the actual picture.
    pub pictures: [&'a Pixels; 2],
}

/// The start of a page, up to the first [`row`].
pub fn head(title: &str) -> String {
    let title = escape(title);
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\"><meta charset=\"utf-8\"><title>{title}</title>\n\
         <style>body{{font:14px sans-serif}}figure{{display:inline-block;margin:4px}}\
         img{{max-width:32vw;border:1px solid #888;image-rendering:pixelated}}</style>\n<h1>{title}</h1>\n"
    )
}

/// A heading, the verdict, and expected, difference and actual side by side.
///
/// # Errors
/// As [`png::encode`].
pub fn row(row: &Row<'_>) -> Result<String> {
    let [expected, actual] = row.pictures;
    let difference = difference_picture(expected, actual);
    let mut text = format!("<h2>{}</h2><p>{}</p>\n", escape(row.title), escape(row.verdict));
    for (caption, picture) in [("expected", expected), ("difference", &difference), ("actual", actual)] {
        let bytes = png::encode(picture.width, picture.height, picture.rgba.as_flattened(), Effort::Fast)?;
        let image = format!("<img alt=\"{caption}\" src=\"data:image/png;base64,{}\">", base64(&bytes));
        text += &format!("<figure>{image}<figcaption>{caption}</figcaption></figure>\n");
    }
    Ok(text)
}

/// Text that stands for itself in HTML.
fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

/// Base 64 with padding (RFC 4648, section 4).
fn base64(bytes: &[u8]) -> String {
    const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for chunk in bytes.chunks(3) {
        let bits = (0..3).fold(0, |bits, i| bits << 8 | usize::from(chunk.get(i).copied().unwrap_or(0)));
        for place in 0..4 {
            let digit =
                if place > chunk.len() { '=' } else { char::from(DIGITS[bits >> (18 - 6 * place) & 63]) };
            // Writing to a string cannot fail.
            let _ = text.write_char(digit);
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The test vectors of RFC 4648, section 10, and every digit once.
    #[test]
    fn base64_gives_the_standard_vectors() {
        for (bytes, text) in [
            ("", ""),
            ("f", "Zg=="),
            ("fo", "Zm8="),
            ("foo", "Zm9v"),
            ("foob", "Zm9vYg=="),
            ("fooba", "Zm9vYmE="),
            ("foobar", "Zm9vYmFy"),
        ] {
            assert_eq!(base64(bytes.as_bytes()), text);
        }
        assert_eq!(base64(&[0xFB, 0xFF, 0xFE]), "+//+");
    }

    #[test]
    fn a_row_holds_the_three_pictures_and_escapes_names() {
        let a = Pixels { width: 1, height: 1, rgba: vec![[1, 2, 3, 255]] };
        let b = Pixels { width: 1, height: 1, rgba: vec![[1, 2, 4, 255]] };
        let text = row(&Row { title: "<a&b>", verdict: "\"1\" of 1", pictures: [&a, &b] }).unwrap();
        assert_eq!(text.matches("data:image/png;base64,iVBOR").count(), 3);
        assert!(text.contains("&lt;a&amp;b&gt;") && text.contains("&quot;1&quot;"));
    }
}
