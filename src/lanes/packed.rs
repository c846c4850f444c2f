//! Texels with 8 bits a channel, one in each lane.

use fearless_simd::{
    Bytes, Simd, SimdBase, SimdInt, f32x4, f32x8, f32x16, i32x4, i32x8, i32x16, u8x16, u8x32, u8x64, u64x2,
    u64x4, u64x8,
};

use super::{
    Places,
    texels::{mix, pair, square},
};

/// A channel of 8 bits, c, is 257·c with this part of it more, over 65536: that is c/255, rounded to f32 once. 257·c is
/// exact, and 65536/255 = 257·(1 + 1/65535). A test goes through all of them.
const BEYOND: f32 = 1.0 / 65535.0;

/// Byte indices that make 257·c of byte k of every number of 32 bits: twice that byte, and zeros above.
const TWICE: [[u8; 64]; 3] = {
    let mut indices = [[0x80; 64]; 3];
    let mut i = 0;
    #[expect(clippy::cast_possible_truncation, reason = "less than 16")]
    while i < 192 {
        if i % 4 < 2 {
            indices[i / 64][i % 64] = (i % 16 / 4 * 4 + i / 64) as u8;
        }
        i += 1;
    }
    indices
};

macro_rules! packed {
    ($around:ident, $bilinear:ident, $vector:ident, $whole:ident, $pairs:ident, $bytes:ident, $width:literal, $kept:literal) => {
        /// The texels at `places`, those to their right, and both `down` further on. Neighbours are read as one
        /// number of 64 bits.
        #[inline(always)]
        pub(super) fn $around<S: Simd>(
            simd: S,
            texels: &[u32],
            places: &Places,
            down: u32,
        ) -> [$whole<S>; 4] {
            let (mut tops, mut bottoms) = ([[0; $width / 2]; 2], [[0; $width / 2]; 2]);
            for k in 0..$width {
                let [a, b, c, d] = square(texels, places[k], down);
                let (half, at) = (k / ($width / 2), k % ($width / 2));
                (tops[half][at], bottoms[half][at]) = (pair(a, b), pair(c, d));
            }
            let mut around = [$whole::splat(simd, 0); 4];
            for (two, [low, high]) in around.chunks_exact_mut(2).zip([tops, bottoms]) {
                let low = $pairs::load_array(simd, low).bitcast::<$whole<S>>();
                let high = $pairs::load_array(simd, high).bitcast::<$whole<S>>();
                (two[0], two[1]) = (low.unzip_low(high), low.unzip_high(high));
            }
            around
        }

        /// `Part::bilinear` between them.
        #[inline(always)]
        pub(super) fn $bilinear<S: Simd>(
            around: [$whole<S>; 4],
            [right, lower]: [$vector<S>; 2],
        ) -> [$vector<S>; 3] {
            let mut rgb = [right; 3];
            for (channel, twice) in rgb.iter_mut().zip(TWICE) {
                let twice = $bytes::from_slice(right.simd, &twice[..4 * $width]);
                let mut numbers = [right; 4];
                for (number, texel) in numbers.iter_mut().zip(around) {
                    *number = (texel.swizzle_dyn_within_blocks(twice) & $kept).to_float();
                    *number += *number * BEYOND;
                }
                let [a, b, c, d] = numbers;
                // A power of two more or less changes no rounding.
                *channel = mix!(mix!(a, b, right), mix!(c, d, right), lower) * (1.0 / 65536.0);
            }
            rgb
        }
    };
}
// An index above 127 makes a zero of vectors of 512 bits, but not on every CPU: others keep only what is right.
packed!(packed_around_4, bilinear_packed_4, f32x4, i32x4, u64x2, u8x16, 4, 0xFFFF);
packed!(packed_around_8, bilinear_packed_8, f32x8, i32x8, u64x4, u8x32, 8, 0xFFFF);
packed!(packed_around_16, bilinear_packed_16, f32x16, i32x16, u64x8, u8x64, 16, -1);
