//! Colours are stored as round-half-even(255·clamp(c, 0, 1)); NaN is 0.

use crate::support::{Canvas, flat};
use drape::raster::{self, Framebuffer, Primitives};

const FULL: [[f32; 4]; 4] =
    [[-1.0, -1.0, 0.0, 1.0], [1.0, -1.0, 0.0, 1.0], [1.0, 1.0, 0.0, 1.0], [-1.0, 1.0, 0.0, 1.0]];

/// What a fragment of colour `c` is stored as, with any number of samples, and as background.
fn stored(c: f32) -> u8 {
    let quad = || [flat(Primitives::Triangles(&[[0, 1, 2], [2, 3, 0]]), &FULL, [c; 3])];
    let mut results = Vec::new();
    for samples in [1, 4, 8, 16] {
        results.extend(Canvas::new(3, 3).samples(samples).draw(&quad()).rgb[4]);
        let mut framebuffer = Framebuffer::new(1, 1, samples);
        raster::draw(&mut framebuffer, [c; 3], &[], false);
        results.extend(framebuffer.rgb());
    }
    assert!(results.iter().all(|&byte| byte == results[0]), "{c}: {results:?}");
    results[0]
}

#[test]
fn every_byte_comes_back() {
    for byte in 0..=255_u8 {
        assert_eq!(stored(f32::from(byte) / 255.0), byte);
    }
}

#[test]
fn midpoints_go_to_the_even_neighbour_and_their_neighbours_to_theirs() {
    let mut exact = 0;
    for byte in 0..255_u8 {
        // The f32 nearest to the midpoint; 255 times it is rounded once more.
        let middle = (f32::from(byte) + 0.5) / 255.0;
        if 255.0 * middle == f32::from(byte) + 0.5 {
            assert_eq!(stored(middle), byte + byte % 2, "midpoint above {byte}");
            exact += 1;
        }
        assert_eq!(stored(middle - 1e-5), byte, "below the midpoint above {byte}");
        assert_eq!(stored(middle + 1e-5), byte + 1, "above the midpoint above {byte}");
    }
    assert!(exact > 200, "{exact} midpoints are numbers in f32");
}

#[test]
fn what_is_out_of_range_is_clamped_and_nan_is_black() {
    for (c, byte) in [
        (-0.0, 0),
        (-1e-3, 0),
        (f32::NEG_INFINITY, 0),
        (f32::NAN, 0),
        (1e-45, 0),
        (1.0, 255),
        (1.001, 255),
        (1e30, 255),
        (f32::INFINITY, 255),
    ] {
        assert_eq!(stored(c), byte, "{c}");
    }
}
