//! The address of a page, for links to it.

/// What an address may be.
const ALLOWED: &str =
    "expected the address of a page: https://..., http://..., file:///..., or a path that ends in .html";

/// Characters that stand in no address; they are written with a percent sign.
const OUTSIDE: &str = " \"<>\\^`{|}";

/// Parses an address that a browser can follow from a page; what runs as a program, such as `javascript:`, is none.
///
/// # Errors
/// What is allowed, in words.
pub(crate) fn address(text: &str) -> Result<String, String> {
    if let Some(c) = text.chars().find(|c| c.is_control() || c.is_whitespace() || OUTSIDE.contains(*c)) {
        return Err(format!("{c:?} stands in no address; {ALLOWED}"));
    }
    let page = text.split(['?', '#']).next().unwrap_or_default();
    let lower = page.to_ascii_lowercase();
    let named = |host: &str| host.starts_with(|c: char| c.is_alphanumeric() || c == '[');
    let is_address = match lower.split_once("://") {
        Some(("http" | "https", host)) => named(host),
        Some(("file", path)) => path.len() > 1 && path.starts_with('/'),
        Some(_) => false,
        None => !lower.contains(':') && [".html", ".htm"].iter().any(|ending| lower.ends_with(ending)),
    };
    if is_address { Ok(text.to_owned()) } else { Err(ALLOWED.to_owned()) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_address_can_be_followed() {
        for fine in [
            "https://example.org",
            "http://localhost:8000/live/?lang=en#x",
            "HTTPS://EXAMPLE.ORG/Live.html",
            "http://[::1]/",
            "file:///home/me/live.html",
            "live.html",
            "../web/target/live.html#paused",
            "/live.HTM",
        ] {
            assert_eq!(address(fine), Ok(fine.to_owned()));
        }
        for wrong in [
            "",
            "x",
            "example.org",
            "https://",
            "https:///live.html",
            "http://?a",
            "https:/example.org/live.html",
            "file://",
            "file:///",
            "file://live.html",
            "ftp://example.org/live.html",
            "javascript:alert(1)//live.html",
            "javascript://a.html",
            "data:text/html,live.html",
            "live.html more",
            "https://example.org/a b",
            "https://example.org/\"onclick=",
            "live\n.html",
            "--live.htmlx",
        ] {
            let refused = address(wrong).expect_err(wrong);
            assert!(refused.contains("https://"), "{wrong}: {refused}");
        }
    }
}
