//! The types of number that forces are computed in: binary64, and binary32 for `sim.precision` = `f32`.

use nalgebra::{ClosedAddAssign, ClosedDivAssign, ClosedMulAssign, ClosedSubAssign, Scalar};

/// A binary floating-point number whose + - × ÷ and square root are exactly rounded.
pub(crate) trait Real:
    Scalar + Copy + Default + Send + Sync + ClosedAddAssign + ClosedSubAssign + ClosedMulAssign + ClosedDivAssign
{
    /// The nearest number of this type.
    fn nearest(value: f64) -> Self;
    /// The square root.
    fn sqrt(self) -> Self;
}

// A function that is not inlined into the copy for a vector level makes its loop several times slower.
impl Real for f64 {
    #[inline(always)]
    fn nearest(value: f64) -> Self {
        value
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        self.sqrt()
    }
}

impl Real for f32 {
    #[expect(clippy::cast_possible_truncation, reason = "rounding is what is asked for")]
    #[inline(always)]
    fn nearest(value: f64) -> Self {
        value as Self
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        self.sqrt()
    }
}
