//! One tile from clear to stored colour: visibility of all primitives, then shading of what is
//! seen, then the mean of each pixel's samples.
//!
//! A primitive is shaded once per pixel, at the pixel's centre, however many samples it has there.
//! A pixel's colour is the mean over its samples of the clamped linear colours, rounded half to
//! even to 8 bits.

use std::time::Instant;

use super::{
    TileCost, TileScene,
    bin::{Handle, handle, place},
    framebuffer::{TILE_PIXELS, Tile},
    line::draw_line,
    shade::{Fragment, Fragments},
    tile::{TileBounds, draw_triangle},
};
use crate::dispatch::dispatch;

/// Draws one tile.
pub(super) fn draw_tile(tile: &mut Tile, index: usize, scene: &TileScene<'_>) -> TileCost {
    let started = Instant::now();
    tile.depth.fill(1.0);
    tile.visible.fill(0);
    dispatch(|| draw_primitives(tile, index, scene));
    let seen = Instant::now();
    let mut cost = TileCost { raster: seen - started, ..TileCost::default() };

    let mut sums = vec![[0.0; 3]; if scene.viewport.samples > 1 { TILE_PIXELS } else { 0 }];
    let background = scene.background.map(|c| store(clamp(c)));
    tile.color.fill(background);
    add_background(tile, scene, &mut sums);
    let (mut list, mut colors) = (Vec::new(), Vec::new());
    for call in 0..scene.calls.len() {
        collect_fragments(tile, call, scene, &mut list);
        shade_fragments(tile, call, scene, &list, &mut colors);
        write_colors(tile, &list, &colors, scene.viewport.samples, &mut sums);
        cost.fragments += list.len() as u64;
    }
    for (color, sum) in tile.color.iter_mut().zip(&sums) {
        *color = sum.map(store);
    }
    if scene.ids {
        tile.ids = tile.visible[..TILE_PIXELS].iter().map(|&handle| id(handle, scene)).collect();
    }
    cost.covered = (0..TILE_PIXELS).filter(|&pixel| samples_of(tile, scene, pixel).any(|h| h != 0)).count() as u64;
    cost.shading = seen.elapsed();
    cost
}

/// Depth and visibility of every primitive that touches the tile, in submission order.
#[inline(always)]
fn draw_primitives(tile: &mut Tile, index: usize, scene: &TileScene<'_>) {
    for (number, chunk) in scene.chunks.iter().enumerate() {
        for &primitive in chunk.in_tile(index) {
            let bounds = TileBounds::of(chunk.bounds(primitive), tile);
            let handle = handle(number, primitive);
            if let Some(triangle) = chunk.triangles.get(primitive as usize) {
                draw_triangle(tile, triangle, bounds, handle, &scene.viewport);
            } else if let Some(line) = chunk.lines.get(primitive as usize) {
                draw_line(tile, line, bounds, handle, &scene.viewport);
            }
        }
    }
}

/// What each sample of a pixel sees.
fn samples_of<'a>(tile: &'a Tile, scene: &TileScene<'_>, pixel: usize) -> impl Iterator<Item = Handle> + 'a {
    (0..scene.viewport.samples).map(move |sample| tile.visible[sample * TILE_PIXELS + pixel])
}

/// Lists the pixels in which a primitive of draw call `call` is seen, each primitive once a pixel.
fn collect_fragments(tile: &Tile, call: usize, scene: &TileScene<'_>, list: &mut Vec<Fragment>) {
    list.clear();
    let first = scene.chunks.partition_point(|chunk| chunk.call < call);
    let last = scene.chunks.partition_point(|chunk| chunk.call <= call);
    let handles = handle(first, 0)..handle(last, 0);
    for pixel in 0..TILE_PIXELS {
        let first_of_pixel = list.len();
        for primitive in samples_of(tile, scene, pixel).filter(|seen| handles.contains(seen)) {
            let known = list[first_of_pixel..].iter_mut().find(|fragment| fragment.primitive == primitive);
            if let Some(fragment) = known {
                fragment.weight += 1;
            } else {
                #[expect(clippy::cast_possible_truncation, reason = "a tile has 4096 pixels")]
                list.push(Fragment { pixel: pixel as u16, weight: 1, primitive });
            }
        }
    }
}

/// Runs the fragment program of a call over its fragments.
fn shade_fragments(
    tile: &Tile,
    call: usize,
    scene: &TileScene<'_>,
    list: &[Fragment],
    colors: &mut Vec<[f32; 3]>,
) {
    colors.clear();
    #[expect(clippy::cast_precision_loss, reason = "pictures are at most 16384 pixels wide")]
    let origin = [tile.left as f32 + 0.5, scene.viewport.height as f32 - (tile.top as f32 + 0.5)];
    let fragments = Fragments { list, origin, chunks: scene.chunks, vertices: &scene.buffers[call] };
    (scene.calls[call].fragment_stage)(&fragments, colors);
}

/// Stores colours, or adds them to the pixels' sums by their share of the samples.
fn write_colors(tile: &mut Tile, list: &[Fragment], colors: &[[f32; 3]], samples: usize, sums: &mut [[f32; 3]]) {
    for (fragment, color) in list.iter().zip(colors) {
        let pixel = usize::from(fragment.pixel);
        if samples == 1 {
            tile.color[pixel] = color.map(store);
        } else {
            add(&mut sums[pixel], *color, f32::from(fragment.weight) / samples as f32);
        }
    }
}

/// Adds the background's share to the pixels' sums.
fn add_background(tile: &Tile, scene: &TileScene<'_>, sums: &mut [[f32; 3]]) {
    let background = scene.background.map(clamp);
    for (pixel, sum) in sums.iter_mut().enumerate() {
        let free = samples_of(tile, scene, pixel).filter(|&handle| handle == 0).count();
        #[expect(clippy::cast_precision_loss, reason = "at most 16 samples")]
        add(sum, background, free as f32 / scene.viewport.samples as f32);
    }
}

fn add(sum: &mut [f32; 3], color: [f32; 3], share: f32) {
    for (sum, color) in sum.iter_mut().zip(color) {
        *sum += color * share;
    }
}

/// Object and triangle of what a pixel sees, as `draw` defines them; 0 for the background.
fn id(handle: Handle, scene: &TileScene<'_>) -> u32 {
    if handle == 0 {
        return 0;
    }
    let (chunk, index) = place(handle);
    let chunk = &scene.chunks[chunk];
    let source = chunk
        .triangles
        .get(index)
        .map(|triangle| triangle.source)
        .or_else(|| chunk.lines.get(index).map(|line| line.source));
    #[expect(clippy::cast_possible_truncation, reason = "objects are few")]
    let object = chunk.call as u32 + 1;
    object << 24 | (source.unwrap_or(0) + 1)
}

/// A colour channel in 0..=1; NaN is 0.
fn clamp(c: f32) -> f32 {
    if c > 0.0 { c.min(1.0) } else { 0.0 }
}

/// 8 bits of a channel in 0..=1: round-half-even(255·c).
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 <= c <= 1")]
fn store(c: f32) -> u8 {
    (c * 255.0).round_ties_even() as u8
}
