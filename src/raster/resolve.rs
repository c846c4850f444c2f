//! One tile from clear to stored colour: visibility of all primitives, then shading of what is
//! seen, then the mean of each pixel's samples.
//!
//! A primitive is shaded once per pixel, at the pixel's centre, however many samples it has there.
//! A pixel's colour is the mean over its samples of the clamped linear colours, rounded half to
//! even to 8 bits.

use std::{ops::Range, time::Instant};

use super::{
    TileCost, TileScene,
    bin::{Handle, handle, place},
    framebuffer::{TILE_PIXELS, Tile},
    line::draw_line,
    shade::{FragmentList, ShadeInput},
    tile::{TileBounds, draw_triangle},
};
use crate::dispatch::{Work, dispatch};

/// Draws one tile.
pub(super) fn draw_tile(tile: &mut Tile, index: usize, scene: &TileScene<'_>) -> TileCost {
    let started = Instant::now();
    tile.depth.fill(1.0);
    tile.visible.fill(0);
    dispatch(Visibility { tile, index, scene });
    let seen = Instant::now();
    let mut cost = TileCost { raster: seen - started, ..TileCost::default() };

    let samples = scene.viewport.samples;
    let mut sums = vec![[0.0; 3]; if samples > 1 { TILE_PIXELS } else { 0 }];
    tile.color.fill(store(scene.background.map(clamp)));
    add_background(tile, scene, &mut sums);
    let mut list = FragmentList::default();
    for call in (0..scene.calls.len()).filter(|&call| touches(call, index, scene)) {
        collect_fragments(tile, call, scene, &mut list);
        shade_fragments(tile, call, scene, &mut list);
        dispatch(WriteColors { tile, list: &list, samples, sums: &mut sums });
        cost.fragments += list.len as u64;
    }
    for (color, sum) in tile.color.iter_mut().zip(&sums) {
        #[expect(clippy::cast_possible_truncation, reason = "colours are f32")]
        let mean = sum.map(|channel| channel as f32);
        *color = store(mean);
    }
    tile.ids.clear();
    if scene.ids {
        tile.ids = tile.visible[..TILE_PIXELS].iter().map(|&handle| id(handle, scene)).collect();
    }
    cost.covered = if samples == 1 { cost.fragments } else { covered(tile, samples) };
    cost.shading = seen.elapsed();
    cost
}

/// Depth and visibility of every primitive that touches the tile, in submission order.
struct Visibility<'a> {
    tile: &'a mut Tile,
    index: usize,
    scene: &'a TileScene<'a>,
}

impl Work for Visibility<'_> {
    #[inline(always)]
    fn run(self) {
        let Self { tile, index, scene } = self;
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
}

/// The chunks of a draw call.
fn chunks_of(call: usize, scene: &TileScene<'_>) -> Range<usize> {
    let first = scene.chunks.partition_point(|chunk| chunk.call < call);
    first..scene.chunks.partition_point(|chunk| chunk.call <= call)
}

/// Whether a primitive of a draw call may touch the tile.
fn touches(call: usize, tile: usize, scene: &TileScene<'_>) -> bool {
    scene.chunks[chunks_of(call, scene)].iter().any(|chunk| !chunk.in_tile(tile).is_empty())
}

/// Pixels of which at least one sample sees something.
fn covered(tile: &Tile, samples: usize) -> u64 {
    let (first, others) = tile.visible.split_at(TILE_PIXELS);
    let mut seen: Vec<u32> = first.to_vec();
    for sample in others.chunks_exact(TILE_PIXELS).take(samples) {
        for (seen, &handle) in seen.iter_mut().zip(sample) {
            *seen |= handle;
        }
    }
    seen.iter().map(|&seen| u64::from(seen != 0)).sum()
}

/// What each sample of a pixel sees.
fn samples_of<'a>(tile: &'a Tile, scene: &TileScene<'_>, pixel: usize) -> impl Iterator<Item = Handle> + 'a {
    (0..scene.viewport.samples).map(move |sample| tile.visible[sample * TILE_PIXELS + pixel])
}

/// Lists the pixels in which a primitive of draw call `call` is seen, each primitive once a pixel.
fn collect_fragments(tile: &Tile, call: usize, scene: &TileScene<'_>, list: &mut FragmentList) {
    list.clear();
    let chunks = chunks_of(call, scene);
    let handles = handle(chunks.start, 0)..handle(chunks.end, 0);
    if scene.viewport.samples == 1 {
        list.list_visible(&tile.visible, &handles);
    } else {
        for pixel in 0..TILE_PIXELS {
            list.add_pixel(pixel, samples_of(tile, scene, pixel).filter(|seen| handles.contains(seen)));
        }
    }
    list.finish();
}

/// Runs the fragment program of a call over its fragments.
fn shade_fragments(tile: &Tile, call: usize, scene: &TileScene<'_>, list: &mut FragmentList) {
    #[expect(clippy::cast_precision_loss, reason = "pictures are at most 16384 pixels wide")]
    let origin = [tile.left as f32 + 0.5, scene.viewport.height as f32 - (tile.top as f32 + 0.5)];
    let input = ShadeInput { origin, chunks: scene.chunks, vertices: &scene.buffers[call] };
    (scene.calls[call].fragment_stage)(&input, list);
}

/// Stores colours, or adds them to the pixels' sums by their share of the samples.
struct WriteColors<'a> {
    tile: &'a mut Tile,
    list: &'a FragmentList,
    samples: usize,
    sums: &'a mut [[f64; 3]],
}

impl Work for WriteColors<'_> {
    #[inline(always)]
    fn run(self) {
        let Self { tile, list, samples, sums } = self;
        let [red, green, blue] = &list.colors;
        let colors = red.iter().zip(green).zip(blue);
        for (i, (&pixel, ((&r, &g), &b))) in list.pixels[..list.len].iter().zip(colors).enumerate() {
            let pixel = usize::from(pixel);
            if samples == 1 {
                tile.color[pixel] = store([r, g, b]);
            } else {
                add(&mut sums[pixel], [r, g, b], f64::from(list.weights[i]) / samples as f64);
            }
        }
    }
}

/// Adds the background's share to the pixels' sums.
fn add_background(tile: &Tile, scene: &TileScene<'_>, sums: &mut [[f64; 3]]) {
    let background = scene.background.map(clamp);
    for (pixel, sum) in sums.iter_mut().enumerate() {
        let free = samples_of(tile, scene, pixel).filter(|&handle| handle == 0).count();
        #[expect(clippy::cast_precision_loss, reason = "at most 16 samples")]
        add(sum, background, free as f64 / scene.viewport.samples as f64);
    }
}

/// Adds a share of a colour. In f64 the shares, of sixteenths, and their sums are exact, so that the
/// mean of equal colours is that colour.
fn add(sum: &mut [f64; 3], color: [f32; 3], share: f64) {
    for (sum, color) in sum.iter_mut().zip(color) {
        *sum += f64::from(color) * share;
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
    // A cloth of more than 2.7 million points has more springs than 24 bits count.
    object << 24 | (source.unwrap_or(0) + 1).min(0xFF_FFFF)
}

/// A colour channel in 0..=1; NaN is 0.
fn clamp(c: f32) -> f32 {
    if c > 0.0 { c.min(1.0) } else { 0.0 }
}

/// 8 bits of each channel in 0..=1, and alpha 1.
#[inline(always)]
fn store([r, g, b]: [f32; 3]) -> [u8; 4] {
    [quantize(r), quantize(g), quantize(b), 255]
}

/// round-half-even(255·c) for c in 0..=1.
#[inline(always)]
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 <= c <= 1")]
fn quantize(c: f32) -> u8 {
    (c * 255.0).round_ties_even() as u8
}
