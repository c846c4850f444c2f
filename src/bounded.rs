//! Files of limited size.

use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

/// Most bytes of a file that has no limit of its own. A picture of the largest size that no encoder could compress
/// has as many.
pub const MOST: u64 = 1 << 30;

/// The bytes of a file of at most `most`. Reading stops at the bound, whatever length the file claims: a device
/// may have no end.
///
/// # Errors
/// Those of the system, and one that names the bound.
pub fn read(path: &Path, most: u64) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    File::open(path)?.take(most.saturating_add(1)).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > most {
        return Err(io::Error::other(format!("it is larger than {most} bytes")));
    }
    Ok(bytes)
}

/// As [`read`], for text.
///
/// # Errors
/// As [`read`], and for bytes that are no UTF-8.
pub fn read_text(path: &Path, most: u64) -> io::Result<String> {
    let bytes = read(path, most)?;
    String::from_utf8(bytes)
        .map_err(|_| io::Error::new(io::ErrorKind::InvalidData, "it is not text in UTF-8"))
}
