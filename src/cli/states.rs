//! Positions that another program wrote: raw numbers, or text.

use std::fs;
use std::path::Path;

use crate::error::{Error, Kind, Result};

/// Point after point, x y z in metres.
pub(super) type State = Vec<[f64; 3]>;

/// The states in a file, each of `points` points: f64 little-endian, or decimal numbers between spaces,
/// commas or ends of lines.
///
/// # Errors
/// [`Kind::Io`] when the file cannot be read or does not hold whole states.
pub(super) fn read(path: &Path, points: usize) -> Result<Vec<State>> {
    let failed = |cause: String| Error::new(Kind::Io, format!("cannot read `{}`: {cause}", path.display()));
    let bytes = fs::read(path).map_err(|e| failed(e.to_string()))?;
    let numbers = text(&bytes).or_else(|| raw(&bytes)).ok_or_else(|| {
        failed(format!("{} bytes are neither numbers of 8 bytes nor text of numbers", bytes.len()))
    })?;
    if points == 0 || numbers.is_empty() || numbers.len() % (3 * points) != 0 {
        let help = format!("a state is x y z of each of {points} points, row by row");
        let found = format!("it holds {} numbers, which are no states of {points} points", numbers.len());
        return Err(failed(found).with_help(help));
    }
    let triples: Vec<[f64; 3]> = numbers.as_chunks().0.to_vec();
    Ok(triples.chunks(points).map(<[_]>::to_vec).collect())
}

/// The numbers of a text; none if it is not one.
fn text(bytes: &[u8]) -> Option<Vec<f64>> {
    let text = std::str::from_utf8(bytes).ok()?;
    let words = text.split(|c: char| c.is_whitespace() || c == ',').filter(|word| !word.is_empty());
    words.map(|word| word.parse().ok()).collect()
}

fn raw(bytes: &[u8]) -> Option<Vec<f64>> {
    let (numbers, rest) = bytes.as_chunks();
    rest.is_empty().then(|| numbers.iter().map(|&number| f64::from_le_bytes(number)).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn raw_and_text_give_the_same_states() {
        let file = tempfile::NamedTempFile::new().unwrap();
        let states = [1.0, -2.5, 3e-3, 4.0, 5.0, 0.1];
        let expected = vec![vec![[1.0, -2.5, 3e-3]], vec![[4.0, 5.0, 0.1]]];
        fs::write(file.path(), states.map(f64::to_le_bytes).concat()).unwrap();
        assert_eq!(read(file.path(), 1), Ok(expected.clone()));
        fs::write(file.path(), "1 -2.5 3e-3\n4,5, 0.1\n").unwrap();
        assert_eq!(read(file.path(), 1), Ok(expected));
        for (bytes, points) in
            [(&b"1 2 3 4"[..], 1), (b"1 2 3", 2), (b"x", 1), (b"", 1), (b"1 2 3", 0), (&[255; 9], 1)]
        {
            fs::write(file.path(), bytes).unwrap();
            assert_eq!(read(file.path(), points).unwrap_err().kind, Kind::Io, "{bytes:?}");
        }
    }
}
