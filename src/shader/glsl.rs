//! The part of GLSL that the programs use, over lanes. Names and meanings are GLSL's.

use std::ops::{Add, Mul, Neg, Sub};

use crate::{lanes::Lane, math, mesh::Attributes};

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

/// A uniform `vec3`, the same in every lane.
#[inline(always)]
pub fn uniform<L: Lane>(value: [f32; 3]) -> Vec3<L> {
    let [x, y, z] = value.map(L::splat);
    vec3(x, y, z)
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
    a * (L::splat(1.0) / dot(a, a).sqrt())
}

/// `reflect(incident, n)`
#[inline(always)]
pub fn reflect<L: Lane>(incident: Vec3<L>, n: Vec3<L>) -> Vec3<L> {
    incident - n * (L::splat(2.0) * dot(n, incident))
}

/// `max(a, b)`
#[inline(always)]
pub fn max<L: Lane>(a: L, b: L) -> L {
    a.max(b)
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
        Exponent::Whole(whole) => math::powi(base, whole, L::splat(1.0)),
        #[expect(clippy::cast_possible_truncation, reason = "the function's one rounding to f32")]
        Exponent::Real(real) => L::from_fn(|i| math::pow(base.lane(i), f64::from(real)) as f32),
    }
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

/// What a vertex program puts out: `gl_Position` and its varyings.
pub type VertexOutput<const N: usize> = ([f32; 4], [f32; N]);

/// A vertex program, called once per vertex.
pub trait VertexProgram<const N: usize>: Fn(&Attributes) -> VertexOutput<N> + Send + Sync {}
impl<const N: usize, F: Fn(&Attributes) -> VertexOutput<N> + Send + Sync> VertexProgram<N> for F {}

/// A fragment program, called once per group of fragments: varyings in, linear colour out.
pub trait FragmentProgram<L, const N: usize>: Fn(&[L; N]) -> Vec3<L> + Send + Sync {}
impl<L, const N: usize, F: Fn(&[L; N]) -> Vec3<L> + Send + Sync> FragmentProgram<L, N> for F {}
