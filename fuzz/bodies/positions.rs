//! Files of positions: numpy's format, raw numbers, or text.

use std::fs;

use drape::cloth::Points;
use drape::error::Kind;
use drape_lab::grader::{Numbers, Pair, read, read_numbers};
use drape_lab::npy;
use tempfile::NamedTempFile;

/// Reads the bytes as a file of positions; the first two say how many points the scene has.
pub(crate) fn run(bytes: &[u8]) {
    let [width, height, content @ ..] = bytes else { return };
    let grid = [width, height].map(|&length| usize::from(length % 8));
    let file = NamedTempFile::new().expect("a temporary file");
    fs::write(file.path(), content).expect("a file is written");

    let read = read(file.path(), grid);
    let numbers = match read_numbers(file.path()) {
        Ok(numbers) => numbers,
        Err(error) => {
            assert_eq!((error.kind, read), (Kind::Io, Err(error)));
            return;
        }
    };
    match read {
        Ok(states) => {
            let points = states.iter().flatten().flatten();
            assert!(points.copied().map(f64::to_bits).eq(numbers.numbers.iter().copied().map(f64::to_bits)));
            assert!(states.iter().all(|state| state.len() == grid[0] * grid[1]));
        }
        Err(error) => assert_eq!(error.kind, Kind::Io, "{error:?}"),
    }
    if let Ok(pair) = Pair::new(&numbers, &numbers, 0.0) {
        assert_eq!((pair.points * 3, pair.differing), (numbers.numbers.len(), 0));
        assert!(!pair.text().is_empty());
    }
    written_again(&numbers, &file);
}

/// What was read has the same bits when it is written as our own files are and read again.
fn written_again(found: &Numbers, file: &NamedTempFile) {
    let (triples, rest) = found.numbers.as_chunks::<3>();
    if !rest.is_empty() || triples.is_empty() {
        return;
    }
    let component = |axis: usize| triples.iter().map(|point| point[axis]).collect();
    let points = Points { x: component(0), y: component(1), z: component(2) };
    let shape = found.shape.filter(|[width, height]| width * height == triples.len());
    let shape = shape.unwrap_or([triples.len(), 1]);
    fs::write(file.path(), npy::encode(&points, shape)).expect("a file is written");
    let again = read_numbers(file.path()).expect("our own file is read");
    assert!(again.numbers.iter().map(|x| x.to_bits()).eq(found.numbers.iter().map(|x| x.to_bits())));
    assert_eq!(again.shape, Some(shape));
}
