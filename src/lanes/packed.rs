//! Texels of 32 bits: numbers of one channel, or the three channels with 8 bits each. They are read into vectors with one
//! texel a lane.

use fearless_simd::{
    Bytes, Simd, SimdBase, SimdInt, f32x4, f32x8, f32x16, i32x4, i32x8, i32x16, u8x64, u64x2, u64x4, u64x8,
};

use super::texels::{mix, square};

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

macro_rules! plane {
    ($plane:ident, $around:ident, $vector:ident, $whole:ident, $pairs:ident, $width:literal) => {
        /// The texels at `places`, those to their right, and both `down` further on. Neighbours are read as one number of
        /// 64 bits.
        #[inline(always)]
        fn $around<S: Simd, T: Copy>(
            texels: &[T],
            bits: impl Fn(T) -> u32,
            places: $whole<S>,
            down: u32,
        ) -> [$whole<S>; 4] {
            let (simd, places) = (places.simd, places.to_array());
            let (mut tops, mut bottoms) = ([[0; $width / 2]; 2], [[0; $width / 2]; 2]);
            for k in 0..$width {
                let [a, b, c, d] = square(texels, places[k], down);
                let (half, at) = (k / ($width / 2), k % ($width / 2));
                (tops[half][at], bottoms[half][at]) = (pair(bits(a), bits(b)), pair(bits(c), bits(d)));
            }
            let mut around = [$whole::splat(simd, 0); 4];
            for (two, [low, high]) in around.chunks_exact_mut(2).zip([tops, bottoms]) {
                let low = $pairs::load_array(simd, low).bitcast::<$whole<S>>();
                let high = $pairs::load_array(simd, high).bitcast::<$whole<S>>();
                (two[0], two[1]) = (low.unzip_low(high), low.unzip_high(high));
            }
            around
        }

        /// One channel alone.
        #[inline(always)]
        pub(super) fn $plane<S: Simd>(
            texels: &[f32],
            places: $whole<S>,
            down: u32,
            [right, lower]: [$vector<S>; 2],
        ) -> $vector<S> {
            let [a, b, c, d] = $around(
                texels,
                #[inline(always)]
                |texel| texel.to_bits(),
                places,
                down,
            );
            let (a, b) = (a.bitcast::<$vector<S>>(), b.bitcast::<$vector<S>>());
            let (c, d) = (c.bitcast::<$vector<S>>(), d.bitcast::<$vector<S>>());
            mix!(mix!(a, b, right), mix!(c, d, right), lower)
        }
    };
}
plane!(bilinear_plane_4, around_4, f32x4, i32x4, u64x2, 4);
plane!(bilinear_plane_8, around_8, f32x8, i32x8, u64x4, 8);
plane!(bilinear_plane_16, around_16, f32x16, i32x16, u64x8, 16);

/// Red, green and blue of packed texels.
#[inline(always)]
pub(super) fn bilinear_packed<S: Simd>(
    texels: &[u32],
    places: i32x16<S>,
    down: u32,
    [right, lower]: [f32x16<S>; 2],
) -> [f32x16<S>; 3] {
    let around = around_16(
        texels,
        #[inline(always)]
        |texel| texel,
        places,
        down,
    );
    let mut rgb = [right; 3];
    for (channel, twice) in rgb.iter_mut().zip(TWICE) {
        let twice = u8x64::load_array(places.simd, twice);
        let mut numbers = [right; 4];
        for (number, texel) in numbers.iter_mut().zip(around) {
            *number = texel.swizzle_dyn_within_blocks(twice).to_float();
            *number += *number * BEYOND;
        }
        let [a, b, c, d] = numbers;
        // A power of two more or less changes no rounding.
        *channel = mix!(mix!(a, b, right), mix!(c, d, right), lower) * (1.0 / 65536.0);
    }
    rgb
}

/// Two numbers in the order in which a vector of numbers of 64 bits has them.
#[inline(always)]
fn pair(first: u32, second: u32) -> u64 {
    u64::from(first) | u64::from(second) << 32
}
