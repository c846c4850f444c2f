//! The depth of a triangle: a plane over the window.

use fearless_simd::{SimdBase, f64x4};

use super::{samples, setup::Corner, tiling::TILE};
use crate::lanes::{FragmentLanes, Pair};

/// Pixels of a row that are tested at a time.
pub(super) const WIDTH: usize = 8;

/// Window depth as a plane: z = `at` + x·`column` + y·`row` at window position (x, y), y up.
#[derive(Clone, Copy, Debug)]
pub(super) struct DepthPlane {
    pub(super) origin: [f64; 2],
    pub(super) at: f64,
    pub(super) column: f64,
    pub(super) row: f64,
}

impl DepthPlane {
    /// The plane through the unsnapped corners; `scale` is 1 / `window_area`.
    #[inline(always)]
    pub(super) fn of(corners: &[Corner; 3], scale: f64) -> Self {
        let [a, b, c] = [&corners[0].window, &corners[1].window, &corners[2].window];
        let d = |to: f32, from: f32| f64::from(to) - f64::from(from);
        let (zb, zc) = (d(b.z, a.z), d(c.z, a.z));
        Self {
            origin: [a.x.into(), a.y.into()],
            at: a.z.into(),
            column: (zb * d(c.y, a.y) - zc * d(b.y, a.y)) * scale,
            row: (zc * d(b.x, a.x) - zb * d(c.x, a.x)) * scale,
        }
    }

    /// The depths that a tile whose first column and row these are has at the first of `samples` samples, in a picture
    /// of this height: to the bit those of the depth test.
    #[expect(clippy::cast_possible_truncation, reason = "the depth buffer is f32")]
    pub(super) fn depths(&self, [left, top]: [usize; 2], height: usize, samples: usize) -> Vec<f32> {
        let [dx, dy] = samples::positions(samples)[0].map(|p| f64::from(p) / 16.0);
        let row_depth = |y: usize| {
            let window_y = height as f64 - (whole(top + y) + dy);
            self.at + self.row * (window_y - self.origin[1])
        };
        let along_row = |x: usize| {
            let first = whole(left + x / WIDTH * WIDTH) + dx - self.origin[0];
            self.column * (first + whole(x % WIDTH))
        };
        let along_row: Vec<f64> = (0..TILE).map(along_row).collect();
        let rows = (0..TILE).map(row_depth);
        rows.flat_map(|row| along_row.iter().map(move |along| (row + along) as f32)).collect()
    }

    /// Whether all depths of a tile are surely above 0 and below 1: those of its corners are, by more than what
    /// rounding could change.
    pub(super) fn is_within(&self, [left, top]: [usize; 2], height: usize) -> bool {
        let ends = |start: usize| [whole(start), whole(start + TILE)];
        let (columns, rows) = (ends(left), ends(top));
        let depth = |x: f64, y: f64| {
            self.at + self.column * (x - self.origin[0]) + self.row * (height as f64 - y - self.origin[1])
        };
        columns.iter().all(|&x| rows.iter().all(|&y| (1e-6..1.0 - 1e-6).contains(&depth(x, y))))
    }
}

/// What the depth plane grows by along eight pixels of a row, the first at `column` from the origin.
#[inline(always)]
pub(super) fn along_row<S: FragmentLanes>(simd: S, column: f64, step: f64) -> Pair<f64x4<S>> {
    let (first, step) = (f64x4::splat(simd, column), f64x4::splat(simd, step));
    let columns = [[0.0, 1.0, 2.0, 3.0], [4.0, 5.0, 6.0, 7.0]];
    Pair(
        step * (first + f64x4::load_array(simd, columns[0])),
        step * (first + f64x4::load_array(simd, columns[1])),
    )
}

/// A column or row of the picture as a number.
#[inline(always)]
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_possible_wrap,
    reason = "pictures are at most 16384 wide"
)]
pub(super) fn whole(pixel: usize) -> f64 {
    f64::from(pixel as i32)
}
