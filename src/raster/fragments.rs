//! Fragment lists: which pixels of a tile see which primitives of a draw call.

use std::ops::Range;

use super::{
    handle::Handle,
    tiling::{TILE, TILE_PIXELS},
};
use crate::lanes::MAX_LANES;

/// Pixels of a block of four by two.
pub(super) const BLOCK_PIXELS: usize = 8;

/// A tile's side as the fragment list counts pixels.
#[expect(clippy::cast_possible_truncation, reason = "the pixels of a tile are numbered in 16 bits")]
pub(super) const TILE_SIDE: u16 = TILE as u16;

/// Pixels of a block of four by two. Small triangles fill blocks better than rows, and the fewer
/// triangles meet in a group of fragments, the less there is to interpolate.
const BLOCK: [u16; BLOCK_PIXELS] = [0, 1, 2, 3, TILE_SIDE, TILE_SIDE + 1, TILE_SIDE + 2, TILE_SIDE + 3];

/// Whether eight pixels are those of a block.
#[inline(always)]
pub(super) fn is_block(pixels: &[u16; BLOCK_PIXELS]) -> bool {
    let differing = |seen, (&pixel, offset): (&u16, u16)| seen | (pixel.wrapping_sub(pixels[0]) ^ offset);
    pixels.iter().zip(BLOCK).fold(0, differing) == 0
}

/// The pixels of each block of a tile.
#[inline(always)]
pub(super) fn blocks() -> impl Iterator<Item = [u16; BLOCK_PIXELS]> {
    (0..TILE_PIXELS / BLOCK_PIXELS).map(
        #[inline(always)]
        |block| {
            let (row, column) = (block / (TILE / 4), block % (TILE / 4));
            let first = pixel_number(2 * TILE * row + 4 * column);
            BLOCK.map(
                #[inline(always)]
                |offset| first + offset,
            )
        },
    )
}

/// The fragments of one draw call in one tile. Every pixel and primitive is listed once; the
/// lists are filled up to a multiple of [`MAX_LANES`] by repeating the last fragment.
#[derive(Clone, Debug, Default)]
pub(super) struct FragmentList {
    /// How many fragments are meant. The lists have room for more.
    pub(super) len: usize,
    /// The triangle that covers the tile alone, if there is one: then nothing but colours is listed, for all pixels
    /// row by row.
    pub(super) whole: Option<Handle>,
    /// Number of the pixel in the tile.
    pub(super) pixels: Vec<u16>,
    /// Samples of the pixel in which the primitive is seen.
    pub(super) weights: Vec<u8>,
    /// The primitives.
    pub(super) primitives: Vec<Handle>,
    /// Where in the pixel it is shaded: 0 for its centre, else one more than the number of a sample. Empty where
    /// pixels have one sample.
    pub(super) places: Vec<u8>,
    /// Whether several fragments may share a pixel. Then their colours are wanted as they are, else as they are
    /// stored.
    pub(super) shares_pixels: bool,
    /// Colours, one plane a channel, 0..=1: what the fragment stage puts out if pixels are shared.
    pub(super) colors: [Vec<f32>; 3],
    /// Stored colours: what it puts out if they are not.
    pub(super) packed: Vec<u32>,
}

impl FragmentList {
    /// Empties the list and makes room for what a tile's samples may see. A list is used again and again,
    /// and what it held is not cleared.
    pub(super) fn clear(&mut self, samples: usize) {
        let room = TILE_PIXELS * samples + MAX_LANES;
        self.len = 0;
        self.whole = None;
        self.pixels.resize(room, 0);
        self.weights.resize(room, 0);
        self.primitives.resize(room, 0);
        self.places.resize(if samples == 1 { 0 } else { room }, 0);
        self.shares_pixels = samples > 1;
        let (shared, alone) = if samples == 1 { (0, room) } else { (room, 0) };
        for plane in &mut self.colors {
            plane.resize(shared, 0.0);
        }
        self.packed.resize(alone, 0);
    }

    /// Becomes that of a tile which a triangle covers alone. There must be room for the colours of its pixels.
    pub(super) fn set_whole(&mut self, primitive: Handle) {
        self.len = TILE_PIXELS;
        self.whole = Some(primitive);
        self.shares_pixels = false;
    }

    /// Lists the pixels of a tile with one sample whose visible primitive is in `handles`, block by block.
    #[inline(always)]
    pub(super) fn list_visible(&mut self, visible: &[Handle], handles: &Range<Handle>) {
        // A block is written as a whole, and what was not meant is overwritten by the next.
        let mut len = 0;
        for first in (0..visible.len()).step_by(2 * TILE).flat_map(|row| (row..row + TILE).step_by(4)) {
            let mut block = [0; BLOCK_PIXELS];
            block[..4].copy_from_slice(&visible[first..first + 4]);
            block[4..].copy_from_slice(&visible[first + TILE..first + TILE + 4]);
            if block.iter().fold(0, |seen, handle| seen | handle) == 0 {
                continue;
            }
            let (Some(pixels), Some(primitives)) = (
                self.pixels[len..].first_chunk_mut::<BLOCK_PIXELS>(),
                self.primitives[len..].first_chunk_mut::<BLOCK_PIXELS>(),
            ) else {
                return;
            };
            if block.iter().fold(true, |all, handle| all & handles.contains(handle)) {
                *pixels = BLOCK.map(|offset| pixel_number(first) + offset);
                *primitives = block;
                len += BLOCK_PIXELS;
                continue;
            }
            let mut kept = 0;
            for (offset, primitive) in BLOCK.into_iter().zip(block) {
                // Written always and kept only if it is one: no branch to mispredict.
                pixels[kept % BLOCK_PIXELS] = pixel_number(first) + offset;
                primitives[kept % BLOCK_PIXELS] = primitive;
                kept += usize::from(handles.contains(&primitive));
            }
            len += kept;
        }
        self.len = len;
    }

    /// Adds the primitives in `handles` that the samples of a pixel see, each once, to be shaded at its `place`.
    #[inline(always)]
    pub(super) fn add_pixel(
        &mut self,
        pixel: u16,
        visible: &[Handle],
        handles: &Range<Handle>,
        place: impl Fn(Handle) -> u8,
    ) {
        let first = self.len;
        for &primitive in visible[usize::from(pixel)..].iter().step_by(TILE_PIXELS) {
            if !handles.contains(&primitive) {
                continue;
            }
            let known = &self.primitives[first..self.len];
            if let Some(known) = known.iter().position(|&other| other == primitive) {
                self.weights[first + known] += 1;
                continue;
            }
            (self.pixels[self.len], self.primitives[self.len]) = (pixel, primitive);
            (self.weights[self.len], self.places[self.len]) = (1, place(primitive));
            self.len += 1;
        }
    }

    /// Fills the lists up.
    pub(super) fn finish(&mut self) {
        let Some(last) = self.len.checked_sub(1) else { return };
        let (pixel, primitive) = (self.pixels[last], self.primitives[last]);
        let rest = self.len..self.len.next_multiple_of(MAX_LANES);
        self.pixels[rest.clone()].fill(pixel);
        self.primitives[rest.clone()].fill(primitive);
        if let Some(&place) = self.places.get(last) {
            self.places[rest].fill(place);
        }
    }

    /// The places of a range of fragments; empty where all are shaded at the centre.
    #[inline(always)]
    pub(super) fn places(&self, range: Range<usize>) -> &[u8] {
        self.places.get(range).unwrap_or_default()
    }

    /// The pixels, filled up to whole blocks.
    #[inline(always)]
    pub(super) fn filled(&self) -> &[u16] {
        &self.pixels[..self.len.next_multiple_of(BLOCK_PIXELS)]
    }
}

/// The number of a pixel as the list keeps it.
#[expect(clippy::cast_possible_truncation, reason = "a tile has 4096 pixels")]
fn pixel_number(pixel: usize) -> u16 {
    pixel as u16
}
