//! One tile from clear to stored colour: visibility of all primitives, then shading of what is seen.
//!
//! A primitive is shaded once per pixel, however many samples it has there: at the pixel's centre if it covers all
//! samples, else at the first that it covers, so that varyings are never taken from beyond its edge (OpenGL's
//! `centroid`).

use std::{
    mem::{swap, take},
    ops::Range,
};

use fearless_simd::Simd;

use super::{
    assemble::Chunk,
    draw_call::DrawCall,
    fragments::FragmentList,
    framebuffer::Tile,
    handle::{Handle, pack, unpack},
    line::draw_line,
    plane::ShadeInput,
    resolve,
    scratch::Scratch,
    setup::Viewport,
    stats::TileStats,
    tiling::{TILE, TILE_PIXELS},
    timing::Clock,
    triangle::{TileBounds, covering, draw_triangle, first_covered, touches},
    vertex::VertexBuffer,
};
use crate::lanes::{
    FragmentLanes,
    level::{dispatch, dispatch_plain},
};

/// What a tile needs to know to be drawn.
pub(super) struct TileScene<'a> {
    pub(super) calls: &'a [DrawCall<'a>],
    pub(super) buffers: &'a [VertexBuffer],
    pub(super) chunks: &'a [Chunk],
    pub(super) viewport: Viewport,
    pub(super) background: [f32; 3],
    pub(super) ids: bool,
}

/// Primitives in a tile up to which it is asked whether one of them is alone.
const MAX_ALONE: usize = 4;

/// Draws one tile. What is in `scratch` does not matter.
pub(super) fn draw_tile(
    tile: &mut Tile,
    scene: &TileScene<'_>,
    scratch: &mut Scratch,
    clock: &impl Clock,
) -> TileStats {
    let started = clock.now();
    let at = tile.position();
    tile.plane = None;
    let touching = (0..scene.chunks.len()).filter(|&chunk| !scene.chunks[chunk].bins.in_tile(at).is_empty());
    let chunks: Vec<usize> = touching.collect();
    let background = resolve::background(scene.background);
    tile.ids.clear();
    if chunks.is_empty() {
        tile.clear(background);
        tile.ids.resize(if scene.ids { TILE_PIXELS } else { 0 }, 0);
        return TileStats { raster: clock.now() - started, ..TileStats::default() };
    }

    if let Some(stats) = draw_whole(tile, &chunks, scene, &mut scratch.list, clock) {
        return stats;
    }

    // Visibility buffer: the nearest primitive of every sample.
    tile.visible = take(&mut scratch.visible);
    dispatch!(simd => find_visible(simd, tile, &chunks, scene, background));
    let seen = clock.now();

    // Shading: the fragment program of every primitive that is seen, and resolve.
    let (fragments, covered) = shade_tile(tile, &chunks, scene, scratch);
    if scene.ids {
        tile.ids.extend(tile.visible[..TILE_PIXELS].iter().map(|&handle| id(handle, scene)));
    }
    scratch.visible = take(&mut tile.visible);
    TileStats { fragments, covered, raster: seen - started, shading: clock.now() - seen }
}

/// Draws a tile that a triangle covers alone: there is nothing to find out.
fn draw_whole(
    tile: &mut Tile,
    chunks: &[usize],
    scene: &TileScene<'_>,
    list: &mut FragmentList,
    clock: &impl Clock,
) -> Option<TileStats> {
    let started = clock.now();
    let at = tile.position();
    let count: usize = chunks.iter().map(|&chunk| scene.chunks[chunk].bins.in_tile(at).len()).sum();
    if count > MAX_ALONE {
        return None;
    }
    // What is binned here may only have its box in the tile.
    let all = chunks
        .iter()
        .flat_map(|&chunk| scene.chunks[chunk].bins.in_tile(at).iter().map(move |&p| (chunk, p)));
    let mut touching = all.filter(|&(number, primitive)| {
        let chunk = &scene.chunks[number];
        let Some(triangle) = chunk.triangles.get(primitive as usize) else { return true };
        touches(&chunk.corners(triangle, &scene.buffers[chunk.call]), tile, &scene.viewport)
    });
    let (number, primitive) = touching.next()?;
    if touching.next().is_some() {
        return None;
    }
    let chunk = &scene.chunks[number];
    let triangle = chunk.triangles.get(primitive as usize)?;
    let corners = chunk.corners(triangle, &scene.buffers[chunk.call]);
    if !TileBounds::of(triangle.bounds, tile).is_whole() {
        return None;
    }
    tile.plane = Some(covering(&corners, triangle.scale, tile, &scene.viewport)?);
    tile.cleared = None;
    let (handle, filled) = (pack(number, primitive), clock.now());
    list.set_whole(handle);
    // Colours are put where they stay.
    swap(&mut tile.color, &mut list.packed);
    shade_fragments(tile, chunk.call, scene, list);
    swap(&mut tile.color, &mut list.packed);
    if scene.ids {
        tile.ids.resize(TILE_PIXELS, id(handle, scene));
    }
    let pixels = TILE_PIXELS as u64;
    let (raster, shading) = (filled - started, clock.now() - filled);
    Some(TileStats { fragments: pixels, covered: pixels, raster, shading })
}

/// Depth and visibility of every primitive that touches the tile, in submission order, and the background where it is
/// seen.
#[inline(always)]
fn find_visible<S: FragmentLanes>(
    simd: S,
    tile: &mut Tile,
    chunks: &[usize],
    scene: &TileScene<'_>,
    background: u32,
) {
    tile.begin();
    let viewport = &scene.viewport;
    for &number in chunks {
        let chunk = &scene.chunks[number];
        let vertices = &scene.buffers[chunk.call];
        for &primitive in chunk.bins.in_tile(tile.position()) {
            let handle = pack(number, primitive);
            if let Some(triangle) = chunk.triangles.get(primitive as usize) {
                let bounds = TileBounds::of(triangle.bounds, tile);
                let corners = chunk.corners(triangle, vertices);
                draw_triangle(simd, tile, &corners, triangle.scale, bounds, handle, viewport);
            } else if let Some(line) = chunk.lines.get(primitive as usize) {
                let bounds = TileBounds::of(line.bounds, tile);
                draw_line(tile, line, bounds, handle, viewport);
            }
        }
    }
    // Not `contains`, which looks at one after the other.
    if tile.visible.iter().fold(false, |any, &handle| any | (handle == 0)) {
        tile.color.fill(background);
    }
}

/// Colours what is seen of the chunks that touch the tile; how many fragments and pixels that was.
fn shade_tile(
    tile: &mut Tile,
    chunks: &[usize],
    scene: &TileScene<'_>,
    Scratch { list, shared, pixels, .. }: &mut Scratch,
) -> (u64, u64) {
    let samples = scene.viewport.samples;
    if samples > 1 {
        dispatch_plain!(pixels.set(&tile.visible, scene.background));
    }
    let (mut alone, mut together) = (0, 0);
    for of_call in chunks.chunk_by(|&a, &b| scene.chunks[a].call == scene.chunks[b].call) {
        let (Some(&first), Some(&last)) = (of_call.first(), of_call.last()) else { continue };
        let (call, handles) = (scene.chunks[first].call, pack(first, 0)..pack(last + 1, 0));
        list.clear(1);
        let visible = if samples == 1 { &tile.visible } else { &pixels.agreed };
        dispatch_plain!(list.list_visible(visible, &handles));
        list.finish();
        shade_fragments(tile, call, scene, list);
        dispatch_plain!(resolve::write_colors(&mut tile.color, list));
        alone += list.len as u64;
        if samples > 1 {
            shared.clear(samples);
            dispatch!(simd => list_mixed(simd, tile, &pixels.mixed, &handles, scene, shared));
            shared.finish();
            shade_fragments(tile, call, scene, shared);
            pixels.accumulate(shared, samples);
            together += shared.len as u64;
        }
    }
    if samples == 1 {
        return (alone, alone);
    }
    pixels.resolve(&mut tile.color);
    (alone + together, alone + pixels.mixed.len() as u64)
}

/// Adds what is seen in pixels whose samples differ to a list, each primitive once a pixel.
#[inline(always)]
fn list_mixed<S: Simd>(
    simd: S,
    tile: &Tile,
    pixels: &[u16],
    handles: &Range<Handle>,
    scene: &TileScene<'_>,
    list: &mut FragmentList,
) {
    for &pixel in pixels {
        list.add_pixel(
            pixel,
            &tile.visible,
            handles,
            #[inline(always)]
            |primitive| place(simd, tile, pixel.into(), primitive, scene),
        );
    }
}

/// Where in a pixel a primitive is shaded, as the list counts places.
#[inline(always)]
fn place<S: Simd>(simd: S, tile: &Tile, pixel: usize, primitive: Handle, scene: &TileScene<'_>) -> u8 {
    let (chunk, index) = unpack(primitive);
    let chunk = &scene.chunks[chunk];
    let Some(triangle) = chunk.triangles.get(index) else { return 0 };
    let corners = chunk.corners(triangle, &scene.buffers[chunk.call]);
    let pixel = [tile.left + pixel % TILE, tile.top + pixel / TILE];
    let first = first_covered(simd, &corners, pixel, scene.viewport.samples);
    #[expect(clippy::cast_possible_truncation, reason = "at most 16 samples")]
    first.map_or(0, |first| first as u8 + 1)
}

/// Runs the fragment program of a call over its fragments.
fn shade_fragments(tile: &Tile, call: usize, scene: &TileScene<'_>, list: &mut FragmentList) {
    #[expect(clippy::cast_precision_loss, reason = "pictures are at most 16384 pixels wide")]
    let origin = [tile.left as f32 + 0.5, scene.viewport.height as f32 - (tile.top as f32 + 0.5)];
    let (samples, chunks) = (scene.viewport.samples, scene.chunks);
    let input = ShadeInput { origin, samples, chunks, vertices: &scene.buffers[call] };
    scene.calls[call].shade(&input, list);
}

/// Object and primitive of what a pixel sees, as `draw` defines them; 0 for the background.
fn id(handle: Handle, scene: &TileScene<'_>) -> u32 {
    if handle == 0 {
        return 0;
    }
    let (chunk, index) = unpack(handle);
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
