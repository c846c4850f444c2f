//! The part of GLSL that the programs use, over [`Lane`]s. Names and meanings are GLSL's.

use std::ops::{Add, Div, Mul, Neg, Sub};

use crate::{
    lanes::{Lane, Part},
    math,
};

/// `float` in lanes.
#[expect(non_camel_case_types, reason = "GLSL's name")]
pub type float<L> = L;

/// `vec2` in lanes.
#[expect(non_camel_case_types, reason = "GLSL's name")]
pub type vec2<L> = [L; 2];

/// `vec3` in lanes.
#[expect(non_camel_case_types, reason = "GLSL's name")]
pub type vec3<L> = Vec3<L>;

/// `vec3`
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vec3<L> {
    /// First component: x, or red.
    pub x: L,
    /// Second component: y, or green.
    pub y: L,
    /// Third component: z, or blue.
    pub z: L,
}

/// `vec3(x, y, z)`
#[inline(always)]
pub fn vec3<L>(x: L, y: L, z: L) -> Vec3<L> {
    Vec3 { x, y, z }
}

impl<L> From<[L; 3]> for Vec3<L> {
    #[inline(always)]
    fn from([x, y, z]: [L; 3]) -> Self {
        vec3(x, y, z)
    }
}

impl<L> From<Vec3<L>> for [L; 3] {
    #[inline(always)]
    fn from(v: Vec3<L>) -> Self {
        [v.x, v.y, v.z]
    }
}

impl<L: Lane> Vec3<L> {
    /// `vec3(x)` in the lanes of this vector.
    #[inline(always)]
    pub fn all(self, x: f32) -> Self {
        let x = self.x.all(x);
        vec3(x, x, x)
    }
}

impl<L: Lane> Add for Vec3<L> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        vec3(self.x + other.x, self.y + other.y, self.z + other.z)
    }
}

impl<L: Lane> Sub for Vec3<L> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        vec3(self.x - other.x, self.y - other.y, self.z - other.z)
    }
}

impl<L: Lane> Neg for Vec3<L> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        vec3(-self.x, -self.y, -self.z)
    }
}

impl<L: Lane> Mul for Vec3<L> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        vec3(self.x * other.x, self.y * other.y, self.z * other.z)
    }
}

impl<L: Lane> Mul<L> for Vec3<L> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, factor: L) -> Self {
        vec3(self.x * factor, self.y * factor, self.z * factor)
    }
}

/// `dot(a, b)`, summed left to right.
#[inline(always)]
pub fn dot<L: Lane>(a: Vec3<L>, b: Vec3<L>) -> L {
    a.x * b.x + a.y * b.y + a.z * b.z
}

/// `cross(a, b)`
#[inline(always)]
pub fn cross<L: Lane>(a: Vec3<L>, b: Vec3<L>) -> Vec3<L> {
    vec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x)
}

/// `normalize(a)`; NaN for the zero vector.
#[inline(always)]
pub fn normalize<L: Lane>(a: Vec3<L>) -> Vec3<L> {
    a * (float(1.0) / dot(a, a).sqrt())
}

/// `reflect(incident, n)`
#[inline(always)]
pub fn reflect<L: Lane>(incident: Vec3<L>, n: Vec3<L>) -> Vec3<L> {
    incident - n * (dot(n, incident) * 2.0)
}

/// `max(a, b)` with a constant `a`; NaN where `b` is.
#[inline(always)]
pub fn max<L: Lane>(a: f32, b: L) -> L {
    b.all(a).max(b)
}

/// `float(x)`: a constant on the left of an operator.
#[inline(always)]
pub fn float(x: f32) -> Float {
    Float(x)
}

/// A constant.
#[derive(Clone, Copy, Debug)]
pub struct Float(f32);

impl<L: Lane> Div<L> for Float {
    type Output = L;
    #[inline(always)]
    fn div(self, other: L) -> L {
        other.all(self.0) / other
    }
}

impl<L: Lane> Sub<L> for Float {
    type Output = L;
    #[inline(always)]
    fn sub(self, other: L) -> L {
        other.all(self.0) - other
    }
}

/// The exponent of [`pow`]: whole ones are computed by repeated squaring, exactly rounded at each
/// multiplication; others through [`crate::math::pow`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Exponent {
    /// A whole number.
    Whole(u32),
    /// Any other number ≥ 0.
    Real(f32),
}

impl Exponent {
    /// Classifies a number ≥ 0.
    pub fn of(value: f32) -> Self {
        // The largest f32 that a u32 holds.
        if value.fract() == 0.0 && value <= 4_294_967_040.0 {
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "whole and in range")]
            Self::Whole(value as u32)
        } else {
            Self::Real(value)
        }
    }
}

/// `pow(base, exponent)` for base ≥ 0; 0 to any positive power is 0.
#[inline(always)]
pub fn pow<L: Lane>(base: L, exponent: Exponent) -> L {
    match exponent {
        Exponent::Whole(whole) => math::powi(base, whole, base.all(1.0)),
        Exponent::Real(real) => {
            let [power, ..] = L::map_parts(
                [base; 3],
                #[inline(always)]
                |[base, ..]| [each_pow(base, real); 3],
            );
            power
        }
    }
}

/// `pow` of one lane after the other.
#[inline(always)]
#[expect(clippy::cast_possible_truncation, reason = "the function's one rounding to f32")]
fn each_pow<P: Part>(base: P, exponent: f32) -> P {
    P::from_fn(
        base.token(),
        #[inline(always)]
        |i| math::pow(base.lane(i), f64::from(exponent)) as f32,
    )
}

/// `M * vec4(p, w)` with the columns of M: ((c0·x + c1·y) + c2·z) + c3·w.
#[inline(always)]
pub fn transform(m: &[[f32; 4]; 4], [x, y, z]: [f32; 3], w: f32) -> [f32; 4] {
    std::array::from_fn(|row| m[0][row] * x + m[1][row] * y + m[2][row] * z + m[3][row] * w)
}

/// The first three components of a `vec4`.
#[inline(always)]
pub fn xyz([x, y, z, _]: [f32; 4]) -> [f32; 3] {
    [x, y, z]
}
