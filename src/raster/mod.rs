//! The rasteriser: draw calls in, a picture out.
//!
//! Visibility comes first and only what is seen is shaded, so a hidden fragment costs no shading. Tiles
//! and chunks are disjoint pieces of work of fixed size; within a tile primitives keep their submission
//! order: the same bytes for any number of threads.

mod tiling;
mod samples;
mod setup;
mod clip;
mod program;
mod vertex;
mod handle;
mod between;
mod bin;
mod primitives;
mod assemble;
mod depth;
mod fragments;
mod resolve;
mod stats;
mod scratch;
mod framebuffer;
mod edges;
mod triangle;
mod line;
mod plane;
mod interpolate;
mod covering;
mod shade;
mod draw_call;
mod timing;
mod tile;

use std::time::Instant;

use crate::share::share;
use assemble::assemble;
use setup::Viewport;
use stats::TileStats;
use tile::{TileScene, draw_tile};
use timing::{Clock, NoClock, WallClock};
use vertex::VertexBuffer;

pub use draw_call::DrawCall;
pub use framebuffer::Framebuffer;
pub use primitives::Primitives;
pub use program::{FragmentProgram, NoVaryings, Uniform, Varying, Varyings, VertexOutput, VertexProgram};
pub use stats::Stats;
pub use timing::Stages;

/// Clears the framebuffer to `background` and draws `calls` in order.
///
/// With `ids`, also keeps per pixel `object << 24 | (primitive + 1)`, objects numbered from 1; lines
/// after the 16 777 214th share the last number.
pub fn draw(framebuffer: &mut Framebuffer, background: [f32; 3], calls: &[DrawCall<'_>], ids: bool) -> Stats {
    run(framebuffer, background, calls, ids, &NoClock).0
}

/// Does what [`draw`] does, and measures the time of each stage.
pub fn draw_timed(
    framebuffer: &mut Framebuffer,
    background: [f32; 3],
    calls: &[DrawCall<'_>],
    ids: bool,
) -> (Stats, Stages) {
    run(framebuffer, background, calls, ids, &WallClock(Instant::now()))
}

/// The pipeline.
fn run(
    framebuffer: &mut Framebuffer,
    background: [f32; 3],
    calls: &[DrawCall<'_>],
    ids: bool,
    clock: &impl Clock,
) -> (Stats, Stages) {
    let viewport = Viewport::new(framebuffer.width, framebuffer.height, framebuffer.samples);
    let primitives: Vec<Primitives<'_>> = calls.iter().map(|call| call.primitives).collect();
    let Framebuffer { tiles, buffers, chunks, scratch, .. } = framebuffer;
    let started = clock.now();

    // Vertex stage: every vertex through its vertex program once, and into the window.
    buffers.resize_with(calls.len(), VertexBuffer::default);
    for (call, buffer) in calls.iter().zip(&mut *buffers) {
        call.shade_vertices(&viewport, buffer);
    }
    let shaded = clock.now();

    // Primitive assembly: clip, set up, and bin by tile, in chunks.
    assemble(&primitives, buffers, &viewport, chunks);
    let binned = clock.now();

    // Tiles: a visibility buffer from coverage and depth, the fragment stage over what is seen, resolve.
    let scene = TileScene { calls, buffers, chunks, viewport, background, ids };
    scratch.iter_mut().for_each(|scratch| scratch.stats = TileStats::default());
    share(tiles.iter_mut(), scratch, |scratch, tile| {
        let stats = draw_tile(tile, &scene, scratch, clock);
        scratch.stats += stats;
    });
    let tiles: Vec<TileStats> = scratch.iter().map(|scratch| scratch.stats).collect();

    let stages = Stages::between([started, shaded, binned, clock.now()], &tiles);
    (Stats::of(&primitives, buffers, chunks, &tiles), stages)
}
