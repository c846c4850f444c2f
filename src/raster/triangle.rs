//! Coverage and depth of a triangle within one tile.
//!
//! An edge function is kept as three integers per tile: its value at the tile's first pixel and
//! its steps per column and row. Positions are in 1/256 pixel and pixels are 256 of them apart, so
//! E(i, j) = 256·(A·i + B·j) + c, and E ≥ 0 iff A·i + B·j + ⌊c/256⌋ ≥ 0: exact, in 32 bits.
//!
//! Fill rule: a sample on a left edge or on a lower horizontal edge (GL's bottom, y up) is inside,
//! on any other edge outside, so a sample on a shared edge belongs to exactly one triangle.

use fearless_simd::{
    Bytes, Simd, SimdBase, SimdFloat, SimdMask, SimdNarrow, f32x8, f64x4, i32x8, mask64x4, u32x8,
};

use super::{
    depth::{DepthPlane, WIDTH, along_row, whole},
    framebuffer::Tile,
    handle::Handle,
    samples,
    setup::{Bounds, Corner, Viewport},
    tiling::{SUBPIXELS, TILE, TILE_PIXELS},
};
use crate::lanes::{FragmentLanes, Lane};

/// An edge function over a tile's pixels: inside where `at + x·column + y·row >= 0`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
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
    fn steps<S: FragmentLanes>(&self, simd: S) -> i32x8<S> {
        i32x8::load_array(simd, [0, 1, 2, 3, 4, 5, 6, 7]) * self.column
    }

    /// The most that it grows by.
    #[inline(always)]
    fn most(&self) -> i32 {
        (7 * self.column).max(0)
    }
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

    /// Whether it is all of the tile.
    pub(super) fn is_whole(&self) -> bool {
        self.x == [0, TILE - 1] && self.y == [0, TILE - 1]
    }
}

/// Draws a triangle into a tile's depth and visibility.
#[inline(always)]
pub(super) fn draw_triangle<S: FragmentLanes>(
    simd: S,
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
            let sample = Sample { first: sample * TILE_PIXELS, offset, edges };
            draw_sample(simd, tile, &sample, &depth, bounds, handle, viewport.height);
        }
    }
}

/// Whether a triangle may cover samples of a tile.
pub(super) fn touches(corners: &[Corner; 3], tile: &Tile, viewport: &Viewport) -> bool {
    let positions = samples::positions(viewport.samples).iter();
    positions
        .map(|position| position.map(|p| p * (SUBPIXELS / 16)))
        .any(|at| tile_edges(corners, tile, at).is_some())
}

/// The depths of a triangle that covers a tile and surely lies within the depths of the view volume there; `None` if
/// it does not.
pub(super) fn covering(
    corners: &[Corner; 3],
    scale: f64,
    tile: &Tile,
    viewport: &Viewport,
) -> Option<DepthPlane> {
    let positions = samples::positions(viewport.samples).iter();
    let mut offsets = positions.map(|position| position.map(|p| p * (SUBPIXELS / 16)));
    let plane = DepthPlane::of(corners, scale);
    let covers = offsets.all(|offset| tile_edges(corners, tile, offset) == Some([Edge::default(); 3]));
    (covers && plane.is_within([tile.left, tile.top], viewport.height)).then_some(plane)
}

/// One of the samples of every pixel.
struct Sample {
    /// Where its depths begin in the tile.
    first: usize,
    /// Where it lies in a pixel, in 1/256 pixel, x right and y down.
    offset: [i32; 2],
    /// The triangle's edges there.
    edges: [Edge; 3],
}

/// One sample of every pixel in `bounds`, eight pixels of a row at a time.
#[inline(always)]
fn draw_sample<S: FragmentLanes>(
    simd: S,
    tile: &mut Tile,
    Sample { first, offset, edges }: &Sample,
    plane: &DepthPlane,
    bounds: TileBounds,
    handle: Handle,
    height: usize,
) {
    let dx = f64::from(offset[0]) / f64::from(SUBPIXELS);
    let dy = f64::from(offset[1]) / f64::from(SUBPIXELS);
    let steps = [edges[0].steps(simd), edges[1].steps(simd), edges[2].steps(simd)];
    let most = [edges[0].most(), edges[1].most(), edges[2].most()];
    let mut start = bounds.x[0];
    while start <= bounds.x[1] {
        let x = start.min(TILE - WIDTH);
        start += WIDTH;
        let along_row = along_row(simd, whole(tile.left + x) + dx - plane.origin[0], plane.column);
        let mut below =
            [edges[0].value(x, bounds.y[0]), edges[1].value(x, bounds.y[0]), edges[2].value(x, bounds.y[0])];
        for y in bounds.y[0]..bounds.y[1] + 1 {
            let at = below;
            below = [at[0] + edges[0].row, at[1] + edges[1].row, at[2] + edges[2].row];
            if bounds.x[1] - bounds.x[0] > 15 && (at[0] + most[0]) | (at[1] + most[1]) | (at[2] + most[2]) < 0
            {
                continue;
            }
            let window_y = height as f64 - (whole(tile.top + y) + dy);
            let row_depth = f64x4::splat(simd, plane.at + plane.row * (window_y - plane.origin[1]));
            let z = (row_depth + along_row.0).narrow(row_depth + along_row.1);
            // Negative where the pixel is outside of any edge.
            let signs = (steps[0] + at[0]) | (steps[1] + at[1]) | (steps[2] + at[2]);
            let pixels = first + y * TILE + x;
            if let (Some(depths), Some(visible)) =
                (tile.depth[pixels..].first_chunk_mut(), tile.visible[pixels..].first_chunk_mut())
            {
                depth_test(signs, z, handle, depths, visible);
            }
        }
    }
}

/// Depth test LESS of eight pixels; those that pass keep the new depth and primitive.
///
/// Minimum and maximum in place of selections: of those the compiler makes stores of single lanes, which
/// are slow on some CPUs.
#[inline(always)]
fn depth_test<S: FragmentLanes>(
    signs: i32x8<S>,
    z: f32x8<S>,
    handle: Handle,
    depths: &mut [f32; WIDTH],
    visible: &mut [Handle; WIDTH],
) {
    let simd = z.simd;
    // A sample may lie outside of the unsnapped corners, and the plane there below 0.
    let z = Lane::max(Lane::all(z, 0.0), z);
    // Outside, all bits are set: a NaN, which is not nearer than anything.
    let z = f32x8::from_bits(z.to_bits() | (signs >> 31).bitcast::<u32x8<S>>());
    let old = f32x8::load_array(simd, *depths);
    *depths = Lane::min(z, old).to_array();
    // In a tile, handles only grow.
    let passed = z.simd_lt(old).to_vector().bitcast::<u32x8<S>>() & handle;
    *visible = SimdBase::max(u32x8::load_array(simd, *visible), passed).to_array();
}

/// The first of several samples of a pixel that a triangle covers; `None` if it covers all of them, or none. The fill
/// rule is that of [`tile_edge`]; the values of edges are whole numbers below 2^53, and exact.
#[inline(always)]
pub(super) fn first_covered<S: Simd>(
    simd: S,
    corners: &[Corner; 3],
    pixel: [usize; 2],
    samples: usize,
) -> Option<usize> {
    let [a, b, c] = [corners[0].snapped?, corners[1].snapped?, corners[2].snapped?];
    let (mut covered, mut all) = (0, 0);
    for (first, four) in (0..).step_by(4).zip(samples::positions(samples).as_chunks::<4>().0) {
        let mut inside = mask64x4::splat(simd, true);
        for (from, to) in [(a, b), (b, c), (c, a)] {
            let (column, row) = (f64::from(from[1] - to[1]), f64::from(to[0] - from[0]));
            let inclusive = column > 0.0 || (column == 0.0 && row < 0.0);
            let at = |axis: usize| whole(pixel[axis]) * f64::from(SUBPIXELS) - f64::from(from[axis]);
            let corner = column * at(0) + row * at(1) - f64::from(u8::from(!inclusive));
            let offsets = |axis: usize| four.map(|position| f64::from(position[axis] * (SUBPIXELS / 16)));
            let (x, y) = (f64x4::load_array(simd, offsets(0)), f64x4::load_array(simd, offsets(1)));
            inside &= (x * column + y * row + corner).simd_ge(0.0);
        }
        covered |= inside.to_bitmask() << first;
        all |= 0b1111 << first;
    }
    (covered != 0 && covered != all).then(|| covered.trailing_zeros() as usize)
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
