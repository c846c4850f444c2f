//! Coverage and depth of a triangle within one tile.
//!
//! An edge function is kept as three integers per tile: its value at the tile's first pixel and
//! its steps per column and row. Positions are in 1/256 pixel and pixels are 256 of them apart, so
//! E(i, j) = 256·(A·i + B·j) + c, and E ≥ 0 iff A·i + B·j + ⌊c/256⌋ ≥ 0: exact, in 32 bits.
//!
//! Fill rule: a sample on a left edge or on a lower horizontal edge (GL's bottom, y up) is inside,
//! on any other edge outside, so a sample on a shared edge belongs to exactly one triangle.

use super::{
    bin::Handle,
    framebuffer::{TILE, TILE_PIXELS, Tile},
    samples,
    setup::{Bounds, SUBPIXELS, Triangle, Viewport, window_area},
};
use crate::lanes::WIDTH;

/// An edge function over a tile's pixels: inside where `at + x·column + y·row >= 0`.
#[derive(Clone, Copy, Debug, Default)]
struct Edge {
    at: i32,
    column: i32,
    row: i32,
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
        let within = |[first, last]: [usize; 2], start: usize| {
            [first.max(start) - start, (last - start).min(TILE - 1)]
        };
        Self { x: within(bounds.x, tile.left), y: within(bounds.y, tile.top) }
    }
}

/// Draws a triangle into a tile's depth and visibility. Returns the samples that passed.
#[inline(always)]
pub(super) fn draw_triangle(
    tile: &mut Tile,
    triangle: &Triangle,
    bounds: TileBounds,
    handle: Handle,
    viewport: &Viewport,
) {
    let depth = DepthPlane::of(triangle);
    for (sample, position) in samples::positions(viewport.samples).iter().enumerate() {
        let offset = position.map(|sixteenths| sixteenths * (SUBPIXELS / 16));
        if let Some(edges) = tile_edges(triangle, tile, offset) {
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
    let [dx, dy] = offset.map(|o| f64::from(o) / f64::from(SUBPIXELS));
    for y in bounds.y[0]..=bounds.y[1] {
        let window_y = height as f64 - ((tile.top + y) as f64 + dy);
        let row_depth = plane.at + plane.row * (window_y - plane.origin[1]);
        let row = base + y * TILE;
        for x in (bounds.x[0]..=bounds.x[1]).step_by(WIDTH) {
            let x = x.min(TILE - WIDTH);
            let edges = edge_signs(edges, x, y);
            if edges.iter().fold(-1, |all, e| all & e) < 0 {
                continue;
            }
            let (Some(depths), Some(visible)) =
                (tile.depth[row + x..].first_chunk_mut(), tile.visible[row + x..].first_chunk_mut())
            else {
                continue;
            };
            let window_x = (tile.left + x) as f64 + dx - plane.origin[0];
            depth_test(&edges, row_depth, plane.column, window_x, handle, depths, visible);
        }
    }
}

/// Per pixel, a number that is negative if the pixel is outside of any edge: eight pixels of row
/// `y` from column `x`.
#[inline(always)]
#[expect(clippy::cast_possible_truncation, clippy::cast_possible_wrap, reason = "x and y are below 64")]
fn edge_signs(edges: &[Edge; 3], x: usize, y: usize) -> [i32; WIDTH] {
    let start = |edge: &Edge| edge.at + edge.column * x as i32 + edge.row * y as i32;
    let (a, b, c) = (start(&edges[0]), start(&edges[1]), start(&edges[2]));
    let mut signs = [0; WIDTH];
    for (i, sign) in signs.iter_mut().enumerate() {
        let i = i as i32;
        *sign = (a + edges[0].column * i) | (b + edges[1].column * i) | (c + edges[2].column * i);
    }
    signs
}

/// Depth test LESS of eight pixels; those that pass keep the new depth and primitive.
#[inline(always)]
#[expect(clippy::cast_possible_truncation, reason = "the depth buffer is f32")]
fn depth_test(
    edges: &[i32; WIDTH],
    row_depth: f64,
    column_depth: f64,
    window_x: f64,
    handle: Handle,
    depths: &mut [f32; WIDTH],
    visible: &mut [Handle; WIDTH],
) {
    for i in 0..WIDTH {
        let z = (row_depth + column_depth * (window_x + i as f64)) as f32;
        // A sample may lie outside of the unsnapped corners, and the plane there below 0.
        let z = if z < 0.0 { 0.0 } else { z };
        let pass = (edges[i] >= 0) & (z < depths[i]);
        depths[i] = if pass { z } else { depths[i] };
        visible[i] = if pass { handle } else { visible[i] };
    }
}

/// The triangle's edges over a tile for a sample at `offset`; `None` if the tile is outside of one.
fn tile_edges(triangle: &Triangle, tile: &Tile, offset: [i32; 2]) -> Option<[Edge; 3]> {
    let [a, b, c] = triangle.snapped;
    Some([tile_edge(a, b, tile, offset)?, tile_edge(b, c, tile, offset)?, tile_edge(c, a, tile, offset)?])
}

/// The edge from `from` to `to` over a tile; `None` if the whole tile is outside.
#[expect(clippy::cast_possible_truncation, clippy::cast_possible_wrap, reason = "bounded by `reach` < 2^30")]
fn tile_edge(from: [i32; 2], to: [i32; 2], tile: &Tile, offset: [i32; 2]) -> Option<Edge> {
    let (column, row) = (from[1] - to[1], to[0] - from[0]);
    let inclusive = column > 0 || (column == 0 && row < 0);
    let first = |start: usize, axis: usize| {
        start as i64 * i64::from(SUBPIXELS) + i64::from(offset[axis]) - i64::from(from[axis])
    };
    let value = i64::from(column) * first(tile.left, 0) + i64::from(row) * first(tile.top, 1);
    let at = (value - i64::from(!inclusive)).div_euclid(i64::from(SUBPIXELS));
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
    /// The plane through the unsnapped corners.
    fn of(triangle: &Triangle) -> Self {
        let [a, b, c] = &triangle.window;
        let d = |to: f32, from: f32| f64::from(to) - f64::from(from);
        let scale = 1.0 / window_area(&triangle.window);
        let (zb, zc) = (d(b.z, a.z), d(c.z, a.z));
        Self {
            origin: [a.x.into(), a.y.into()],
            at: a.z.into(),
            column: (zb * d(c.y, a.y) - zc * d(b.y, a.y)) * scale,
            row: (zc * d(b.x, a.x) - zb * d(c.x, a.x)) * scale,
        }
    }
}
