//! Positions in the format of numpy (`.npy`, version 1.0): an array of shape (H, W, 3), f64 little-endian.

use drape::cloth::Points;

/// The first bytes of every such file.
pub(crate) const MAGIC: &[u8] = b"\x93NUMPY";

/// What the length of everything before the numbers is a multiple of.
const ALIGNMENT: usize = 64;

/// The file of the positions of a grid of `width` x `height` points.
pub fn encode(points: &Points, [width, height]: [usize; 2]) -> Vec<u8> {
    let text = format!("{{'descr': '<f8', 'fortran_order': False, 'shape': ({height}, {width}, 3), }}");
    // Magic, version and length are ten bytes; the text is filled up with spaces and ends in a line feed.
    let length = (MAGIC.len() + 4 + text.len() + 1).next_multiple_of(ALIGNMENT) - MAGIC.len() - 4;
    let size = u16::try_from(length).unwrap_or(u16::MAX).to_le_bytes();
    let mut bytes = [MAGIC, &[1, 0], &size].concat();
    bytes.extend(format!("{text:<width$}\n", width = length - 1).bytes());
    bytes.extend(drape::output::raw::points(&points.x, &points.y, &points.z));
    bytes
}

/// The numbers of a file and the lengths of its axes.
///
/// # Errors
/// What is wrong with it, in words.
pub(crate) fn decode(bytes: &[u8]) -> Result<(Vec<f64>, Vec<usize>), String> {
    let short = || "the .npy file is not whole".to_owned();
    let (start, size) = match bytes.get(MAGIC.len()).copied().ok_or_else(short)? {
        1 => (10, bytes.get(8..10).map(|size| size.iter().rev().fold(0, |n, &b| n << 8 | usize::from(b)))),
        _ => (12, bytes.get(8..12).map(|size| size.iter().rev().fold(0, |n, &b| n << 8 | usize::from(b)))),
    };
    let end = start + size.ok_or_else(short)?;
    let text = String::from_utf8_lossy(bytes.get(start..end).ok_or_else(short)?).into_owned();
    if !text.contains("'<f8'") {
        return Err(
            "the .npy file is not of f64 little-endian numbers ('<f8'): write array.astype('<f8')".into()
        );
    }
    if !text.contains("'fortran_order': False") {
        return Err("the .npy file is in Fortran's order: write numpy.ascontiguousarray(array)".into());
    }
    let shape = text.split_once("'shape': (").and_then(|(_, rest)| rest.split_once(')'));
    let shape = shape.ok_or_else(short)?.0.split(',').map(str::trim).filter(|length| !length.is_empty());
    let shape: Vec<usize> = shape.map(str::parse).collect::<Result<_, _>>().map_err(|_| short())?;
    let (numbers, rest) = bytes[end..].as_chunks::<8>();
    let expected = shape.iter().try_fold(1_usize, |product, &length| product.checked_mul(length));
    if expected != Some(numbers.len()) || !rest.is_empty() {
        return Err(short());
    }
    Ok((numbers.iter().map(|&number| f64::from_le_bytes(number)).collect(), shape))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The header is the one that numpy 1.26 writes for an array of this shape.
    #[test]
    fn the_header_is_that_of_numpy() {
        let points = Points { x: vec![1.0; 6], y: vec![2.0; 6], z: vec![3.0; 6] };
        let bytes = encode(&points, [3, 2]);
        let text = "{'descr': '<f8', 'fortran_order': False, 'shape': (2, 3, 3), }";
        assert_eq!(bytes[..10], *b"\x93NUMPY\x01\x00\x76\x00");
        assert_eq!(String::from_utf8_lossy(&bytes[10..128]), format!("{text:<117}\n"));
        assert_eq!(bytes.len(), 128 + 6 * 24);
        let (numbers, shape) = decode(&bytes).unwrap();
        assert_eq!((numbers.len(), &numbers[..3], shape), (18, &[1.0, 2.0, 3.0][..], vec![2, 3, 3]));
        for end in 6..bytes.len() {
            assert!(decode(&bytes[..end]).is_err(), "cut to {end} bytes");
        }
    }
}
