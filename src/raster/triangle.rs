//! Coverage and depth of a triangle within one tile.

use fearless_simd::{
    Bytes, Simd, SimdBase, SimdFloat, SimdMask, SimdNarrow, f32x8, f64x4, i32x8, mask64x4, u32x8,
};

use super::{
    depth::{DepthPlane, WIDTH, along_row, whole},
    edges::{Edge, Edges, SmallEdges, tile_edges},
    framebuffer::Tile,
    handle::Handle,
    samples,
    setup::{Bounds, Corner, Viewport},
    tiling::{SUBPIXELS, TILE, TILE_PIXELS},
};
use crate::lanes::{FragmentLanes, Lane};

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
    let (Some(a), Some(b), Some(c)) = (corners[0].snapped(), corners[1].snapped(), corners[2].snapped())
    else {
        return;
    };
    let depth = DepthPlane::of(corners, scale);
    let offsets = samples::positions(viewport.samples).iter().zip((0..).step_by(TILE_PIXELS)).map(
        #[inline(always)]
        |(&[x, y], first)| ([x * (SUBPIXELS / 16), y * (SUBPIXELS / 16)], first),
    );
    // Two loops, because what only long edges need would be computed before one.
    if let Some(small) = SmallEdges::of(simd, [a, b, c]) {
        // In the box, where 32 bits suffice.
        let origin = [bounds.x[0], bounds.y[0]];
        let pixel = [grid(tile.left + origin[0]), grid(tile.top + origin[1])];
        for (offset, first) in offsets {
            let edges = small.at([pixel[0] + offset[0], pixel[1] + offset[1]]);
            let sample = Sample { first, offset, edges, origin };
            draw_sample(simd, tile, &sample, &depth, bounds, handle, viewport.height);
        }
        return;
    }
    for (offset, first) in offsets {
        if let Some(edges) = tile_edges(corners, tile, offset) {
            let sample = Sample { first, offset, edges: Edges::of(simd, &edges), origin: [0; 2] };
            draw_sample(simd, tile, &sample, &depth, bounds, handle, viewport.height);
        }
    }
}

/// The left or top side of a pixel in 1/256 pixel.
#[inline(always)]
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_possible_wrap,
    reason = "pictures are at most 16384 wide"
)]
fn grid(pixel: usize) -> i32 {
    pixel as i32 * SUBPIXELS
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
struct Sample<S: FragmentLanes> {
    /// Where its depths begin in the tile.
    first: usize,
    /// Where it lies in a pixel, in 1/256 pixel, x right and y down.
    offset: [i32; 2],
    /// The triangle's edges there.
    edges: Edges<S>,
    /// The pixel of the tile from which they are counted.
    origin: [usize; 2],
}

impl<S: FragmentLanes> Sample<S> {
    /// How far a pixel is from that.
    #[inline(always)]
    #[expect(clippy::cast_possible_truncation, clippy::cast_possible_wrap, reason = "they are less than 64")]
    fn beyond_origin(&self, x: usize, y: usize) -> [i32; 2] {
        [x as i32 - self.origin[0] as i32, y as i32 - self.origin[1] as i32]
    }
}

/// One sample of every pixel in `bounds`, eight pixels of a row at a time.
#[inline(always)]
fn draw_sample<S: FragmentLanes>(
    simd: S,
    tile: &mut Tile,
    sample: &Sample<S>,
    plane: &DepthPlane,
    bounds: TileBounds,
    handle: Handle,
    height: usize,
) {
    let dx = f64::from(sample.offset[0]) / f64::from(SUBPIXELS);
    let dy = f64::from(sample.offset[1]) / f64::from(SUBPIXELS);
    let (left, top) = (tile.left, tile.top);
    let rows = sample.first / TILE + bounds.y[0]..sample.first / TILE + bounds.y[1] + 1;
    let (Some(depths), Some(visible)) =
        (tile.depth.as_chunks_mut().0.get_mut(rows.clone()), tile.visible.as_chunks_mut().0.get_mut(rows))
    else {
        return;
    };
    let [down0, down1, down2] = sample.edges.rows();
    let wide = bounds.x[1] - bounds.x[0] > 15;
    let mut start = bounds.x[0];
    while start <= bounds.x[1] {
        let x = start.min(TILE - WIDTH);
        start += WIDTH;
        let along_row = along_row(simd, whole(left + x) + dx - plane.origin[0], plane.column);
        let mut next = sample.edges.values(sample.beyond_origin(x, bounds.y[0]));
        // Whole numbers and sixteenths: a row down is exactly one less.
        let mut window_y = height as f64 - (whole(top + bounds.y[0]) + dy);
        for (depths, visible) in depths.iter_mut().zip(visible.iter_mut()) {
            let [v0, v1, v2] = next;
            next = [v0 + down0, v1 + down1, v2 + down2];
            let row_depth = plane.at + plane.row * (window_y - plane.origin[1]);
            window_y -= 1.0;
            // Negative where the pixel is outside of any edge.
            let signs = v0 | v1 | v2;
            if wide && signs.simd_lt(0).all_true() {
                continue;
            }
            let row_depth = f64x4::splat(simd, row_depth);
            let z = (row_depth + along_row.0).narrow(row_depth + along_row.1);
            if let (Some(depths), Some(visible)) = (eight(depths, x), eight(visible, x)) {
                depth_test(signs, z, handle, depths, visible);
            }
        }
    }
}

/// Eight pixels of a row.
#[inline(always)]
fn eight<T>(row: &mut [T; TILE], x: usize) -> Option<&mut [T; WIDTH]> {
    row[x..].first_chunk_mut()
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
    let [a, b, c] = [corners[0].snapped()?, corners[1].snapped()?, corners[2].snapped()?];
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
