//! The edges of a triangle over a tile.
//!
//! An edge function is kept as three integers per tile: its value at a pixel and its steps per column and row.
//! Positions are in 1/256 pixel and pixels are 256 of them apart, so E(i, j) = 256·(A·i + B·j) + c, and E ≥ 0 iff
//! A·i + B·j + ⌊c/256⌋ ≥ 0: exact, in 32 bits.
//!
//! Fill rule: a sample on a left edge or on a lower horizontal edge (GL's bottom, y up) is inside, on any other edge
//! outside, so a sample on a shared edge belongs to exactly one triangle.

use fearless_simd::{Simd, SimdBase, SimdMask, i32x4, i32x8};

use super::{
    framebuffer::Tile,
    setup::Corner,
    tiling::{SUBPIXELS, TILE},
};
use crate::lanes::FragmentLanes;

/// An edge function over a tile's pixels: inside where `at + x·column + y·row >= 0`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Edge {
    at: i32,
    column: i32,
    row: i32,
}

/// The three edges of a triangle, each in a lane.
#[derive(Clone, Copy)]
pub(super) struct Edges<S: Simd> {
    at: i32x4<S>,
    column: i32x4<S>,
    row: i32x4<S>,
}

impl<S: FragmentLanes> Edges<S> {
    #[inline(always)]
    pub(super) fn of(simd: S, [a, b, c]: &[Edge; 3]) -> Self {
        let vector = |a: i32, b: i32, c: i32| i32x4::load_array(simd, [a, b, c, 0]);
        Self {
            at: vector(a.at, b.at, c.at),
            column: vector(a.column, b.column, c.column),
            row: vector(a.row, b.row, c.row),
        }
    }

    /// The values of each edge at eight pixels of a row, of which the first is this far from the pixel of `at`.
    #[inline(always)]
    pub(super) fn values(&self, [right, down]: [i32; 2]) -> [i32x8<S>; 3] {
        let first = (self.at + self.column * right + self.row * down).to_array();
        let (column, simd) = (self.column.to_array(), self.at.simd);
        let columns = i32x8::load_array(simd, [0, 1, 2, 3, 4, 5, 6, 7]);
        [columns * column[0] + first[0], columns * column[1] + first[1], columns * column[2] + first[2]]
    }

    /// What each edge grows by per row, in all lanes.
    #[inline(always)]
    pub(super) fn rows(&self) -> [i32x8<S>; 3] {
        let (row, simd) = (self.row.to_array(), self.at.simd);
        [i32x8::splat(simd, row[0]), i32x8::splat(simd, row[1]), i32x8::splat(simd, row[2])]
    }
}

/// The longest edge of a small triangle along either axis, in 1/256 pixel.
const SMALL: i32 = 64 * SUBPIXELS;

// Where a pixel lies in the box of a small triangle, products of differences stay in 32 bits.
const _: () = assert!(2 * (SMALL as i64) * ((SMALL + SUBPIXELS) as i64) < 1 << 31);

/// The edges of a triangle that is small: their values in its box are found in 32 bits, all three at once.
#[derive(Clone, Copy)]
pub(super) struct SmallEdges<S: Simd> {
    /// Where each edge starts.
    from: [i32x4<S>; 2],
    column: i32x4<S>,
    row: i32x4<S>,
    /// -1 for an edge on which samples are outside.
    exclusive: i32x4<S>,
}

impl<S: Simd> SmallEdges<S> {
    /// The edges between corners; `None` if one is long.
    #[inline(always)]
    pub(super) fn of(simd: S, [a, b, c]: [[i32; 2]; 3]) -> Option<Self> {
        let from = [0, 1].map(
            #[inline(always)]
            |axis: usize| i32x4::load_array(simd, [a[axis], b[axis], c[axis], a[axis]]),
        );
        let to = [0, 1].map(
            #[inline(always)]
            |axis: usize| i32x4::load_array(simd, [b[axis], c[axis], a[axis], b[axis]]),
        );
        let (column, row) = (from[1] - to[1], to[0] - from[0]);
        // No bit above where both are in -SMALL..SMALL.
        let beyond = ((column + SMALL) | (row + SMALL)) & !(2 * SMALL - 1);
        if !beyond.simd_eq(0).all_true() {
            return None;
        }
        // Negative unless column > 0, or column = 0 and row < 0.
        let exclusive = (column - (row >> 31) - 1) >> 31;
        Some(Self { from, column, row, exclusive })
    }

    /// The edges for samples at `position`, in 1/256 pixel, and that many pixels from it.
    #[inline(always)]
    pub(super) fn at(&self, [x, y]: [i32; 2]) -> Edges<S> {
        let right = i32x4::splat(self.column.simd, x) - self.from[0];
        let down = i32x4::splat(self.column.simd, y) - self.from[1];
        let value = self.column * right + self.row * down + self.exclusive;
        Edges { at: value >> SUBPIXELS.trailing_zeros(), column: self.column, row: self.row }
    }
}

/// The triangle's edges over a tile for a sample at `offset`; `None` if the tile is outside of one.
#[inline(always)]
pub(super) fn tile_edges(corners: &[Corner; 3], tile: &Tile, offset: [i32; 2]) -> Option<[Edge; 3]> {
    let (a, b, c) = (corners[0].snapped()?, corners[1].snapped()?, corners[2].snapped()?);
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
