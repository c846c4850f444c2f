//! The version of the program, with what it computes.

/// The hashes of states and pictures that every build of this version has, see `docs/determinism.md`.
const RESULTS: &[u8] = include_bytes!("../tests/cli/everywhere.txt");

/// The release, as in `Cargo.toml`.
const RELEASE: &str = env!("CARGO_PKG_VERSION");

/// Digits of the mark of the results.
const DIGITS: usize = 8;

const LENGTH: usize = RELEASE.len() + 1 + DIGITS;

const TEXT: [u8; LENGTH] = text();

/// The release and, as its build metadata, a mark of its results: `0.1.0+` and eight hexadecimal digits. Two builds with
/// the same text compute the same bits, on every machine; between two releases a change of the results gives another
/// text. Files that are gone on with later (states, plans and results of sweeps, numbered pictures) carry it.
pub const VERSION: &str = match str::from_utf8(&TEXT) {
    Ok(text) => text,
    Err(_) => unreachable!(),
};

/// FNV-1a of 32 bits. A carriage return, which some checkouts add, does not count.
const fn mark(bytes: &[u8]) -> u32 {
    let mut hash = 0x811c_9dc5_u32;
    let mut i = 0;
    while i < bytes.len() {
        if bytes[i] != b'\r' {
            hash = (hash ^ bytes[i] as u32).wrapping_mul(0x0100_0193);
        }
        i += 1;
    }
    hash
}

const fn text() -> [u8; LENGTH] {
    let mut text = [b'+'; LENGTH];
    let (release, digits) = (RELEASE.as_bytes(), b"0123456789abcdef");
    let mut i = 0;
    while i < release.len() {
        text[i] = release[i];
        i += 1;
    }
    let mut mark = mark(RESULTS);
    i = LENGTH;
    while i > RELEASE.len() + 1 {
        i -= 1;
        text[i] = digits[(mark % 16) as usize];
        mark /= 16;
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_text_is_the_release_and_the_mark_of_the_results() {
        assert_eq!(VERSION, format!("{RELEASE}+{:08x}", mark(RESULTS)));
        // Known values of FNV-1a.
        assert_eq!([mark(b""), mark(b"a"), mark(b"foobar")], [0x811c_9dc5, 0xe40c_292c, 0xbf9c_f968]);
        assert_ne!(mark(b"state 1"), mark(b"state 2"));
        assert_eq!(mark(b"a\r\nb"), mark(b"a\nb"));
    }
}
