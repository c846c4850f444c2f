//! Texels mixed as they are stored, red, green and blue at once.
//!
//! A vector has the texels of one fragment, or of two side by side: what is mixed needs no shuffles, and only the
//! result is turned into a vector for each channel.

use fearless_simd::{
    Bytes, Simd, SimdBase, SimdCombine, SimdSplit, f32x4, f32x8, f32x16, i32x4, i32x8, i32x16, u8x32, u64x2,
    u64x4, u64x8,
};

use super::packed::bilinear_packed;

/// Byte indices that put number k of four into all four places, in both halves of a vector.
const FOUR_TIMES: [[u8; 32]; 4] = {
    let mut indices = [[0; 32]; 4];
    let mut i = 0;
    #[expect(clippy::cast_possible_truncation, reason = "less than 16")]
    while i < 128 {
        indices[i / 32][i % 32] = (4 * (i / 32) + i % 4) as u8;
        i += 1;
    }
    indices
};

/// A picture as bilinear look-ups read it.
#[derive(Clone, Copy, Debug)]
pub struct Texels<'a> {
    /// Red, green, blue, and a number that is not read.
    pub full: &'a [[f32; 4]],
    /// The same with 8 bits a channel, red lowest, where each number of `full` is a multiple of 1/255.
    pub packed: Option<&'a [u32]>,
}

/// `mix(a, b, f)` as a + (b - a)·f, which gives a exactly when a = b.
macro_rules! mix {
    ($a:expr, $b:expr, $f:expr) => {
        $a + ($b - $a) * $f
    };
}
pub(super) use mix;

/// The texel at `place`, the one to its right, and both `down` further on.
#[inline(always)]
pub(super) fn square<T: Copy>(texels: &[T], place: i32, down: u32) -> [T; 4] {
    let (first, down) = (place.cast_unsigned() as usize, down as usize);
    // One check for all four.
    let texels = &texels[first..first + down + 2];
    [texels[0], texels[1], texels[down], texels[down + 1]]
}

/// Four fragments, one after the other. The weights are those of the right texel and of the lower one.
#[inline(always)]
pub(super) fn bilinear_4<S: Simd>(
    texels: Texels<'_>,
    places: i32x4<S>,
    down: u32,
    [right, lower]: [f32x4<S>; 2],
) -> [f32x4<S>; 3] {
    let simd = places.simd;
    let (places, right, lower) = (places.to_array(), right.to_array(), lower.to_array());
    let mut mixed = [f32x4::splat(simd, 0.0); 4];
    for (k, mixed) in mixed.iter_mut().enumerate() {
        let [a, b, c, d] = square(texels.full, places[k], down);
        let (a, b) = (f32x4::load_array(simd, a), f32x4::load_array(simd, b));
        let (c, d) = (f32x4::load_array(simd, c), f32x4::load_array(simd, d));
        *mixed = mix!(mix!(a, b, right[k]), mix!(c, d, right[k]), lower[k]);
    }
    transpose(mixed)
}

/// Eight fragments in four pairs: k and k + 4.
#[inline(always)]
pub(super) fn bilinear_8<S: Simd>(
    texels: Texels<'_>,
    places: i32x8<S>,
    down: u32,
    [right, lower]: [f32x8<S>; 2],
) -> [f32x8<S>; 3] {
    let (simd, places) = (places.simd, places.to_array());
    let (mut lows, mut highs) = ([f32x4::splat(simd, 0.0); 4], [f32x4::splat(simd, 0.0); 4]);
    for k in 0..4 {
        let [a, b, c, d] = square(texels.full, places[k], down);
        let [more_a, more_b, more_c, more_d] = square(texels.full, places[k + 4], down);
        let (a, b) = (side_by_side(simd, a, more_a), side_by_side(simd, b, more_b));
        let (c, d) = (side_by_side(simd, c, more_c), side_by_side(simd, d, more_d));
        let four_times = u8x32::load_array(simd, FOUR_TIMES[k]);
        let right = right.swizzle_dyn_within_blocks(four_times);
        let lower = lower.swizzle_dyn_within_blocks(four_times);
        (lows[k], highs[k]) = mix!(mix!(a, b, right), mix!(c, d, right), lower).split();
    }
    let ([r, g, b], [more_r, more_g, more_b]) = (transpose(lows), transpose(highs));
    [r.combine(more_r), g.combine(more_g), b.combine(more_b)]
}

/// Two texels in one vector.
#[inline(always)]
fn side_by_side<S: Simd>(simd: S, low: [f32; 4], high: [f32; 4]) -> f32x8<S> {
    f32x4::load_array(simd, low).combine(f32x4::load_array(simd, high))
}

/// Sixteen fragments, eight after eight: wider vectors would have fewer ports to run on.
#[inline(always)]
pub(super) fn bilinear_16<S: Simd>(
    texels: Texels<'_>,
    places: i32x16<S>,
    down: u32,
    [right, lower]: [f32x16<S>; 2],
) -> [f32x16<S>; 3] {
    if let Some(packed) = texels.packed {
        return bilinear_packed(packed, places, down, [right, lower]);
    }
    let (places, right, lower) = (places.split(), right.split(), lower.split());
    let [r, g, b] = bilinear_8(texels, places.0, down, [right.0, lower.0]);
    let [more_r, more_g, more_b] = bilinear_8(texels, places.1, down, [right.1, lower.1]);
    [r.combine(more_r), g.combine(more_g), b.combine(more_b)]
}

/// Red, green and blue of four texels.
#[inline(always)]
pub(super) fn transpose<S: Simd>([a, b, c, d]: [f32x4<S>; 4]) -> [f32x4<S>; 3] {
    let (even, odd) = (a.zip_low(c), b.zip_low(d));
    [even.zip_low(odd), even.zip_high(odd), a.zip_high(c).zip_low(b.zip_high(d))]
}

macro_rules! bilinear_plane {
    ($name:ident, $vector:ident, $whole:ident, $pairs:ident, $width:literal) => {
        /// One channel alone. Neighbours are read as one number of 64 bits.
        #[inline(always)]
        pub(super) fn $name<S: Simd>(
            texels: &[f32],
            places: $whole<S>,
            down: u32,
            [right, lower]: [$vector<S>; 2],
        ) -> $vector<S> {
            let (simd, places) = (places.simd, places.to_array());
            let (mut tops, mut bottoms) = ([[0; $width / 2]; 2], [[0; $width / 2]; 2]);
            for k in 0..$width {
                let [a, b, c, d] = square(texels, places[k], down);
                let (half, at) = (k / ($width / 2), k % ($width / 2));
                (tops[half][at], bottoms[half][at]) = (pair(a, b), pair(c, d));
            }
            let mut rows = [right; 2];
            for (row, [low, high]) in rows.iter_mut().zip([tops, bottoms]) {
                let low = $pairs::load_array(simd, low).bitcast::<$vector<S>>();
                let high = $pairs::load_array(simd, high).bitcast::<$vector<S>>();
                *row = mix!(low.unzip_low(high), low.unzip_high(high), right);
            }
            let [top, bottom] = rows;
            mix!(top, bottom, lower)
        }
    };
}
bilinear_plane!(bilinear_plane_4, f32x4, i32x4, u64x2, 4);
bilinear_plane!(bilinear_plane_8, f32x8, i32x8, u64x4, 8);
bilinear_plane!(bilinear_plane_16, f32x16, i32x16, u64x8, 16);

/// Two numbers in the order in which a vector of numbers of 64 bits has them.
#[inline(always)]
fn pair(first: f32, second: f32) -> u64 {
    u64::from(first.to_bits()) | u64::from(second.to_bits()) << 32
}
