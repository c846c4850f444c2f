//! The positions that another program wrote: raw numbers, or text.

use std::fs;
use std::path::Path;

use crate::npy;
use drape::bounded;
use drape::error::{Error, Kind, Result};

/// The positions of one frame: x y z of each point in metres, row by row.
pub type State = Vec<[f64; 3]>;

/// The numbers in a file, and what it says of the grid.
#[derive(Clone, Debug, PartialEq)]
pub struct Numbers {
    /// The numbers, x y z of each point.
    pub numbers: Vec<f64>,
    /// Points in a row and rows, where the file says so.
    pub shape: Option<[usize; 2]>,
}

/// The numbers in a file: numpy's format, f64 little-endian, or decimal numbers separated by spaces, commas, brackets
/// or ends of lines. In a text, what follows `#` is ignored, and so are leading lines without a number.
///
/// # Errors
/// [`Kind::Io`] when the file cannot be read or does not hold numbers.
pub fn read_numbers(path: &Path) -> Result<Numbers> {
    let failed = failed(path);
    let bytes = bounded::read(path, bounded::MOST).map_err(|e| failed(e.to_string()))?;
    if bytes.starts_with(npy::MAGIC) {
        let (numbers, shape) = npy::decode(&bytes).map_err(failed)?;
        let grid = match shape.as_slice() {
            [.., height, width, 3] => Some([*width, *height]),
            _ => None,
        };
        return Ok(Numbers { numbers, shape: grid });
    }
    let numbers = match std::str::from_utf8(&bytes).ok().filter(|text| is_plain(text)) {
        Some(text) => numbers(text).map_err(failed)?,
        None => {
            let (numbers, rest) = bytes.as_chunks();
            if !rest.is_empty() {
                return Err(failed(format!("{} bytes are not numbers of 8 bytes each", bytes.len())));
            }
            numbers.iter().map(|&number| f64::from_le_bytes(number)).collect()
        }
    };
    Ok(Numbers { numbers, shape: None })
}

fn failed(path: &Path) -> impl Fn(String) -> Error + Copy + '_ {
    move |cause| Error::new(Kind::Io, format!("cannot read `{}`: {cause}", path.display()))
}

/// The states in a file, each of `width` x `height` points, as [`read_numbers`] reads it.
///
/// # Errors
/// As [`read_numbers`]; [`Kind::Io`] when the numbers are not those of whole states.
pub fn read(path: &Path, [width, height]: [usize; 2]) -> Result<Vec<State>> {
    let Numbers { numbers, shape } = read_numbers(path)?;
    let points = width * height;
    if let Some([w, h]) = shape.filter(|shape| *shape != [width, height]) {
        let message = format!("it holds {w} x {h} points, and the scene has {width} x {height}");
        return Err(failed(path)(message).with_help("numpy's shape is (rows, columns, 3)"));
    }
    if numbers.is_empty() || points == 0 || numbers.len() % (3 * points) != 0 {
        let found = numbers.len() as f64 / 3.0;
        let message = format!("it holds {found} points, and the scene has {width} x {height} = {points}");
        let size = fs::metadata(path).map_or(0, |file| file.len());
        let single = size > 0 && size.is_multiple_of(12 * points as u64);
        let help = if single {
            "its size is that of f32 numbers; write f64, since f32 hides small differences".to_owned()
        } else {
            format!("a state is x y z of each of {points} points, row by row")
        };
        return Err(failed(path)(message).with_help(help));
    }
    let triples: Vec<[f64; 3]> = numbers.as_chunks().0.to_vec();
    Ok(triples.chunks(points).map(<[_]>::to_vec).collect())
}

/// Whether a text has no control characters but white space.
fn is_plain(text: &str) -> bool {
    !text.chars().any(|c| c.is_control() && !c.is_whitespace())
}

/// The numbers of a text, or what is wrong with it.
fn numbers(text: &str) -> Result<Vec<f64>, String> {
    let mut numbers = Vec::new();
    for (number, line) in (1..).zip(text.trim_start_matches('\u{feff}').lines()) {
        // How C++ on Windows writes NaN.
        let line = line
            .replace("(ind)", "")
            .replace("(snan)", "")
            .replace("1.#IND", "nan")
            .replace("1.#QNAN", "nan");
        let line = line.split('#').next().unwrap_or(&line);
        let words = line.split(|c: char| c.is_whitespace() || ",;()[]{}".contains(c));
        let words: Vec<&str> = words.filter(|word| !word.is_empty()).collect();
        let values: Vec<Option<f64>> = words.iter().map(|word| word.parse().ok()).collect();
        if numbers.is_empty() && values.iter().all(Option::is_none) {
            continue;
        }
        for (value, word) in values.into_iter().zip(words) {
            numbers.push(value.ok_or_else(|| format!("line {number}: `{word}` is not a number"))?);
        }
    }
    Ok(numbers)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is read from a file of `bytes` for a cloth of so many points in a row.
    fn read_bytes(bytes: &[u8], points: usize) -> Result<Vec<State>> {
        let file = tempfile::NamedTempFile::new().unwrap();
        fs::write(file.path(), bytes).unwrap();
        read(file.path(), [points, 1])
    }

    #[test]
    fn raw_and_text_give_the_same_states() {
        let numbers = [1.0, -2.5, 3e-3, 4.0, 5.0, 0.1];
        let expected = Ok(vec![vec![[1.0, -2.5, 3e-3]], vec![[4.0, 5.0, 0.1]]]);
        assert_eq!(read_bytes(&numbers.map(f64::to_le_bytes).concat(), 1), expected);
        for text in [
            "1 -2.5 3e-3\n4,5, 0.1\n",
            "x y z\r\n# frame 0\r\n1\t-2.5\t3e-3\r\n4 5 0.1 # the end",
            "(1, -2.5, 3e-3)\n(4, 5, 0.1)\n",
            "[[1, -2.5, 3e-3], [4, 5, 0.1]]",
            "\u{feff}1 -2.5 3e-3 4 5 0.1",
        ] {
            assert_eq!(read_bytes(text.as_bytes(), 1), expected, "{text}");
        }
        for none in [&b"1 2 -nan(ind)"[..], b"1 2 -1.#IND"] {
            let nan = read_bytes(none, 1).unwrap();
            assert!(nan[0][0][2].is_nan(), "{nan:?}");
        }
    }

    #[test]
    fn what_holds_no_states_is_refused_with_the_reason() {
        let single = [1.0_f32; 6].map(f32::to_le_bytes).concat();
        for (bytes, points, reason) in [
            (&b"1 2 3 4"[..], 1, "1.3333333333333333 points"),
            (b"1 2 3", 2, "1 points, and the scene has 2 x 1 = 2"),
            (b"1 2 3\n4 5 x\n", 2, "line 2: `x` is not a number"),
            (b"x", 1, "0 points"),
            (b"", 1, "0 points"),
            (b"1 2 3", 0, "1 points"),
            (&[255; 9], 1, "9 bytes are not"),
            (&single, 2, "1 points, and the scene has 2 x 1 = 2"),
        ] {
            let error = read_bytes(bytes, points).unwrap_err();
            assert_eq!(error.kind, Kind::Io, "{bytes:?}");
            assert!(error.message.contains(reason), "{}", error.message);
        }
        let help = read_bytes(&single, 2).unwrap_err().help;
        assert!(help.contains("f32"), "{help}");
    }
}
