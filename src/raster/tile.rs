//! Coverage and depth of a triangle within one tile.
//!
//! An edge function is kept as three integers per tile: its value at the tile's first pixel and
//! its steps per column and row. Positions are in 1/256 pixel and pixels are 256 of them apart, so
//! E(i, j) = 256·(A·i + B·j) + c, and E ≥ 0 iff A·i + B·j + ⌊c/256⌋ ≥ 0: exact, in 32 bits.
//!
//! Fill rule: a sample on a left edge or on a lower horizontal edge (GL's bottom, y up) is inside,
//! on any other edge outside, so a sample on a shared edge belongs to exactly one triangle.

use std::hint::black_box;

use super::{
    assemble::Handle,
    framebuffer::{TILE, TILE_PIXELS, Tile},
    samples,
    setup::{Bounds, Corner, SUBPIXELS, Viewport},
};
use crate::lanes::{Lane, WIDTH, Wide};

/// An edge function over a tile's pixels: inside where `at + x·column + y·row >= 0`.
#[derive(Clone, Copy, Debug, Default)]
struct Edge {
    at: i32,
    column: i32,
    row: i32,
}

impl Edge {
    /// The value at a pixel.
    #[inline(always)]
    #[expect(clippy::cast_possible_truncation, clippy::cast_possible_wrap, reason = "x and y are below 64")]
    fn value(&self, x: usize, y: usize) -> i32 {
        self.at + self.column * x as i32 + self.row * y as i32
    }

    /// What the value grows by from the first of eight pixels of a row to each of them.
    #[inline(always)]
    fn steps(&self) -> [i32; WIDTH] {
        // Factors that the compiler sees it would shift or leave out, and then not vectorise.
        let mut steps = black_box([0, 1, 2, 3, 4, 5, 6, 7]);
        for step in &mut steps {
            *step *= self.column;
        }
        steps
    }
}

/// Window depth as a plane: z = `at` + x·`column` + y·`row` at window position (x, y), y up.
#[derive(Clone, Copy, Debug)]
struct DepthPlane {
    origin: [f64; 2],
    at: f64,
    column: f64,
    row: f64,
}

/// The part of a tile that a primitive may touch: first and last column and row, inclusive.
#[derive(Clone, Copy, Debug)]
pub(super) struct TileBounds {
    pub(super) x: [usize; 2],
    pub(super) y: [usize; 2],
}

impl TileBounds {
    /// Cuts picture bounds to a tile that they touch.
    pub(super) fn of(bounds: Bounds, tile: &Tile) -> Self {
        let within = |[first, last]: [u16; 2], start: usize| {
            [usize::from(first).max(start) - start, (usize::from(last) - start).min(TILE - 1)]
        };
        Self { x: within(bounds.x, tile.left), y: within(bounds.y, tile.top) }
    }
}

/// Draws a triangle into a tile's depth and visibility.
#[inline(always)]
pub(super) fn draw_triangle(
    tile: &mut Tile,
    corners: &[Corner; 3],
    scale: f64,
    bounds: TileBounds,
    handle: Handle,
    viewport: &Viewport,
) {
    let depth = DepthPlane::of(corners, scale);
    for (sample, position) in samples::positions(viewport.samples).iter().enumerate() {
        let offset = [position[0] * (SUBPIXELS / 16), position[1] * (SUBPIXELS / 16)];
        if let Some(edges) = tile_edges(corners, tile, offset) {
            draw_sample(tile, sample * TILE_PIXELS, &edges, &depth, offset, bounds, handle, viewport.height);
        }
    }
}

/// One sample of every pixel in `bounds`, eight pixels of a row at a time.
#[inline(always)]
#[expect(clippy::too_many_arguments, reason = "the inner loop's state, each a plain number or pair")]
fn draw_sample(
    tile: &mut Tile,
    base: usize,
    edges: &[Edge; 3],
    plane: &DepthPlane,
    offset: [i32; 2],
    bounds: TileBounds,
    handle: Handle,
    height: usize,
) {
    let dx = f64::from(offset[0]) / f64::from(SUBPIXELS);
    let dy = f64::from(offset[1]) / f64::from(SUBPIXELS);
    let steps = [edges[0].steps(), edges[1].steps(), edges[2].steps()];
    let most = [steps[0][7].max(0), steps[1][7].max(0), steps[2][7].max(0)];
    let mut start = bounds.x[0];
    while start <= bounds.x[1] {
        let x = start.min(TILE - WIDTH);
        start += WIDTH;
        let columns = Lanes::splat_double(whole(tile.left + x) + dx - plane.origin[0]) + COLUMNS;
        let along_row = Lanes::splat_double(plane.column) * columns;
        let mut below = edges.map(|edge| edge.value(x, bounds.y[0]));
        for y in bounds.y[0]..bounds.y[1] + 1 {
            let at = below;
            below = [at[0] + edges[0].row, at[1] + edges[1].row, at[2] + edges[2].row];
            if bounds.x[1] - bounds.x[0] > 15 && (at[0] + most[0]) | (at[1] + most[1]) | (at[2] + most[2]) < 0
            {
                continue;
            }
            let window_y = height as f64 - (whole(tile.top + y) + dy);
            let row_depth = plane.at + plane.row * (window_y - plane.origin[1]);
            let place = base + y * TILE + x;
            let (Some(depths), Some(visible)) =
                (tile.depth[place..].first_chunk_mut(), tile.visible[place..].first_chunk_mut())
            else {
                continue;
            };
            let mut signs = [0; WIDTH];
            for (i, sign) in signs.iter_mut().enumerate() {
                // Negative where the pixel is outside of any edge.
                *sign = (at[0] + steps[0][i]) | (at[1] + steps[1][i]) | (at[2] + steps[2][i]);
            }
            depth_test(&signs, Lanes::splat_double(row_depth) + along_row, handle, depths, visible);
        }
    }
}

/// A column or row of the picture as a number.
#[inline(always)]
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_possible_wrap,
    reason = "pictures are at most 16384 wide"
)]
fn whole(pixel: usize) -> f64 {
    f64::from(pixel as i32)
}

/// The columns of eight pixels, from the first one's.
const COLUMNS: Wide<f64> = Wide([0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0]);

/// Depths of eight pixels.
type Lanes = Wide<f32>;

/// Depth test LESS of eight pixels; those that pass keep the new depth and primitive. No branch a
/// pixel, so that it is vectorised.
#[inline(always)]
fn depth_test(
    signs: &[i32; WIDTH],
    z: Wide<f64>,
    handle: Handle,
    depths: &mut [f32; WIDTH],
    visible: &mut [Handle; WIDTH],
) {
    let z = Lanes::narrow(z);
    // A sample may lie outside of the unsnapped corners, and the plane there below 0.
    let z = z.select_less(Lanes::splat(0.0), Lanes::splat(0.0), z);
    for i in 0..WIDTH {
        // Outside, all bits are set: a NaN, which is not nearer than anything.
        let z = f32::from_bits(z.0[i].to_bits() | (signs[i] >> 31).cast_unsigned());
        let pass = z < depths[i];
        depths[i] = if pass { z } else { depths[i] };
        let kept = u32::from(pass).wrapping_neg();
        visible[i] = (handle & kept) | (visible[i] & !kept);
    }
}

/// The triangle's edges over a tile for a sample at `offset`; `None` if the tile is outside of one.
#[inline(always)]
fn tile_edges(corners: &[Corner; 3], tile: &Tile, offset: [i32; 2]) -> Option<[Edge; 3]> {
    let (a, b, c) = (corners[0].snapped?, corners[1].snapped?, corners[2].snapped?);
    Some([tile_edge(a, b, tile, offset)?, tile_edge(b, c, tile, offset)?, tile_edge(c, a, tile, offset)?])
}

/// The edge from `from` to `to` over a tile; `None` if the whole tile is outside.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_possible_wrap,
    reason = "an edge that crosses the tile is below 127 · 2^24 in it"
)]
#[inline(always)]
fn tile_edge(from: [i32; 2], to: [i32; 2], tile: &Tile, offset: [i32; 2]) -> Option<Edge> {
    let (column, row) = (from[1] - to[1], to[0] - from[0]);
    let inclusive = column > 0 || (column == 0 && row < 0);
    let first = |start: usize, axis: usize| {
        start as i64 * i64::from(SUBPIXELS) + i64::from(offset[axis]) - i64::from(from[axis])
    };
    let value = i64::from(column) * first(tile.left, 0) + i64::from(row) * first(tile.top, 1);
    let at = (value - i64::from(!inclusive)) >> SUBPIXELS.trailing_zeros();
    let last = TILE as i64 - 1;
    let (columns, rows) = (i64::from(column) * last, i64::from(row) * last);
    if at + columns.max(0) + rows.max(0) < 0 {
        return None;
    }
    if at + columns.min(0) + rows.min(0) >= 0 {
        return Some(Edge::default());
    }
    Some(Edge { at: at as i32, column, row })
}

impl DepthPlane {
    /// The plane through the unsnapped corners; `scale` is 1 / `window_area`.
    #[inline(always)]
    fn of(corners: &[Corner; 3], scale: f64) -> Self {
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
}
