//! The number type of the fragment stage: one number, or several side by side.
//!
//! A fragment program is written once over [`Lane`]. It is run with the widest vectors that the CPU has,
//! several of them side by side, so that roots and divisions of one overlap with those of the next; with
//! `f32` one fragment at a time (for tests); and with [`F64`] as its own reference for the error study.
//! Only operations that are rounded exactly, or not at all, are used: the bits are the same in every lane.

pub mod level;
#[cfg(test)]
mod operations;
mod packed;
mod pair;
mod scalar;
mod texels;
mod vector;

use std::ops::{Add, Div, Mul, Neg, Sub};

use fearless_simd::Simd;

pub use pair::Pair;
pub use scalar::F64;
pub(crate) use scalar::rgba8;
pub use texels::Texels;

/// What [`Lane`] asks of a type that is a [`Part`] itself.
macro_rules! is_its_only_part {
    () => {
        type Part = Self;
        const PARTS: usize = 1;

        #[inline(always)]
        fn from_parts(mut part: impl FnMut(usize) -> Self) -> Self {
            part(0)
        }
        #[inline(always)]
        fn each_part(self, mut f: impl FnMut(usize, Self)) {
            f(0, self);
        }
        #[inline(always)]
        fn map_parts(values: [Self; 3], mut f: impl FnMut([Self; 3]) -> [Self; 3]) -> [Self; 3] {
            f(values)
        }
    };
}
use is_its_only_part;

/// A number of the fragment stage: + − × ÷, and what follows, all exactly rounded. An operation with a
/// plain number is that with the number in every lane.
pub trait Lane:
    Copy
    + Send
    + Sync
    + Neg<Output = Self>
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Add<f32, Output = Self>
    + Sub<f32, Output = Self>
    + Mul<f32, Output = Self>
{
    /// What new numbers are made from: proof that the CPU has the vectors.
    type Token: Copy + Send + Sync;
    /// The vectors that a value consists of.
    type Part: Part<Token = Self::Token>;
    /// How many parts a value has: a power of two, at most [`MAX_PARTS`].
    const PARTS: usize;

    /// The same number in every lane.
    fn splat(token: Self::Token, value: f32) -> Self;
    /// What this value was made from.
    fn token(self) -> Self::Token;
    /// A value of its parts.
    fn from_parts(part: impl FnMut(usize) -> Self::Part) -> Self;
    /// Hands each part to `f` with its index.
    fn each_part(self, f: impl FnMut(usize, Self::Part));
    /// Three values from three values, each part by `f` from the same parts.
    fn map_parts(values: [Self; 3], f: impl FnMut([Self::Part; 3]) -> [Self::Part; 3]) -> [Self; 3];
    /// Square root.
    fn sqrt(self) -> Self;
    /// Largest whole number that is not above.
    fn floor(self) -> Self;
    /// `then` where `self < other`, else `otherwise` (also where either is NaN).
    fn select_less(self, other: Self, then: Self, otherwise: Self) -> Self;

    /// The same number in every lane of a value like this one.
    #[inline(always)]
    fn all(self, value: f32) -> Self {
        Self::splat(self.token(), value)
    }

    /// The larger of two; `other` where either is NaN.
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        other.select_less(self, self, other)
    }

    /// The smaller of two; `other` where either is NaN.
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        self.select_less(other, self, other)
    }

    /// The value without its sign.
    #[inline(always)]
    fn abs(self) -> Self {
        (-self).max(self)
    }
}

/// Most parts of a value.
pub const MAX_PARTS: usize = 4;

/// Most fragments of a part.
pub const MAX_WIDTH: usize = 16;

/// Most fragments of a value: lists of fragments are filled up to a multiple of it.
pub const MAX_LANES: usize = 32;

/// One vector, or one number: what is interpolated and looked up at a time.
pub trait Part: Lane<Part = Self> {
    /// How many fragments it holds: a power of two, at most [`MAX_WIDTH`].
    const WIDTH: usize;
    /// A bit for each of them.
    const ALL_LANES: u32 = (1 << Self::WIDTH) - 1;
    /// Whether [`Part::bilinear`] reads packed texels: with vectors that are not the widest, they take longer than full
    /// ones.
    const PACKED: bool;
    /// The same lanes in binary64, in which positions in the window are computed.
    type Double: Copy + Add<Output = Self::Double> + Sub<Output = Self::Double> + Mul<Output = Self::Double>;
    /// The same lanes as whole numbers.
    type Whole: Whole;

    /// Lane i is `f(i)`.
    fn from_fn(token: Self::Token, f: impl FnMut(usize) -> f32) -> Self;
    /// Lane `index`, widened to binary64 (exact).
    fn lane(self, index: usize) -> f64;
    /// Writes the lanes, rounded to f32, to the first [`Part::WIDTH`] elements of `out`.
    fn store(self, out: &mut [f32]);
    /// The same binary64 number in every lane.
    fn double(token: Self::Token, value: f64) -> Self::Double;
    /// Lane i of a binary64 value is `f(i)`.
    fn double_from_fn(token: Self::Token, f: impl FnMut(usize) -> f64) -> Self::Double;
    /// Rounds binary64 lanes to this type.
    fn narrow(double: Self::Double) -> Self;
    /// Lanes that are whole numbers as integers; too large ones saturate, NaN is 0.
    fn to_whole(self) -> Self::Whole;
    /// Writes red, green and blue in 0..=1 to the first [`Part::WIDTH`] elements of `out`: 8 bits each, rounded half
    /// to even, red lowest, and 255 on top.
    fn store_rgba8(rgb: [Self; 3], out: &mut [u32]);
    /// A bit for each lane, the first one lowest, which is 1 where `keys` is `key`. There are [`Part::WIDTH`] keys.
    fn lanes_with(token: Self::Token, keys: &[u32], key: u32) -> u32;
    /// A bit for each lane, the first one lowest, which is 1 where `self < other`.
    fn lanes_less(self, other: Self) -> u32;
    /// `other` in the lanes where `keys` is `key`, else `self`. There are [`Part::WIDTH`] keys.
    fn replace(self, keys: &[u32], key: u32, other: Self) -> Self;
    /// As [`Part::to_whole`], but a number below -2³¹, from 2³¹ on, or NaN may become any number that is
    /// not among 0..2³⁰, or what it is there.
    fn whole_if_small(self) -> Self::Whole;
    /// Red, green and blue of a texel in each lane: lane i has that of `texel(i)`.
    fn transpose(token: Self::Token, texel: impl FnMut(usize) -> [f32; 4]) -> [Self; 3];
    /// Red, green and blue between four texels in each lane: the one at `places`, the one after it, and both `down`
    /// further on; the weights are those of the second of two, along the row and down. a + (b - a)·f along both rows,
    /// then down.
    ///
    /// # Panics
    /// If one of the texels is not there.
    fn bilinear(texels: Texels<'_>, places: Self::Whole, down: u32, weights: [Self; 2]) -> [Self; 3];
    /// As [`Part::bilinear`], of one channel alone.
    ///
    /// # Panics
    /// If one of the texels is not there.
    fn bilinear_plane(texels: &[f32], places: Self::Whole, down: u32, weights: [Self; 2]) -> Self;
}

/// Whole numbers side by side.
pub trait Whole: Copy + Add<Output = Self> + Add<i32, Output = Self> + Mul<i32, Output = Self> {
    /// The same number in every lane of a value like this one.
    fn all(self, value: i32) -> Self;
    /// The smaller of two.
    fn min(self, other: Self) -> Self;
    /// The larger of two.
    fn max(self, other: Self) -> Self;
    /// `then` where `self == other`, else `otherwise`.
    fn select_equal(self, other: Self, then: Self, otherwise: Self) -> Self;
    /// Whether all lanes are at least 0 and less than `end`.
    fn within(self, end: i32) -> bool;
    /// `f` of every lane.
    fn each(self, f: impl FnMut(i32) -> i32) -> Self;
    /// One lane.
    fn lane(self, index: usize) -> i32;
}

/// The lanes in which fragments are shaded with the vectors of a level.
pub trait FragmentLanes: Simd {
    /// Values of the fragment stage.
    type Lanes: Lane<Token = Self>;
    /// Whether `max` and `min` of a vector are those of a comparison and a selection, also for zeros of
    /// either sign and NaN. They are on x86, where one instruction does what two do elsewhere.
    const ORDERED_MAX: bool;
}

#[cfg(target_arch = "x86_64")]
mod widths {
    use fearless_simd::{Avx2, Avx512, Sse2, f32x4, f32x8, f32x16};

    use super::{FragmentLanes, Pair};

    impl FragmentLanes for Avx512 {
        type Lanes = Pair<f32x16<Self>>;
        const ORDERED_MAX: bool = true;
    }

    impl FragmentLanes for Avx2 {
        type Lanes = Pair<Pair<f32x8<Self>>>;
        const ORDERED_MAX: bool = true;
    }

    impl FragmentLanes for Sse2 {
        type Lanes = Pair<f32x4<Self>>;
        const ORDERED_MAX: bool = true;
    }
}

#[cfg(target_arch = "aarch64")]
impl FragmentLanes for fearless_simd::Neon {
    type Lanes = Pair<Pair<fearless_simd::f32x4<Self>>>;
    const ORDERED_MAX: bool = false;
}

#[cfg(target_feature = "simd128")]
impl FragmentLanes for fearless_simd::WasmSimd128 {
    type Lanes = Pair<fearless_simd::f32x4<Self>>;
    const ORDERED_MAX: bool = false;
}

impl FragmentLanes for fearless_simd::Fallback {
    type Lanes = fearless_simd::f32x4<Self>;
    const ORDERED_MAX: bool = false;
}
