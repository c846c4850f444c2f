//! Resolve: from the colours of fragments to the stored colours of pixels.
//!
//! A pixel's colour is the mean over its samples of the clamped linear colours, rounded half to
//! even to 8 bits.

use super::{
    fragments::{BLOCK_PIXELS, FragmentList, blocks, is_block},
    handle::Handle,
    tiling::{TILE, TILE_PIXELS},
};
use crate::lanes::rgba8;

/// What the samples of a tile's pixels see, where a pixel has several. Memory that is used for one tile after the
/// other.
#[derive(Clone, Debug, Default)]
pub(super) struct Pixels {
    /// Per pixel, what all of its samples see; 0 where they differ or see the background.
    pub(super) agreed: Vec<Handle>,
    /// The pixels whose samples differ, block by block.
    pub(super) mixed: Vec<u16>,
    /// Of each of them, colours times the share of the samples that see them. In f64 the shares, of sixteenths, and
    /// their sums are exact, so that the mean of equal colours is that colour.
    sums: Vec<[f64; 3]>,
}

impl Pixels {
    /// Finds out in which pixels the samples differ, and gives those the background's share.
    #[inline(always)]
    pub(super) fn set(&mut self, visible: &[Handle], background: [f32; 3]) {
        let (first, others) = visible.split_at(TILE_PIXELS);
        let mut differing = [0; TILE_PIXELS];
        for sample in others.chunks_exact(TILE_PIXELS) {
            for ((differing, &first), &handle) in differing.iter_mut().zip(first).zip(sample) {
                *differing |= first ^ handle;
            }
        }
        // Every number is written: of one that may stay the compiler makes a masked store.
        self.agreed.resize(TILE_PIXELS, 0);
        for ((agreed, &first), &differing) in self.agreed.iter_mut().zip(first).zip(&differing) {
            *agreed = if differing == 0 { first } else { 0 };
        }
        self.mixed.clear();
        for block in blocks() {
            let differs = |pixel: u16| differing[usize::from(pixel)] != 0;
            if block.iter().fold(false, |any, &pixel| any | differs(pixel)) {
                self.mixed.extend(block.iter().filter(|&&pixel| differs(pixel)));
            }
        }
        let (background, samples) = (background.map(clamp), visible.len() / TILE_PIXELS);
        self.sums.clear();
        for &pixel in &self.mixed {
            let seen = (0..samples).map(|sample| visible[sample * TILE_PIXELS + usize::from(pixel)]);
            let free: u8 = seen.map(|handle| u8::from(handle == 0)).sum();
            let mut sum = [0.0; 3];
            if free > 0 {
                add(&mut sum, background, f64::from(free) / samples as f64);
            }
            self.sums.push(sum);
        }
    }

    /// Adds the colours of a list to the sums of their pixels, each by its share of the samples. The list has its
    /// pixels in the order of `mixed`.
    pub(super) fn accumulate(&mut self, list: &FragmentList, samples: usize) {
        let [red, green, blue] = &list.colors;
        let mut sums = self.mixed.iter().zip(&mut self.sums);
        let mut last = sums.next();
        for (i, &pixel) in list.pixels[..list.len].iter().enumerate() {
            while last.as_ref().is_some_and(|&(&mixed, _)| mixed != pixel) {
                last = sums.next();
            }
            let Some((_, sum)) = &mut last else { return };
            add(sum, [red[i], green[i], blue[i]], f64::from(list.weights[i]) / samples as f64);
        }
    }

    /// Stores the means of the pixels whose samples differ.
    pub(super) fn resolve(&self, colors: &mut [u32]) {
        for (&pixel, sum) in self.mixed.iter().zip(&self.sums) {
            #[expect(clippy::cast_possible_truncation, reason = "colours are f32")]
            let mean = sum.map(|channel| channel as f32);
            colors[usize::from(pixel)] = rgba8(mean);
        }
    }
}

/// Stores the colours of a list whose pixels are all different.
#[inline(always)]
pub(super) fn write_colors(tile: &mut [u32], list: &FragmentList) {
    let colors = list.packed.as_chunks().0;
    for (pixels, colors) in list.filled().as_chunks().0.iter().zip(colors) {
        write_block(tile, pixels, colors);
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
