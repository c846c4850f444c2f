//! One tile from clear to stored colour: visibility of all primitives, then shading of what is
//! seen, then the mean of each pixel's samples.
//!
//! A primitive is shaded once per pixel, at the pixel's centre, however many samples it has there.
//! A pixel's colour is the mean over its samples of the clamped linear colours, rounded half to
//! even to 8 bits.

use std::{hint::black_box, mem::take, ops::Range, time::Instant};

use super::{
    TileCost, TileScene,
    assemble::{Handle, handle, place},
    framebuffer::{TILE, TILE_PIXELS, Tile},
    line::draw_line,
    shade::{FragmentList, ShadeInput, in_blocks, is_block},
    tile::{TileBounds, draw_triangle},
};
use crate::{
    dispatch::{Work, dispatch},
    lanes::WIDTH,
};

/// Memory that a thread uses for one tile after the other.
#[derive(Debug, Default)]
pub(super) struct Scratch {
    visible: Vec<Handle>,
    list: FragmentList,
}

/// Draws one tile. What is in `scratch` does not matter.
pub(super) fn draw_tile(tile: &mut Tile, scene: &TileScene<'_>, scratch: &mut Scratch) -> TileCost {
    let started = Instant::now();
    let at = tile.place();
    let touching = (0..scene.chunks.len()).filter(|&chunk| !scene.chunks[chunk].bins.in_tile(at).is_empty());
    let chunks: Vec<usize> = touching.collect();
    let background = store(scene.background.map(clamp));
    tile.ids.clear();
    if chunks.is_empty() {
        tile.clear(background);
        tile.ids.resize(if scene.ids { TILE_PIXELS } else { 0 }, 0);
        return TileCost { raster: started.elapsed(), ..TileCost::default() };
    }
    tile.begin(take(&mut scratch.visible));
    dispatch(Visibility { tile, chunks: &chunks, scene });
    if tile.visible.contains(&0) {
        tile.color.fill(background);
    }
    let seen = Instant::now();
    let (fragments, covered) = shade_tile(tile, &chunks, scene, &mut scratch.list);
    if scene.ids {
        tile.ids.extend(tile.visible[..TILE_PIXELS].iter().map(|&handle| id(handle, scene)));
    }
    scratch.visible = take(&mut tile.visible);
    TileCost { fragments, covered, raster: seen - started, shading: seen.elapsed() }
}

/// Colours what is seen of the chunks that touch the tile; how many fragments and pixels that was.
fn shade_tile(
    tile: &mut Tile,
    chunks: &[usize],
    scene: &TileScene<'_>,
    list: &mut FragmentList,
) -> (u64, u64) {
    let samples = scene.viewport.samples;
    let mut pixels = Pixels::of(tile, scene);
    let mut fragments = 0;
    for of_call in chunks.chunk_by(|&a, &b| scene.chunks[a].call == scene.chunks[b].call) {
        let (Some(&first), Some(&last)) = (of_call.first(), of_call.last()) else { continue };
        collect_fragments(tile, first..last + 1, &pixels.seen, samples, list);
        shade_fragments(tile, scene.chunks[first].call, scene, list);
        dispatch(WriteColors { tile, list, samples, sums: &mut pixels.sums });
        fragments += list.len as u64;
    }
    (fragments, if samples == 1 { fragments } else { pixels.resolve(tile) })
}

/// The pixels of a tile with several samples; empty if there is one.
struct Pixels {
    /// Handles of all samples together: 0 where only the background is seen.
    seen: Vec<u32>,
    /// Colours times the share of the samples that see them. In f64 the shares, of sixteenths, and their
    /// sums are exact, so that the mean of equal colours is that colour.
    sums: Vec<[f64; 3]>,
}

impl Pixels {
    /// The pixels with the background's share.
    fn of(tile: &Tile, scene: &TileScene<'_>) -> Self {
        let samples = scene.viewport.samples;
        if samples == 1 {
            return Self { seen: Vec::new(), sums: Vec::new() };
        }
        let background = scene.background.map(clamp);
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
    fn resolve(self, tile: &mut Tile) -> u64 {
        let mut covered = 0;
        for ((color, seen), sum) in tile.color.iter_mut().zip(self.seen).zip(self.sums) {
            if seen != 0 {
                #[expect(clippy::cast_possible_truncation, reason = "colours are f32")]
                let mean = sum.map(|channel| channel as f32);
                *color = store(mean);
                covered += 1;
            }
        }
        covered
    }
}

/// Depth and visibility of every primitive that touches the tile, in submission order.
struct Visibility<'a> {
    tile: &'a mut Tile,
    chunks: &'a [usize],
    scene: &'a TileScene<'a>,
}

impl Work for Visibility<'_> {
    #[inline(always)]
    fn run(self) {
        let Self { tile, chunks, scene } = self;
        let viewport = &scene.viewport;
        for &number in chunks {
            let chunk = &scene.chunks[number];
            let vertices = &scene.buffers[chunk.call];
            for &primitive in chunk.bins.in_tile(tile.place()) {
                let handle = handle(number, primitive);
                if let Some(triangle) = chunk.triangles.get(primitive as usize) {
                    let bounds = TileBounds::of(triangle.bounds, tile);
                    let [a, b, c] = triangle.vertices;
                    let corners =
                        [chunk.corner(a, vertices), chunk.corner(b, vertices), chunk.corner(c, vertices)];
                    draw_triangle(tile, &corners, triangle.scale, bounds, handle, viewport);
                } else if let Some(line) = chunk.lines.get(primitive as usize) {
                    let bounds = TileBounds::of(line.bounds, tile);
                    draw_line(tile, line, bounds, handle, viewport);
                }
            }
        }
    }
}

/// The fragments of a tile with one sample.
struct ListVisible<'a> {
    visible: &'a [Handle],
    handles: &'a Range<Handle>,
    list: &'a mut FragmentList,
}

impl Work for ListVisible<'_> {
    #[inline(always)]
    fn run(self) {
        self.list.list_visible(self.visible, self.handles);
    }
}

/// What each sample of a pixel sees.
fn samples_of(tile: &Tile, samples: usize, pixel: usize) -> impl Iterator<Item = Handle> {
    (0..samples).map(move |sample| tile.visible[sample * TILE_PIXELS + pixel])
}

/// Lists the pixels in which a primitive of these chunks is seen, each primitive once a pixel.
fn collect_fragments(
    tile: &Tile,
    chunks: Range<usize>,
    seen: &[u32],
    samples: usize,
    list: &mut FragmentList,
) {
    list.clear(samples);
    let handles = handle(chunks.start, 0)..handle(chunks.end, 0);
    if samples == 1 {
        dispatch(ListVisible { visible: &tile.visible, handles: &handles, list });
    } else {
        for pixel in in_blocks().filter(|&pixel| seen[pixel] != 0) {
            let primitive = tile.visible[pixel];
            if samples_of(tile, samples, pixel).all(|other| other == primitive) {
                if handles.contains(&primitive) {
                    list.add(pixel, primitive, samples);
                }
                continue;
            }
            list.add_pixel(pixel, samples_of(tile, samples, pixel).filter(|seen| handles.contains(seen)));
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
        if samples > 1 {
            for (i, &pixel) in list.pixels[..list.len].iter().enumerate() {
                let share = f64::from(list.weights[i]) / samples as f64;
                add(&mut sums[usize::from(pixel)], [red[i], green[i], blue[i]], share);
            }
            return;
        }
        let colors = red.chunks_exact(WIDTH).zip(green.chunks_exact(WIDTH)).zip(blue.chunks_exact(WIDTH));
        for (pixels, ((red, green), blue)) in list.filled().as_chunks().0.iter().zip(colors) {
            let mut colors = [0; WIDTH];
            for (i, color) in colors.iter_mut().enumerate() {
                *color = store([red[i], green[i], blue[i]]);
            }
            // Through memory, because the compiler then packs them side by side.
            write(&mut tile.color, pixels, &black_box(colors));
        }
    }
}

/// Writes the colours of eight fragments. The last may be one that fills the list up: it is stored once
/// more, with the same colour.
#[inline(always)]
fn write(tile: &mut [u32], pixels: &[u16; WIDTH], colors: &[u32; WIDTH]) {
    if is_block(pixels) {
        let first = usize::from(pixels[0]);
        let (top, bottom) = colors.split_at(WIDTH / 2);
        tile[first..first + WIDTH / 2].copy_from_slice(top);
        tile[first + TILE..first + TILE + WIDTH / 2].copy_from_slice(bottom);
        return;
    }
    for (&pixel, &color) in pixels.iter().zip(colors) {
        tile[usize::from(pixel)] = color;
    }
}

/// Adds a share of a colour.
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

/// 8 bits of each channel in 0..=1, and alpha 1, as a tile keeps them.
#[inline(always)]
fn store([r, g, b]: [f32; 3]) -> u32 {
    quantize(r) | quantize(g) << 8 | quantize(b) << 16 | 255 << 24
}

/// A number to which a number in 0..=255 is added as a whole one: steps at its size are 1.
const WHOLE: f32 = 8_388_608.0;

/// round-half-even(255·c) for c in 0..=1: the addition rounds, and leaves the result in the low bits.
#[inline(always)]
fn quantize(c: f32) -> u32 {
    (c * 255.0 + WHOLE).to_bits() & 0xFF
}
