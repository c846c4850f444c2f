//! The one source of every function beyond + - × ÷ and the square root.
//!
//! The standard library's versions call the system's C library or the compiler's and differ in
//! the last bit between machines. These are the pure-Rust translation of musl's (crate `libm`,
//! pinned to one version), which takes the same path on every CPU. `sqrt` is exact by IEEE 754,
//! so the standard library's is used everywhere. `clippy.toml` forbids the others elsewhere.

use std::ops::Mul;

use nalgebra::Vector3;

/// A point or direction in metres, world space, y up. Its `norm` and `normalize` need the feature `std` of `nalgebra`,
/// which the tests have and the engine has not; [`length`] and [`unit()`] are the engine's.
pub type Vec3 = Vector3<f64>;

/// `a · b`, summed from left to right.
pub fn dot(a: Vec3, b: Vec3) -> f64 {
    a.x * b.x + a.y * b.y + a.z * b.z
}

/// The length of `v`, in its unit.
pub fn length(v: Vec3) -> f64 {
    dot(v, v).sqrt()
}

/// The direction of `v`, which is not zero, as a vector of length 1.
pub fn unit(v: Vec3) -> Vec3 {
    v / length(v)
}

/// Sine of `x` radians; error below 1 ulp.
pub fn sin(x: f64) -> f64 {
    libm::sin(x)
}

/// Cosine of `x` radians; error below 1 ulp.
pub fn cos(x: f64) -> f64 {
    libm::cos(x)
}

/// Tangent of `x` radians; error below 1 ulp.
pub fn tan(x: f64) -> f64 {
    libm::tan(x)
}

/// Angle of the vector (x, y) in radians, -π..=π; error below 1 ulp.
pub fn atan2(y: f64, x: f64) -> f64 {
    libm::atan2(y, x)
}

/// e to the `x`; error below 1 ulp.
pub fn exp(x: f64) -> f64 {
    libm::exp(x)
}

/// Natural logarithm; error below 1 ulp.
pub fn ln(x: f64) -> f64 {
    libm::log(x)
}

/// `x` to the `y`; error below 1 ulp.
pub fn pow(x: f64, y: f64) -> f64 {
    libm::pow(x, y)
}

/// Sine and cosine of an angle in degrees, exact (0, ±1) at multiples of 90°.
pub fn sin_cos_degrees(degrees: f64) -> (f64, f64) {
    let turn = degrees - 360.0 * (degrees / 360.0).floor();
    if turn == 0.0 || turn == 360.0 {
        (0.0, 1.0)
    } else if turn == 90.0 {
        (1.0, 0.0)
    } else if turn == 180.0 {
        (0.0, -1.0)
    } else if turn == 270.0 {
        (-1.0, 0.0)
    } else {
        let radians = turn * (std::f64::consts::PI / 180.0);
        (sin(radians), cos(radians))
    }
}

/// `base` to a whole exponent by repeated squaring, most significant bit last.
/// `one` is what the zeroth power gives.
#[inline(always)]
pub fn powi<T: Copy + Mul<Output = T>>(base: T, exponent: u32, one: T) -> T {
    let (mut square, mut bits) = (base, exponent);
    if bits == 0 {
        return one;
    }
    while bits & 1 == 0 {
        square = square * square;
        bits >>= 1;
    }
    let mut result = square;
    while bits > 1 {
        square = square * square;
        bits >>= 1;
        if bits & 1 == 1 {
            result = result * square;
        }
    }
    result
}

/// A well-mixed 64-bit number for each 64-bit number (Steele, Lea and Flood 2014, SplitMix64).
pub fn splitmix64(index: u64) -> u64 {
    let x = index.wrapping_add(0x9E37_79B9_7F4A_7C15);
    let x = (x ^ (x >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    let x = (x ^ (x >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    x ^ (x >> 31)
}

/// A hash over the bits of numbers: FNV-1a, 64 bits, fed one byte at a time, low byte first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct StateHash(u64);

impl Default for StateHash {
    fn default() -> Self {
        Self(0xCBF2_9CE4_8422_2325)
    }
}

impl StateHash {
    /// Takes in one number, bit for bit (so 0.0 and -0.0 differ).
    pub fn write_f64(&mut self, value: f64) {
        self.write(&value.to_bits().to_le_bytes());
    }

    /// Takes in bytes.
    pub fn write(&mut self, bytes: &[u8]) {
        for &byte in bytes {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01B3);
        }
    }

    /// The hash of all that was taken in.
    pub fn finish(self) -> u64 {
        self.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The bits of every function over a fixed set of arguments. A change of the pinned source,
    /// or a machine on which it takes another path, changes this number.
    #[test]
    fn functions_give_the_same_bits_everywhere() {
        let mut hash = StateHash::default();
        for i in 0..20_000_u64 {
            let r = splitmix64(i);
            #[expect(clippy::cast_precision_loss, reason = "53 bits fit")]
            let u = (r >> 11) as f64 / 9_007_199_254_740_992.0;
            let x = (u - 0.5) * 40.0;
            for value in [sin(x), cos(x), tan(x), exp(x), ln(u + 1e-9), pow(u, x), atan2(x, u - 0.5)] {
                hash.write_f64(value);
            }
        }
        assert_eq!(hash.finish(), FUNCTION_BITS, "hash {:#018x}", hash.finish());
    }
    const FUNCTION_BITS: u64 = 0x9870_31e4_eb4b_7871;

    #[test]
    fn right_angles_are_exact() {
        for (degrees, expected) in [
            (0.0, (0.0, 1.0)),
            (90.0, (1.0, 0.0)),
            (180.0, (0.0, -1.0)),
            (-90.0, (-1.0, 0.0)),
            (450.0, (1.0, 0.0)),
        ] {
            assert_eq!(sin_cos_degrees(degrees), expected, "{degrees} degrees");
        }
    }

    #[test]
    fn whole_powers_square_and_multiply() {
        assert_eq!(powi(3.0_f64, 0, 1.0), 1.0);
        assert_eq!(powi(3.0_f64, 13, 1.0), 1_594_323.0);
        assert_eq!(powi(0.0_f32, 64, 1.0), 0.0);
    }

    #[test]
    fn splitmix64_matches_its_published_first_output() {
        assert_eq!(splitmix64(0), 0xE220_A839_7B1D_CDAF);
    }
}
