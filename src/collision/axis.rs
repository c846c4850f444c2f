//! One axis of the uniform grid: which cell a coordinate lies in, and how far from there it surely
//! stays in it.

use std::ops::Range;

use crate::cloth::filled;
use crate::error::Result;

/// The cells along one axis, and between which bounds each point stays in its own.
#[derive(Clone, Debug)]
pub(super) struct Axis {
    /// Cell size, in metres.
    size: f64,
    /// Per point, the lowest coordinate that is surely in its cell, in metres.
    lower: Vec<f64>,
    /// Per point, the highest coordinate that is surely in its cell, in metres.
    upper: Vec<f64>,
}

impl Axis {
    /// Cells of `size`, in metres, for `points` points.
    ///
    /// # Errors
    /// [`crate::error::Kind::Scene`] when the bounds do not fit in memory.
    pub(super) fn new(size: f64, points: usize) -> Result<Self> {
        Ok(Self { size, lower: filled(points, 0.0)?, upper: filled(points, 0.0)? })
    }

    /// Whether one of `points`, which are at `x`, may have left its cell.
    #[inline(always)]
    pub(super) fn any_may_leave(&self, points: Range<usize>, x: &[f64]) -> bool {
        let (x, lower, upper) = (&x[points.clone()], &self.lower[points.clone()], &self.upper[points]);
        let mut all_stay = true;
        for ((x, lower), upper) in x.iter().zip(lower).zip(upper) {
            all_stay &= (lower <= x) & (x <= upper);
        }
        !all_stay
    }

    /// The cell of point `p` at `x`: `floor(x / size)`.
    ///
    /// The bounds stay away from the border by thousands of times the rounding of the division
    /// and of the bounds; where numbers are so large or so small that this cannot be said, the
    /// bounds hold nothing and the cell is computed anew in every step.
    pub(super) fn cell_of(&mut self, p: usize, x: f64) -> i64 {
        let floor = (x / self.size).floor();
        let margin = 1e-12 * (floor.abs() + 1.0) * self.size;
        let sure = margin > 1e-280;
        self.lower[p] = if sure { floor * self.size + margin } else { f64::INFINITY };
        self.upper[p] = (floor + 1.0) * self.size - margin;
        integer(floor)
    }
}

/// A whole number as an integer; beyond ±2⁶³ the nearest there is.
#[expect(clippy::cast_possible_truncation, reason = "a floor has no fraction, and saturation is meant")]
pub(super) fn integer(floor: f64) -> i64 {
    floor as i64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_coordinate_on_a_border_never_surely_stays() {
        for x in [0.0, 0.06, -0.06, 0.18, 6e30, -6e30] {
            let mut axis = Axis::new(0.06, 1).unwrap();
            axis.cell_of(0, x);
            assert!(axis.any_may_leave(0..1, &[x]), "{x}");
        }
        let mut axis = Axis::new(0.06, 1).unwrap();
        assert_eq!(axis.cell_of(0, -0.01), -1);
        assert!(!axis.any_may_leave(0..1, &[-0.05]), "cell -1 starts at -0.06");
        assert!(axis.any_may_leave(0..1, &[0.01]), "cell -1 ends at 0");
    }
}
