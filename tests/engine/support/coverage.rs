//! The oracle of coverage: exact, in i128, by another way than the rasteriser's.
//!
//! GL's fill rule as the left-and-bottom rule says: a sample is inside if it is strictly inside
//! after a move by (ε, ε²), right and up. A sample on a left or bottom edge moves in, on any other
//! edge out. The sign of an edge function at the moved sample is that of the first of
//! (E, ∂E/∂x, ∂E/∂y) that is not zero.

use super::{Canvas, window};

/// A point of the window in 1/256 pixel, x right, y up.
pub(crate) type Point = [i128; 2];

/// Sub-pixel positions per pixel.
pub(crate) const SUBPIXELS: i128 = 256;

/// Where clip-space positions land on the grid of 1/256 pixel, rounded half to even.
pub(crate) fn snapped(clip: [f32; 4], canvas: Canvas) -> Point {
    let [x, y, ..] = window(clip, canvas);
    [x, y].map(|c| (f64::from(c) * SUBPIXELS as f64).round_ties_even() as i128)
}

/// The sample of pixel (column, row from the top) that lies `offset` sixteenths of a pixel right
/// of and below the pixel's top left corner.
pub(crate) fn sample([x, y]: [u32; 2], offset: [u32; 2], canvas: Canvas) -> Point {
    let [across, down] = [0, 1].map(|i| i128::from(offset[i]) * SUBPIXELS / 16);
    let y_down = i128::from(y) * SUBPIXELS + down;
    [i128::from(x) * SUBPIXELS + across, i128::from(canvas.height) * SUBPIXELS - y_down]
}

/// Which side of the line from `a` to `b` the moved sample is on: 1 left, -1 right, 0 if a = b.
fn side(a: Point, b: Point, p: Point) -> i128 {
    let [dx, dy] = [b[0] - a[0], b[1] - a[1]];
    let e = dx * (p[1] - a[1]) - dy * (p[0] - a[0]);
    [e, -dy, dx].into_iter().map(i128::signum).find(|&sign| sign != 0).unwrap_or(0)
}

/// Whether a triangle of either winding covers a sample.
pub(crate) fn covers([a, b, c]: [Point; 3], p: Point) -> bool {
    let sides = [side(a, b, p), side(b, c, p), side(c, a, p)];
    sides == [1; 3] || sides == [-1; 3]
}

/// Twice the signed area, positive if the corners turn left.
pub(crate) fn area([a, b, c]: [Point; 3]) -> i128 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// Which pixels of the picture a triangle covers at their centres.
pub(crate) fn covered(triangle: [Point; 3], canvas: Canvas) -> Vec<bool> {
    canvas.pixels().map(|pixel| covers(triangle, sample(pixel, [8, 8], canvas))).collect()
}
