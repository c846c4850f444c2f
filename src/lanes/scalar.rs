//! One fragment at a time: `f32`, and `F64`, the reference of the error study.

use std::ops::{Add, Div, Mul, Neg, Sub};

use super::{
    Lane, Part, Texels, Whole, is_its_only_part,
    texels::{mix, square},
};

/// A number of binary64. A type of its own, because `f64` has no operations with plain `f32`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct F64(pub f64);

macro_rules! operator {
    ($trait:ident, $method:ident, $op:tt) => {
        impl $trait for F64 {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Self(self.0 $op other.0)
            }
        }

        impl $trait<f32> for F64 {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: f32) -> Self {
                Self(self.0 $op f64::from(other))
            }
        }
    };
}
operator!(Add, add, +);
operator!(Sub, sub, -);
operator!(Mul, mul, *);
operator!(Div, div, /);

impl Neg for F64 {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl From<f32> for F64 {
    #[inline(always)]
    fn from(value: f32) -> Self {
        Self(value.into())
    }
}

macro_rules! one_lane {
    ($lane:ty, $of_double:expr, $number:ident => $value:expr) => {
        impl Lane for $lane {
            type Token = ();
            is_its_only_part!();

            #[inline(always)]
            fn splat((): (), value: f32) -> Self {
                value.into()
            }
            #[inline(always)]
            fn token(self) {}
            #[inline(always)]
            fn sqrt(self) -> Self {
                let $number = self;
                $of_double($value.sqrt().into())
            }
            #[inline(always)]
            fn floor(self) -> Self {
                let $number = self;
                $of_double($value.floor().into())
            }
            #[inline(always)]
            fn select_less(self, other: Self, then: Self, otherwise: Self) -> Self {
                let below = {
                    let $number = self;
                    let one = $value;
                    let $number = other;
                    one < $value
                };
                if below { then } else { otherwise }
            }
        }

        #[expect(clippy::cast_possible_truncation, reason = "rounding and saturating are what is asked for")]
        impl Part for $lane {
            const WIDTH: usize = 1;
            const PACKED: bool = false;
            type Double = f64;
            type Whole = i32;

            #[inline(always)]
            fn from_fn((): (), mut f: impl FnMut(usize) -> f32) -> Self {
                f(0).into()
            }
            #[inline(always)]
            fn lane(self, _index: usize) -> f64 {
                let $number = self;
                $value.into()
            }
            #[inline(always)]
            fn store(self, out: &mut [f32]) {
                let $number = self;
                out[0] = $value as f32;
            }
            #[inline(always)]
            fn double((): (), value: f64) -> f64 {
                value
            }
            #[inline(always)]
            fn double_from_fn((): (), mut f: impl FnMut(usize) -> f64) -> f64 {
                f(0)
            }
            #[inline(always)]
            fn narrow(double: f64) -> Self {
                $of_double(double)
            }
            #[inline(always)]
            fn to_whole(self) -> i32 {
                let $number = self;
                $value as i32
            }
            #[inline(always)]
            fn store_rgba8(rgb: [Self; 3], out: &mut [u32]) {
                out[0] = rgba8(rgb.map(|$number| $value as f32));
            }
            #[inline(always)]
            fn lanes_with((): (), keys: &[u32], key: u32) -> u32 {
                u32::from(keys[0] == key)
            }
            #[inline(always)]
            fn lanes_less(self, other: Self) -> u32 {
                u32::from({
                    let $number = self;
                    let one = $value;
                    let $number = other;
                    one < $value
                })
            }
            #[inline(always)]
            fn replace(self, keys: &[u32], key: u32, other: Self) -> Self {
                if keys[0] == key { other } else { self }
            }
            #[inline(always)]
            fn whole_if_small(self) -> i32 {
                self.to_whole()
            }
            #[inline(always)]
            fn bilinear(texels: Texels<'_>, place: i32, down: u32, [right, lower]: [Self; 2]) -> [Self; 3] {
                let square = square(texels.full, place, down);
                [0, 1, 2].map(|channel: usize| {
                    let [a, b, c, d] = square.map(|texel| Self::from(texel[channel]));
                    mix!(mix!(a, b, right), mix!(c, d, right), lower)
                })
            }
            #[inline(always)]
            fn bilinear_plane(texels: &[f32], place: i32, down: u32, [right, lower]: [Self; 2]) -> Self {
                let [a, b, c, d] = square(texels, place, down).map(Self::from);
                mix!(mix!(a, b, right), mix!(c, d, right), lower)
            }
            #[inline(always)]
            fn transpose((): (), mut texel: impl FnMut(usize) -> [f32; 4]) -> [Self; 3] {
                let [red, green, blue, _] = texel(0);
                [red.into(), green.into(), blue.into()]
            }
        }
    };
}
one_lane!(F64, F64, number => number.0);
one_lane!(f32, rounded, number => number);

#[expect(clippy::cast_possible_truncation, reason = "the one place that rounds to f32")]
#[inline(always)]
fn rounded(value: f64) -> f32 {
    value as f32
}

/// A number to which a number in 0..=255 is added as a whole one: steps at its size are 1.
pub(super) const WHOLE_STEPS: f32 = 8_388_608.0;

/// A colour in 0..=1 with 8 bits of each channel, rounded half to even, red lowest, and 255 on top.
#[inline(always)]
pub(crate) fn rgba8(color: [f32; 3]) -> u32 {
    let [r, g, b] = color.map(|c| (c * 255.0 + WHOLE_STEPS).to_bits() & 0xFF);
    r | g << 8 | b << 16 | 255 << 24
}

impl Whole for i32 {
    #[inline(always)]
    fn all(self, value: i32) -> i32 {
        value
    }
    #[inline(always)]
    fn min(self, other: i32) -> i32 {
        Ord::min(self, other)
    }
    #[inline(always)]
    fn max(self, other: i32) -> i32 {
        Ord::max(self, other)
    }
    #[inline(always)]
    fn select_equal(self, other: i32, then: i32, otherwise: i32) -> i32 {
        if self == other { then } else { otherwise }
    }
    #[inline(always)]
    fn within(self, end: i32) -> bool {
        (0..end).contains(&self)
    }
    #[inline(always)]
    fn each(self, mut f: impl FnMut(i32) -> i32) -> i32 {
        f(self)
    }
    #[inline(always)]
    fn lane(self, _index: usize) -> i32 {
        self
    }
}
