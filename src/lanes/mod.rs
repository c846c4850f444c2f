//! The number type of the fragment stage: one number, or eight side by side.
//!
//! A fragment program is written once over [`Lane`]. With `Wide<f32>` it shades eight fragments
//! at a time, with `f32` one (for tests), with `f64` it is its own reference for the error study.
//! Everything is plain loops over arrays: the compiler turns them into whatever vector
//! instructions the machine has, and since it neither fuses nor reorders, the bits are the same.

pub mod level;

use std::ops::{Add, Div, Mul, Neg, Sub};

/// Fragments that a [`Wide`] holds.
pub const WIDTH: usize = 8;

/// A number of the fragment stage: + − × ÷, and what follows, all exactly rounded.
pub trait Lane:
    Copy
    + Send
    + Sync
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// The same lanes in binary64, in which positions in the window are computed.
    type Double: Lane;
    /// How many fragments one value holds.
    const LANES: usize;

    /// The same number in every lane.
    fn splat(value: f32) -> Self;
    /// Lane i is `f(i)`.
    fn from_fn(f: impl FnMut(usize) -> f32) -> Self;
    /// The same binary64 number in every lane.
    fn splat_double(value: f64) -> Self::Double;
    /// Rounds binary64 lanes to this type.
    fn narrow(double: Self::Double) -> Self;
    /// Lane `index`, widened to binary64 (exact).
    fn lane(self, index: usize) -> f64;
    /// Writes the lanes, rounded to f32, to the first [`Lane::LANES`] places of `out`.
    fn store(self, out: &mut [f32]);
    /// Square root.
    fn sqrt(self) -> Self;
    /// Largest whole number that is not above.
    fn floor(self) -> Self;
    /// Lanes that are whole numbers as integers; too large ones saturate, NaN and absent lanes are 0.
    fn to_whole(self) -> Wide<i32>;
    /// `then` where `self < other`, else `otherwise` (also where either is NaN).
    fn select_less(self, other: Self, then: Self, otherwise: Self) -> Self;
    /// `other` in the lanes that `mask` names, else `self`.
    fn replace(self, mask: &[bool; WIDTH], other: Self) -> Self;

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
        self.select_less(Self::splat(0.0), -self, self)
    }
}

/// Eight numbers side by side.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(32))]
pub struct Wide<T>(pub [T; WIDTH]);

impl<T: Copy> Wide<T> {
    /// `f` of every lane. A loop, because the standard library's `map` over arrays is not sure to be
    /// compiled into the caller's vector instructions.
    #[inline(always)]
    pub(crate) fn each<U: Copy + Default>(self, f: impl Fn(T) -> U) -> Wide<U> {
        let mut result = Wide([U::default(); WIDTH]);
        for (result, value) in result.0.iter_mut().zip(self.0) {
            *result = f(value);
        }
        result
    }
}

macro_rules! operator {
    ($trait:ident, $method:ident, $op:tt) => {
        impl<T: Copy + $trait<Output = T>> $trait for Wide<T> {
            type Output = Self;
            #[inline(always)]
            fn $method(mut self, other: Self) -> Self {
                for (a, b) in self.0.iter_mut().zip(other.0) {
                    *a = *a $op b;
                }
                self
            }
        }
    };
}
operator!(Add, add, +);
operator!(Sub, sub, -);
operator!(Mul, mul, *);
operator!(Div, div, /);

impl<T: Copy + Default + Neg<Output = T>> Neg for Wide<T> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        self.each(|a| -a)
    }
}

macro_rules! lanes {
    ($scalar:ty) => {
        impl Lane for $scalar {
            type Double = f64;
            const LANES: usize = 1;

            #[inline(always)]
            fn splat(value: f32) -> Self {
                value.into()
            }
            #[inline(always)]
            fn from_fn(mut f: impl FnMut(usize) -> f32) -> Self {
                f(0).into()
            }
            #[inline(always)]
            fn splat_double(value: f64) -> f64 {
                value
            }
            #[inline(always)]
            fn narrow(double: f64) -> Self {
                double as $scalar
            }
            #[inline(always)]
            fn lane(self, _index: usize) -> f64 {
                self.into()
            }
            #[inline(always)]
            fn store(self, out: &mut [f32]) {
                out[0] = self as f32;
            }
            #[inline(always)]
            fn sqrt(self) -> Self {
                <$scalar>::sqrt(self)
            }
            #[inline(always)]
            fn floor(self) -> Self {
                <$scalar>::floor(self)
            }
            #[inline(always)]
            fn to_whole(self) -> Wide<i32> {
                let mut whole = Wide([0; WIDTH]);
                whole.0[0] = self as i32;
                whole
            }
            #[inline(always)]
            fn select_less(self, other: Self, then: Self, otherwise: Self) -> Self {
                if self < other { then } else { otherwise }
            }
            #[inline(always)]
            fn replace(self, mask: &[bool; WIDTH], other: Self) -> Self {
                if mask[0] { other } else { self }
            }
        }

        impl Lane for Wide<$scalar> {
            type Double = Wide<f64>;
            const LANES: usize = WIDTH;

            #[inline(always)]
            fn splat(value: f32) -> Self {
                Self([value.into(); WIDTH])
            }
            #[inline(always)]
            fn from_fn(mut f: impl FnMut(usize) -> f32) -> Self {
                let mut result = Self([0.0; WIDTH]);
                for (i, result) in result.0.iter_mut().enumerate() {
                    *result = f(i).into();
                }
                result
            }
            #[inline(always)]
            fn splat_double(value: f64) -> Wide<f64> {
                Wide([value; WIDTH])
            }
            #[inline(always)]
            fn narrow(double: Wide<f64>) -> Self {
                double.each(|d| d as $scalar)
            }
            #[inline(always)]
            fn lane(self, index: usize) -> f64 {
                self.0[index].into()
            }
            #[inline(always)]
            fn store(self, out: &mut [f32]) {
                for (out, value) in out.iter_mut().zip(self.0) {
                    *out = value as f32;
                }
            }
            #[inline(always)]
            fn sqrt(self) -> Self {
                self.each(<$scalar>::sqrt)
            }
            #[inline(always)]
            fn floor(self) -> Self {
                self.each(<$scalar>::floor)
            }
            #[inline(always)]
            fn to_whole(self) -> Wide<i32> {
                let near = |value: $scalar| value.abs() < NEAR.into();
                if self.0.iter().fold(true, |all, &value| all & near(value)) {
                    return self.each(|value| {
                        (value as f32 + WHOLE).to_bits().wrapping_sub(WHOLE.to_bits()).cast_signed()
                    });
                }
                self.each(|value| value as i32)
            }
            #[inline(always)]
            fn select_less(self, other: Self, then: Self, otherwise: Self) -> Self {
                let mut result = otherwise;
                for i in 0..WIDTH {
                    result.0[i] = if self.0[i] < other.0[i] { then.0[i] } else { result.0[i] };
                }
                result
            }
            #[inline(always)]
            fn replace(self, mask: &[bool; WIDTH], other: Self) -> Self {
                let mut result = self;
                for i in 0..WIDTH {
                    result.0[i] = if mask[i] { other.0[i] } else { result.0[i] };
                }
                result
            }
        }
    };
}

#[expect(
    clippy::cast_possible_truncation,
    reason = "narrow is the one place that rounds to f32, to_whole saturates"
)]
mod implementations {
    use super::{Lane, WIDTH, Wide};

    /// A number to which a whole number between -`NEAR` and `NEAR` is added exactly: the sum's last bits
    /// are its bits. A cast does more, and is not vectorised.
    const WHOLE: f32 = 12_582_912.0;
    const NEAR: f32 = 4_194_304.0;

    lanes!(f32);
    lanes!(f64);
}
