//! The frame of a self-contained web page: one file, no script, nothing fetched, light or dark as
//! the reader's system is, readable on a telephone.

use std::fmt::Write;

use crate::printable;

/// The style of every page. Plots use the custom properties, so that they follow the theme.
const STYLE: &str = "\
:root{color-scheme:light dark;--ink:#1c1c1e;--soft:#63636b;--line:#d4d4da;--paper:#fff;--shade:#f4f4f7;\
--a:#0b62c4;--b:#c2410c;--c:#15803d;--d:#9333ea;--e:#a16207;--f:#be185d}\
@media(prefers-color-scheme:dark){:root{--ink:#ececf1;--soft:#a3a3ad;--line:#3f3f47;--paper:#17171a;--shade:#222226;\
--a:#6cb2ff;--b:#fb9a5b;--c:#5fd38a;--d:#cd9bff;--e:#e5c04b;--f:#ff8fc0}}\
*{box-sizing:border-box}\
body{font:16px/1.5 system-ui,sans-serif;color:var(--ink);background:var(--paper);max-width:72rem;margin:0 auto;\
padding:1rem;overflow-wrap:break-word}\
h1{font-size:1.7rem;line-height:1.2}h2{margin-top:2.2rem}a{color:var(--a)}\
figure{margin:1rem 0}figcaption,.soft{color:var(--soft);font-size:.9rem}\
.row{display:flex;flex-wrap:wrap;gap:1rem}.row>figure{flex:1 1 15rem;margin:0;min-width:0}\
img,svg{max-width:100%;height:auto;display:block}img{border:1px solid var(--line);image-rendering:pixelated}\
svg text{fill:var(--ink);font-family:system-ui,sans-serif}\
.wide{overflow-x:auto}table{border-collapse:collapse;font-variant-numeric:tabular-nums;font-size:.9rem}\
th,td{padding:.25rem .6rem;border-bottom:1px solid var(--line);text-align:right;white-space:nowrap}\
th:first-child,td:first-child,.text th,.text td{text-align:left}.text td{white-space:normal;vertical-align:top}\
code,pre{font:.85em/1.45 ui-monospace,monospace;background:var(--shade);border-radius:4px;padding:.1em .3em}\
pre{padding:.6rem .8rem;overflow-x:auto}";

/// The start of a page with its heading; [`END`] closes it.
pub fn head(title: &str) -> String {
    let title = escape(title);
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">\n\
         <link rel=\"icon\" href=\"data:,\">\n<title>{title}</title>\n<style>{STYLE}</style>\n</head>\n\
         <body>\n<h1>{title}</h1>\n"
    )
}

/// The end of a page.
pub const END: &str = "</body>\n</html>\n";

/// A picture, given as the bytes of a PNG file, within the page, described by `alt`.
pub fn image(alt: &str, png: &[u8]) -> String {
    format!("<img alt=\"{}\" src=\"data:image/png;base64,{}\">", escape(alt), base64(png))
}

/// What the cells of a table hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cells {
    /// Numbers, on the right of their column and never broken.
    Numbers,
    /// Text, in as many lines as it needs.
    Text,
}

/// A table with `head` over `rows`, all HTML already; it scrolls sideways on a narrow screen.
pub fn table(head: &[&str], cells: Cells, rows: impl Iterator<Item = Vec<String>>) -> String {
    let class = if cells == Cells::Text { " class=\"text\"" } else { "" };
    let head: String = head.iter().map(|name| format!("<th>{name}</th>")).collect();
    let row = |row: Vec<String>| row.iter().map(|cell| format!("<td>{cell}</td>")).collect::<String>();
    let rows: String = rows.map(|cells| format!("<tr>{}</tr>\n", row(cells))).collect();
    format!("<div class=\"wide\"><table{class}>\n<tr>{head}</tr>\n{rows}</table></div>\n")
}

/// Text that stands for itself in HTML and SVG, where it may be of several lines.
pub fn escape(text: &str) -> String {
    printable::lines(text)
        .replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        .replace('"', "&quot;")
}

/// `value` with at most four significant digits.
pub fn short(value: f64) -> String {
    let rounded: f64 = format!("{value:.3e}").parse().unwrap_or(value);
    if rounded == 0.0 || (1e-3..1e6).contains(&rounded.abs()) {
        rounded.to_string()
    } else {
        format!("{rounded:e}")
    }
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
    fn short_numbers_have_four_digits() {
        let all = [0.0, -0.25, 123.456, 1e-4, -1234567.0].map(short);
        assert_eq!(all, ["0", "-0.25", "123.5", "1e-4", "-1.235e6"]);
    }

    #[test]
    fn a_page_escapes_its_title_and_fetches_nothing() {
        let text = head("<a&\"b\"\u{1b}>") + &image("\"", b"foobar") + END;
        assert_eq!(text.matches("&lt;a&amp;&quot;b&quot;␛&gt;").count(), 2);
        assert!(text.contains("alt=\"&quot;\" src=\"data:image/png;base64,Zm9vYmFy\""));
        assert!(!text.contains("http") && !text.contains("<script"));
    }
}
