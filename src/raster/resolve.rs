//! Resolve: from the colours of fragments to the stored colours of pixels.
//!
//! A pixel's colour is the mean over its samples of the clamped linear colours, rounded half to
//! even to 8 bits.

use super::{
    fragments::{BLOCK_PIXELS, FragmentList, is_block},
    framebuffer::Tile,
    tiling::{TILE, TILE_PIXELS},
};
use crate::lanes::rgba8;

/// The pixels of a tile with several samples; empty if there is one.
pub(super) struct Pixels {
    /// Handles of all samples together: 0 where only the background is seen.
    pub(super) seen: Vec<u32>,
    /// Colours times the share of the samples that see them. In f64 the shares, of sixteenths, and their
    /// sums are exact, so that the mean of equal colours is that colour.
    pub(super) sums: Vec<[f64; 3]>,
}

impl Pixels {
    /// The pixels with the background's share.
    pub(super) fn of(tile: &Tile, background: [f32; 3], samples: usize) -> Self {
        if samples == 1 {
            return Self { seen: Vec::new(), sums: Vec::new() };
        }
        let background = background.map(clamp);
        let (first, others) = tile.visible.split_at(TILE_PIXELS);
        let (mut seen, mut free) =
            (first.to_vec(), first.iter().map(|&h| u8::from(h == 0)).collect::<Vec<_>>());
        for sample in others.chunks_exact(TILE_PIXELS) {
            for ((seen, free), &handle) in seen.iter_mut().zip(&mut free).zip(sample) {
                *seen |= handle;
                *free += u8::from(handle == 0);
            }
        }
        let mut sums = vec![[0.0; 3]; TILE_PIXELS];
        for (sum, free) in sums.iter_mut().zip(free).filter(|&(_, free)| free > 0) {
            add(sum, background, f64::from(free) / samples as f64);
        }
        Self { seen, sums }
    }

    /// Stores the means of the pixels that see something; how many they are.
    pub(super) fn resolve(self, tile: &mut Tile) -> u64 {
        let mut covered = 0;
        for ((color, seen), sum) in tile.color.iter_mut().zip(self.seen).zip(self.sums) {
            if seen != 0 {
                #[expect(clippy::cast_possible_truncation, reason = "colours are f32")]
                let mean = sum.map(|channel| channel as f32);
                *color = rgba8(mean);
                covered += 1;
            }
        }
        covered
    }
}

/// Adds the colours of a list to the sums of their pixels, each by its share of the samples.
#[inline(always)]
pub(super) fn accumulate(list: &FragmentList, samples: usize, sums: &mut [[f64; 3]]) {
    let [red, green, blue] = &list.colors;
    for (i, &pixel) in list.pixels[..list.len].iter().enumerate() {
        let share = f64::from(list.weights[i]) / samples as f64;
        add(&mut sums[usize::from(pixel)], [red[i], green[i], blue[i]], share);
    }
}

/// Stores the colours of a list whose pixels are all different.
#[inline(always)]
pub(super) fn write_colors(tile: &mut Tile, list: &FragmentList) {
    let colors = list.packed.as_chunks().0;
    for (pixels, colors) in list.filled().as_chunks().0.iter().zip(colors) {
        write_block(&mut tile.color, pixels, colors);
    }
}

/// Writes the colours of eight fragments. The last may be one that fills the list up: it is stored once
/// more, with the same colour.
#[inline(always)]
fn write_block(tile: &mut [u32], pixels: &[u16; BLOCK_PIXELS], colors: &[u32; BLOCK_PIXELS]) {
    if is_block(pixels) {
        let first = usize::from(pixels[0]);
        let (top, bottom) = colors.split_at(BLOCK_PIXELS / 2);
        tile[first..first + BLOCK_PIXELS / 2].copy_from_slice(top);
        tile[first + TILE..first + TILE + BLOCK_PIXELS / 2].copy_from_slice(bottom);
        return;
    }
    for (&pixel, &color) in pixels.iter().zip(colors) {
        tile[usize::from(pixel)] = color;
    }
}

/// Adds a share of a colour.
#[inline(always)]
fn add(sum: &mut [f64; 3], color: [f32; 3], share: f64) {
    for (sum, color) in sum.iter_mut().zip(color) {
        *sum += f64::from(color) * share;
    }
}

/// A colour channel in 0..=1; NaN is 0.
fn clamp(c: f32) -> f32 {
    if c > 0.0 { c.min(1.0) } else { 0.0 }
}

/// The stored colour of the background.
pub(super) fn background(color: [f32; 3]) -> u32 {
    rgba8(color.map(clamp))
}
