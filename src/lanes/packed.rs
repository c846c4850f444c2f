//! Texels with 8 bits a channel, sixteen at a time: one texel in a lane.

use fearless_simd::{Bytes, Simd, SimdBase, SimdInt, f32x16, i32x16, u8x64, u64x8};

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

/// `Part::bilinear` of packed texels.
#[inline(always)]
pub(super) fn bilinear_packed<S: Simd>(
    texels: &[u32],
    places: i32x16<S>,
    down: u32,
    [right, lower]: [f32x16<S>; 2],
) -> [f32x16<S>; 3] {
    let around = around(texels, places, down);
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

/// The texels at `places`, those to their right, and both `down` further on. Neighbours are read as one number of 64 bits.
#[inline(always)]
fn around<S: Simd>(texels: &[u32], places: i32x16<S>, down: u32) -> [i32x16<S>; 4] {
    let (simd, places) = (places.simd, places.to_array());
    let (mut tops, mut bottoms) = ([[0; 8]; 2], [[0; 8]; 2]);
    for (k, place) in places.into_iter().enumerate() {
        let [a, b, c, d] = square(texels, place, down);
        (tops[k / 8][k % 8], bottoms[k / 8][k % 8]) = (pair(a, b), pair(c, d));
    }
    let mut around = [i32x16::splat(simd, 0); 4];
    for (two, [low, high]) in around.chunks_exact_mut(2).zip([tops, bottoms]) {
        let low = u64x8::load_array(simd, low).bitcast::<i32x16<S>>();
        let high = u64x8::load_array(simd, high).bitcast::<i32x16<S>>();
        (two[0], two[1]) = (low.unzip_low(high), low.unzip_high(high));
    }
    around
}

/// Two texels in the order in which a vector of numbers of 64 bits has them.
#[inline(always)]
fn pair(first: u32, second: u32) -> u64 {
    u64::from(first) | u64::from(second) << 32
}
