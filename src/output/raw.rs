//! Numbers as raw bytes, little-endian, without a header.

/// Points as x y z, one after the other: 24 bytes a point. The slices are equally long.
pub fn points(x: &[f64], y: &[f64], z: &[f64]) -> Vec<u8> {
    x.iter().zip(y).zip(z).flat_map(|((x, y), z)| [*x, *y, *z]).flat_map(f64::to_le_bytes).collect()
}

/// Depths, or distances, as binary32.
pub fn depths(values: &[f32]) -> Vec<u8> {
    values.iter().flat_map(|value| value.to_le_bytes()).collect()
}

/// Object and triangle numbers as 32-bit unsigned integers.
pub fn ids(values: &[u32]) -> Vec<u8> {
    values.iter().flat_map(|value| value.to_le_bytes()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_are_interleaved_and_little_endian() {
        let bytes = points(&[1.0, -0.0], &[2.0, 5e-324], &[3.0, f64::MAX]);
        let back: Vec<u64> =
            bytes.chunks_exact(8).map(|b| u64::from_le_bytes(b.try_into().unwrap())).collect();
        let expected = [1.0, 2.0, 3.0, -0.0, 5e-324, f64::MAX].map(f64::to_bits);
        assert_eq!(back, expected);
        assert_eq!(bytes[..8], [0, 0, 0, 0, 0, 0, 0xF0, 0x3F]);
    }

    #[test]
    fn depths_and_ids_are_four_bytes_each() {
        assert_eq!(depths(&[1.0, 0.5]), [0, 0, 0x80, 0x3F, 0, 0, 0, 0x3F]);
        assert_eq!(ids(&[0x0100_0002]), [2, 0, 0, 1]);
    }
}
