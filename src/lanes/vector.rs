//! One vector of 4, 8 or 16 numbers.

use fearless_simd::{
    Bytes, Select, Simd, SimdBase, SimdCombine, SimdFloat, SimdMask, SimdNarrow, f32x4, f32x8, f32x16, f64x2,
    f64x4, f64x8, i32x4, i32x8, i32x16, u32x4, u32x8, u32x16,
};

use super::{
    FragmentLanes, Lane, Pair, Part, Texels, Whole, is_its_only_part,
    scalar::WHOLE_STEPS,
    texels::{
        bilinear_4, bilinear_8, bilinear_16, bilinear_plane_4, bilinear_plane_8, bilinear_plane_16, transpose,
    },
};

macro_rules! vector {
    ($vector:ident, $double:ident, $whole:ident, $key:ident, $width:literal, $transpose:ident, $bilinear:ident, $plane:ident) => {
        impl<S: FragmentLanes> Lane for $vector<S> {
            type Token = S;
            is_its_only_part!();

            #[inline(always)]
            fn splat(token: S, value: f32) -> Self {
                SimdBase::splat(token, value)
            }
            #[inline(always)]
            fn token(self) -> S {
                self.simd
            }
            #[inline(always)]
            fn sqrt(self) -> Self {
                SimdFloat::sqrt(self)
            }
            #[inline(always)]
            fn floor(self) -> Self {
                SimdFloat::floor(self)
            }
            #[inline(always)]
            fn select_less(self, other: Self, then: Self, otherwise: Self) -> Self {
                self.simd_lt(other).select(then, otherwise)
            }
            #[inline(always)]
            fn max(self, other: Self) -> Self {
                if S::ORDERED_MAX { SimdBase::max(self, other) } else { other.select_less(self, self, other) }
            }
            #[inline(always)]
            fn min(self, other: Self) -> Self {
                if S::ORDERED_MAX { SimdBase::min(self, other) } else { self.select_less(other, self, other) }
            }
        }

        impl<S: FragmentLanes> Part for $vector<S> {
            const WIDTH: usize = $width;
            const PACKED: bool = $width == 16;
            type Double = Pair<$double<S>>;
            type Whole = $whole<S>;

            #[inline(always)]
            fn from_fn(token: S, mut f: impl FnMut(usize) -> f32) -> Self {
                let mut lanes = [0.0; $width];
                for (i, lane) in lanes.iter_mut().enumerate() {
                    *lane = f(i);
                }
                SimdBase::load_array(token, lanes)
            }
            #[inline(always)]
            fn lane(self, index: usize) -> f64 {
                self[index].into()
            }
            #[inline(always)]
            fn store(self, out: &mut [f32]) {
                self.store_slice(&mut out[..$width]);
            }
            #[inline(always)]
            fn double(token: S, value: f64) -> Self::Double {
                let same = $double::splat(token, value);
                Pair(same, same)
            }
            #[inline(always)]
            fn double_from_fn(token: S, mut f: impl FnMut(usize) -> f64) -> Self::Double {
                let (mut low, mut high) = ([0.0; $width / 2], [0.0; $width / 2]);
                for i in 0..$width / 2 {
                    low[i] = f(i);
                    high[i] = f(i + $width / 2);
                }
                Pair($double::load_array(token, low), $double::load_array(token, high))
            }
            #[inline(always)]
            fn narrow(double: Self::Double) -> Self {
                double.0.narrow(double.1)
            }
            #[inline(always)]
            fn to_whole(self) -> $whole<S> {
                self.to_int_precise()
            }
            #[inline(always)]
            fn store_rgba8([red, green, blue]: [Self; 3], out: &mut [u32]) {
                // The addition rounds, and leaves the result in the low bits. What is in the top byte beside it is
                // shifted out, or overwritten.
                let red = (red * 255.0 + WHOLE_STEPS).bitcast::<$key<S>>();
                let green = (green * 255.0 + WHOLE_STEPS).bitcast::<$key<S>>();
                let blue = (blue * 255.0 + WHOLE_STEPS).bitcast::<$key<S>>();
                let packed = red | green << 8 | blue << 16 | 255 << 24;
                packed.store_slice(&mut out[..$width]);
            }
            #[inline(always)]
            #[expect(clippy::cast_possible_truncation, reason = "at most 16 lanes")]
            fn lanes_with(token: S, keys: &[u32], key: u32) -> u32 {
                $key::from_slice(token, &keys[..$width]).simd_eq($key::splat(token, key)).to_bitmask() as u32
            }
            #[inline(always)]
            #[expect(clippy::cast_possible_truncation, reason = "at most 16 lanes")]
            fn lanes_less(self, other: Self) -> u32 {
                self.simd_lt(other).to_bitmask() as u32
            }
            #[inline(always)]
            fn replace(self, keys: &[u32], key: u32, other: Self) -> Self {
                let keys = $key::from_slice(self.simd, &keys[..$width]);
                keys.simd_eq($key::splat(self.simd, key)).select(other, self)
            }
            #[inline(always)]
            fn transpose(token: S, mut texel: impl FnMut(usize) -> [f32; 4]) -> [Self; 3] {
                $transpose(token, 0, &mut texel)
            }
            #[inline(always)]
            fn whole_if_small(self) -> $whole<S> {
                self.to_int()
            }
            #[inline(always)]
            fn bilinear(texels: Texels<'_>, places: $whole<S>, down: u32, weights: [Self; 2]) -> [Self; 3] {
                $bilinear(texels, places, down, weights)
            }
            #[inline(always)]
            fn bilinear_plane(texels: &[f32], places: $whole<S>, down: u32, weights: [Self; 2]) -> Self {
                $plane(texels, places, down, weights)
            }
        }

        impl<S: Simd> Whole for $whole<S> {
            #[inline(always)]
            fn all(self, value: i32) -> Self {
                SimdBase::splat(self.simd, value)
            }
            #[inline(always)]
            fn min(self, other: Self) -> Self {
                SimdBase::min(self, other)
            }
            #[inline(always)]
            fn max(self, other: Self) -> Self {
                SimdBase::max(self, other)
            }
            #[inline(always)]
            fn select_equal(self, other: Self, then: Self, otherwise: Self) -> Self {
                self.simd_eq(other).select(then, otherwise)
            }
            #[inline(always)]
            fn within(self, end: i32) -> bool {
                (self.simd_ge(0) & self.simd_lt(end)).all_true()
            }
            #[inline(always)]
            fn each(self, mut f: impl FnMut(i32) -> i32) -> Self {
                let mut lanes = self.to_array();
                for lane in &mut lanes {
                    *lane = f(*lane);
                }
                SimdBase::load_array(self.simd, lanes)
            }
            #[inline(always)]
            fn lane(self, index: usize) -> i32 {
                self[index]
            }
        }
    };
}
vector!(f32x4, f64x2, i32x4, u32x4, 4, transpose_4, bilinear_4, bilinear_plane_4);
vector!(f32x8, f64x4, i32x8, u32x8, 8, transpose_8, bilinear_8, bilinear_plane_8);
vector!(f32x16, f64x8, i32x16, u32x16, 16, transpose_16, bilinear_16, bilinear_plane_16);

/// Red, green and blue of the texels `first..first + 4`.
#[inline(always)]
fn transpose_4<S: Simd>(token: S, first: usize, texel: &mut impl FnMut(usize) -> [f32; 4]) -> [f32x4<S>; 3] {
    transpose([
        f32x4::load_array(token, texel(first)),
        f32x4::load_array(token, texel(first + 1)),
        f32x4::load_array(token, texel(first + 2)),
        f32x4::load_array(token, texel(first + 3)),
    ])
}

macro_rules! transpose {
    ($name:ident, $vector:ident, $half:ident, $width:literal) => {
        /// Twice as many.
        #[inline(always)]
        fn $name<S: Simd>(
            token: S,
            first: usize,
            texel: &mut impl FnMut(usize) -> [f32; 4],
        ) -> [$vector<S>; 3] {
            let [red, green, blue] = $half(token, first, texel);
            let [more_red, more_green, more_blue] = $half(token, first + $width / 2, texel);
            [red.combine(more_red), green.combine(more_green), blue.combine(more_blue)]
        }
    };
}
transpose!(transpose_8, f32x8, transpose_4, 8);
transpose!(transpose_16, f32x16, transpose_8, 16);
