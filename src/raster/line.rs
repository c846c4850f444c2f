//! Lines by the diamond-exit rule of OpenGL 3.3, section 3.5.1: a pixel is drawn if the line leaves
//! the diamond |x - xc| + |y - yc| < 1/2 around its centre. The last pixel is left out, so joined
//! segments draw each pixel once; a line makes one fragment per column (or row, if it is steep).
//!
//! The rule's ties are decided as if both ends were moved by -(ε, ε²), x right and y up. All of it
//! is exact integer arithmetic on ends in 1/256 pixel.

use super::{
    framebuffer::Tile,
    handle::Handle,
    setup::{Line, Viewport},
    tiling::{SUBPIXELS, TILE, TILE_PIXELS},
    triangle::TileBounds,
};

/// Centre of pixel 0, in 1/256 pixel.
const CENTRE: i64 = SUBPIXELS as i64 / 2;
const PIXEL: i64 = SUBPIXELS as i64;

/// A line along its major axis: coordinate 0 is the major one, 1 the minor; y up.
#[derive(Clone, Copy, Debug)]
struct Walk {
    from: [i64; 2],
    to: [i64; 2],
    /// Whether the major axis is x.
    along_x: bool,
}

/// Draws a line into the tile's depth and visibility. One sample: the pixel's first stands for all.
pub(super) fn draw_line(
    tile: &mut Tile,
    line: &Line,
    bounds: TileBounds,
    handle: Handle,
    viewport: &Viewport,
) {
    let walk = Walk::of(line, viewport);
    let (rows, columns) = (viewport.height as i64, [tile.left as i64, tile.top as i64]);
    let first_last = |axis_x: bool| {
        let (range, start) = if axis_x { (bounds.x, columns[0]) } else { (bounds.y, columns[1]) };
        let [first, last] = range.map(|i| i as i64 + start);
        if axis_x { [first, last] } else { [rows - 1 - last, rows - 1 - first] }
    };
    let [first, last] = first_last(walk.along_x);
    for major in first..=last {
        let Some(minor) = walk.minor_at(major) else { continue };
        let (x, y) = if walk.along_x { (major, minor) } else { (minor, major) };
        let (x, y) = (x - columns[0], rows - 1 - y - columns[1]);
        let inside = 0..TILE as i64;
        if inside.contains(&x) && inside.contains(&y) {
            #[expect(clippy::cast_sign_loss, clippy::cast_possible_truncation, reason = "inside the tile")]
            plot(tile, x as usize, y as usize, depth_at(line, &walk, major), handle, viewport.samples);
        }
    }
}

/// Writes one fragment to all samples of a pixel, where it is nearer.
fn plot(tile: &mut Tile, x: usize, y: usize, z: f32, handle: Handle, samples: usize) {
    for sample in 0..samples {
        let at = sample * TILE_PIXELS + y * TILE + x;
        if z < tile.depth[at] {
            (tile.depth[at], tile.visible[at]) = (z, handle);
        }
    }
}

/// Depth where the unsnapped line passes the centre of major pixel `major`.
#[expect(clippy::cast_possible_truncation, reason = "the depth buffer is f32")]
fn depth_at(line: &Line, walk: &Walk, major: i64) -> f32 {
    let [a, b] = line.window;
    let (from, to) = if walk.along_x { (a.x, b.x) } else { (a.y, b.y) };
    let length = f64::from(to) - f64::from(from);
    let part = if length == 0.0 { 0.0 } else { (major as f64 + 0.5 - f64::from(from)) / length };
    // The last centre may lie beyond the end, and the depth there below 0.
    ((f64::from(a.z) + (f64::from(b.z) - f64::from(a.z)) * part) as f32).max(0.0)
}

impl Walk {
    fn of(line: &Line, viewport: &Viewport) -> Self {
        let up = |[x, y]: [i32; 2]| [i64::from(x), viewport.height as i64 * PIXEL - i64::from(y)];
        let [from, to] = line.snapped.map(up);
        let along_x = (to[0] - from[0]).abs() >= (to[1] - from[1]).abs();
        let turn = |[x, y]: [i64; 2]| if along_x { [x, y] } else { [y, x] };
        Self { from: turn(from), to: turn(to), along_x }
    }

    /// The minor pixel that the line draws in major pixel `major`, if any.
    fn minor_at(&self, major: i64) -> Option<i64> {
        let length = self.to[0] - self.from[0];
        let centre = major * PIXEL + CENTRE;
        if length == 0 {
            return None;
        }
        let minor = self.minor_pixel(centre, length);
        let pixel = [major, minor].map(|p| p * PIXEL + CENTRE);
        // Moved by -ε, an end on the centre counts as before it.
        let before = |end: [i64; 2]| if length > 0 { end[0] <= centre } else { end[0] > centre };
        let starts = before(self.from) || self.in_diamond(self.from, pixel);
        let leaves = !before(self.to) && !self.in_diamond(self.to, pixel);
        (starts && leaves).then_some(minor)
    }

    /// The minor pixel in which the (infinite) line passes major coordinate `centre`.
    fn minor_pixel(&self, centre: i64, length: i64) -> i64 {
        let slope = self.to[1] - self.from[1];
        let numerator = (self.from[1] * length + (centre - self.from[0]) * slope) * length.signum();
        let denominator = PIXEL * length.abs();
        let pixel = numerator.div_euclid(denominator);
        // On a border between two pixels: moved by -(ε, ε²), a rising line along x is above it.
        let on_border = numerator.rem_euclid(denominator) == 0;
        let above = self.along_x && slope * length.signum() > 0;
        if on_border && !above { pixel - 1 } else { pixel }
    }

    /// Whether an end, moved by -(ε, ε²), lies in the diamond around a pixel's centre.
    fn in_diamond(&self, end: [i64; 2], pixel: [i64; 2]) -> bool {
        let distance = (end[0] - pixel[0]).abs() + (end[1] - pixel[1]).abs();
        let x = if self.along_x { 0 } else { 1 };
        distance < CENTRE || (distance == CENTRE && end[x] > pixel[x])
    }
}
