//! How a picture is cut into tiles.

use crate::lanes::MAX_LANES;

/// Width and height of a tile in pixels.
pub(super) const TILE: usize = 64;
/// Pixels of a tile.
pub(super) const TILE_PIXELS: usize = TILE * TILE;

/// Sub-pixel positions per pixel: coverage is decided on a grid of 1/256 pixel.
pub(super) const SUBPIXELS: i32 = 256;

/// Largest coordinate on that grid: 2^23/256 pixels. With it every edge value stays below 2^50.
pub(super) const SNAPPED_LIMIT: i32 = 1 << 23;

// A row of a tile is tested eight pixels at a time, and shaded in blocks of four by two, or as many pixels at a time
// as lanes have.
const _: () = assert!(TILE.is_multiple_of(8) && TILE.is_multiple_of(MAX_LANES));
// A pixel of a tile is numbered in 16 bits.
const _: () = assert!(TILE_PIXELS <= 1 << 16);
// An edge that crosses a tile is, in whole pixels, at most this large in it, and is kept in 32 bits.
const _: () = assert!((2 * TILE as i64 - 1) * 2 * (SNAPPED_LIMIT as i64) < 1 << 31);

/// Column and row of the tile that a pixel lies in.
pub(super) fn tile_of(pixel: [u16; 2]) -> [usize; 2] {
    [usize::from(pixel[0]) / TILE, usize::from(pixel[1]) / TILE]
}
