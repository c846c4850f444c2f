//! Two values side by side: twice the lanes, and work for the CPU while one of them waits.

#![expect(clippy::redundant_closure, reason = "`&mut f` in place of a closure would not be inlined")]

use std::ops::{Add, Div, Mul, Neg, Sub};

use super::Lane;

/// Two values of the same type. A pair of pairs is four.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pair<T>(pub T, pub T);

macro_rules! operator {
    ($trait:ident, $method:ident) => {
        impl<T: $trait<Output = T>> $trait for Pair<T> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Self(self.0.$method(other.0), self.1.$method(other.1))
            }
        }

        impl<T: $trait<f32, Output = T>> $trait<f32> for Pair<T> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: f32) -> Self {
                Self(self.0.$method(other), self.1.$method(other))
            }
        }
    };
}
operator!(Add, add);
operator!(Sub, sub);
operator!(Mul, mul);
operator!(Div, div);

impl<T: Neg<Output = T>> Neg for Pair<T> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self(-self.0, -self.1)
    }
}

impl<T: Lane> Lane for Pair<T> {
    type Token = T::Token;
    type Part = T::Part;
    const PARTS: usize = 2 * T::PARTS;

    #[inline(always)]
    fn splat(token: T::Token, value: f32) -> Self {
        let same = T::splat(token, value);
        Self(same, same)
    }
    #[inline(always)]
    fn token(self) -> T::Token {
        self.0.token()
    }
    #[inline(always)]
    fn from_parts(mut part: impl FnMut(usize) -> T::Part) -> Self {
        let first = T::from_parts(
            #[inline(always)]
            |i| part(i),
        );
        Self(
            first,
            T::from_parts(
                #[inline(always)]
                |i| part(i + T::PARTS),
            ),
        )
    }
    #[inline(always)]
    fn each_part(self, mut f: impl FnMut(usize, T::Part)) {
        self.0.each_part(
            #[inline(always)]
            |i, part| f(i, part),
        );
        self.1.each_part(
            #[inline(always)]
            |i, part| f(i + T::PARTS, part),
        );
    }
    #[inline(always)]
    fn map_parts([x, y, z]: [Self; 3], mut f: impl FnMut([T::Part; 3]) -> [T::Part; 3]) -> [Self; 3] {
        let first = T::map_parts(
            [x.0, y.0, z.0],
            #[inline(always)]
            |values| f(values),
        );
        let second = T::map_parts(
            [x.1, y.1, z.1],
            #[inline(always)]
            |values| f(values),
        );
        [Self(first[0], second[0]), Self(first[1], second[1]), Self(first[2], second[2])]
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(self.0.sqrt(), self.1.sqrt())
    }
    #[inline(always)]
    fn floor(self) -> Self {
        Self(self.0.floor(), self.1.floor())
    }
    #[inline(always)]
    fn select_less(self, other: Self, then: Self, otherwise: Self) -> Self {
        Self(
            self.0.select_less(other.0, then.0, otherwise.0),
            self.1.select_less(other.1, then.1, otherwise.1),
        )
    }
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        Self(self.0.max(other.0), self.1.max(other.1))
    }
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        Self(self.0.min(other.0), self.1.min(other.1))
    }
}
