//! The rasteriser: draw calls in, a picture out.
//!
//! `vertex` → `assemble` (`clip`, `setup`) → `bin` → per tile: `tile` and `line` (what is seen where) →
//! `shade` (what colour it has). Visibility comes first and only what is seen is shaded, so
//! a hidden fragment costs no shading. Tiles and chunks are disjoint pieces of work of fixed size;
//! within a tile primitives keep their submission order: the same bytes for any number of threads.

mod assemble;
mod bin;
mod clip;
mod framebuffer;
mod line;
mod resolve;
#[cfg(test)]
mod same_bits;
mod samples;
mod setup;
mod shade;
mod tile;
mod vertex;

use std::marker::PhantomData;
use std::time::{Duration, Instant};

use rayon::prelude::*;
use serde::Serialize;

use crate::{
    dispatch::dispatch,
    lanes::Lane,
    mesh::Attributes,
    shader::glsl::{FragmentProgram, VertexProgram},
};
use assemble::{CHUNK, Chunk};
use resolve::{Scratch, draw_tile};
use setup::Viewport;
use shade::{FragmentList, Shade, ShadeInput};
use vertex::VertexBuffer;

pub use framebuffer::Framebuffer;

/// What a draw call draws: vertex indices per primitive.
#[derive(Clone, Copy, Debug)]
pub enum Primitives<'a> {
    /// Filled triangles, both sides.
    Triangles(&'a [[u32; 3]]),
    /// Lines one pixel wide, in one colour: their fragment program reads no varyings.
    Lines(&'a [[u32; 2]]),
}

type VertexStage<'a> = Box<dyn Fn(&Viewport, &mut VertexBuffer) + Send + Sync + 'a>;
type FragmentStage<'a> = Box<dyn Fn(&ShadeInput<'_>, &mut FragmentList) + Send + Sync + 'a>;

/// A mesh with its two programs.
///
/// Any closures of the right shape are programs, and a number that the vertex program puts out
/// reaches the fragment program interpolated. A triangle in stripes:
///
/// ```
/// use drape::lanes::{Lane, Wide};
/// use drape::mesh::Attributes;
/// use drape::raster::{DrawCall, Framebuffer, Primitives, draw};
/// use drape::shader::glsl::vec3;
///
/// let corners = [[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [0.0, 1.0, 0.0]];
/// let attributes = |i: usize| Attributes { in_position: corners[i], ..Attributes::default() };
/// let vertex_program = |a: &Attributes| {
///     let [x, y, z] = a.in_position;
///     ([x, y, z, 1.0], [x])
/// };
/// let [four, half, one] = [4.0, 0.5, 1.0].map(Wide::<f32>::splat);
/// let fragment_program = |&[x]: &[Wide<f32>; 1]| {
///     let part = x * four - (x * four).floor();
///     vec3(part, half, one - part)
/// };
/// let triangle = Primitives::Triangles(&[[0, 1, 2]]);
/// let call = DrawCall::new::<Wide<f32>, 1>(triangle, 3, attributes, vertex_program, fragment_program);
/// let mut framebuffer = Framebuffer::new(64, 64, 1);
/// let (stats, _) = draw(&mut framebuffer, [0.0; 3], &[call], false);
/// assert_eq!(stats.covered, 64 * 64 / 2);
/// // Right of the middle x = 1 / 64, which is 1 / 16 of a stripe.
/// assert_eq!(framebuffer.rgb()[3 * (63 * 64 + 32)..][..3], [16, 128, 239]);
/// ```
///
/// Eight fragments are shaded side by side; `L` = `f32` shades one at a time, with the same bits.
pub struct DrawCall<'a> {
    primitives: Primitives<'a>,
    vertex_stage: VertexStage<'a>,
    fragment_stage: FragmentStage<'a>,
}

impl<'a> DrawCall<'a> {
    /// Draws `primitives` over `count` vertices. `N` is the number of varyings, `L` the lanes that
    /// the fragment program is run in.
    pub fn new<L: Lane, const N: usize>(
        primitives: Primitives<'a>,
        count: usize,
        attributes: impl Fn(usize) -> Attributes + Send + Sync + 'a,
        vertex_program: impl VertexProgram<N> + 'a,
        fragment_program: impl FragmentProgram<L, N> + 'a,
    ) -> Self {
        Self {
            primitives,
            vertex_stage: Box::new(move |viewport, buffer| {
                buffer.fill(count, viewport, &attributes, &vertex_program);
            }),
            fragment_stage: Box::new(move |input, list| {
                dispatch(Shade { input, list, program: &fragment_program, varyings: PhantomData::<[L; N]> });
            }),
        }
    }
}

/// What drawing a picture took. Counts are the same for any number of threads.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Stats {
    /// Vertices shaded.
    pub vertices: u64,
    /// Triangles submitted.
    pub triangles: u64,
    /// Lines submitted.
    pub lines: u64,
    /// Primitives outside of the view volume.
    pub outside: u64,
    /// Primitives cut by a plane of the view volume.
    pub clipped: u64,
    /// Primitives dropped for a NaN, infinite or far too large coordinate.
    pub non_finite: u64,
    /// Triangles dropped because their snapped corners span no area.
    pub degenerate: u64,
    /// Primitives dropped because they lie between the samples.
    pub no_sample: u64,
    /// Primitives that reached the tiles (those cut may be several).
    pub drawn: u64,
    /// Runs of a fragment program: pixels × primitives seen in them.
    pub fragments: u64,
    /// Pixels in which a primitive is seen.
    pub covered: u64,
}

/// Wall time per stage of [`draw`]. Rasterising and shading alternate within a tile; their shares of the
/// tiles' wall time are those of their summed processor time.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Stages {
    /// Vertex programs.
    pub vertex: Duration,
    /// Clipping, set-up and binning.
    pub setup: Duration,
    /// Clearing, coverage and depth.
    pub raster: Duration,
    /// Interpolation, fragment programs and resolve.
    pub shading: Duration,
}

/// Clears the framebuffer to `background` and draws `calls` in order.
///
/// With `ids`, also keeps per pixel `object << 24 | (primitive + 1)`, objects numbered from 1; lines
/// after the 16 777 214th share the last number.
pub fn draw(
    framebuffer: &mut Framebuffer,
    background: [f32; 3],
    calls: &[DrawCall<'_>],
    ids: bool,
) -> (Stats, Stages) {
    let started = Instant::now();
    let viewport = Viewport::new(framebuffer.width, framebuffer.height, framebuffer.samples);
    let Framebuffer { tiles, buffers, chunks, .. } = framebuffer;
    buffers.resize_with(calls.len(), VertexBuffer::default);
    for (call, buffer) in calls.iter().zip(&mut *buffers) {
        (call.vertex_stage)(&viewport, buffer);
    }
    let shaded = Instant::now();
    assemble(calls, buffers, &viewport, chunks);
    let binned = Instant::now();

    let scene = TileScene { calls, buffers, chunks, viewport, background, ids };
    let tiles: Vec<TileCost> = tiles
        .par_iter_mut()
        .map_init(Scratch::default, |scratch, tile| draw_tile(tile, &scene, scratch))
        .collect();

    let wall = binned.elapsed();
    let raster: Duration = tiles.iter().map(|tile| tile.raster).sum();
    let shading: Duration = tiles.iter().map(|tile| tile.shading).sum();
    let share = wall.div_duration_f64((raster + shading).max(Duration::from_nanos(1)));
    let stages = Stages {
        vertex: shaded - started,
        setup: binned - shaded,
        raster: raster.mul_f64(share),
        shading: shading.mul_f64(share),
    };
    (count(calls, buffers, chunks, &tiles), stages)
}

/// What a tile needs to know to be drawn.
struct TileScene<'a> {
    calls: &'a [DrawCall<'a>],
    buffers: &'a [VertexBuffer],
    chunks: &'a [Chunk],
    viewport: Viewport,
    background: [f32; 3],
    ids: bool,
}

/// What a tile took.
#[derive(Clone, Copy, Debug, Default)]
struct TileCost {
    fragments: u64,
    covered: u64,
    raster: Duration,
    shading: Duration,
}

/// Clips, sets up and bins the primitives of all calls, chunk by chunk.
fn assemble(calls: &[DrawCall<'_>], buffers: &[VertexBuffer], viewport: &Viewport, chunks: &mut Vec<Chunk>) {
    let pieces: Vec<(usize, usize)> = calls
        .iter()
        .enumerate()
        .flat_map(|(call, c)| (0..c.primitives.len()).step_by(CHUNK).map(move |first| (call, first)))
        .collect();
    chunks.resize_with(pieces.len(), Chunk::default);
    chunks.par_iter_mut().zip(pieces).for_each(|(chunk, (call, first))| {
        let last = calls[call].primitives.len().min(first + CHUNK);
        match calls[call].primitives {
            Primitives::Triangles(all) => {
                chunk.set_triangles((call, first), &all[first..last], &buffers[call], viewport);
            }
            Primitives::Lines(all) => {
                chunk.set_lines((call, first), &all[first..last], &buffers[call], viewport);
            }
        }
    });
}

impl Primitives<'_> {
    fn len(&self) -> usize {
        match self {
            Self::Triangles(all) => all.len(),
            Self::Lines(all) => all.len(),
        }
    }
}

fn count(calls: &[DrawCall<'_>], buffers: &[VertexBuffer], chunks: &[Chunk], tiles: &[TileCost]) -> Stats {
    let mut stats = Stats::default();
    for (call, buffer) in calls.iter().zip(buffers) {
        stats.vertices += buffer.positions.len() as u64;
        match call.primitives {
            Primitives::Triangles(all) => stats.triangles += all.len() as u64,
            Primitives::Lines(all) => stats.lines += all.len() as u64,
        }
    }
    for counts in chunks.iter().map(|chunk| chunk.counts) {
        stats.outside += counts.outside;
        stats.clipped += counts.clipped;
        stats.non_finite += counts.non_finite;
        stats.degenerate += counts.degenerate;
        stats.no_sample += counts.no_sample;
        stats.drawn += counts.drawn;
    }
    stats.fragments = tiles.iter().map(|tile| tile.fragments).sum();
    stats.covered = tiles.iter().map(|tile| tile.covered).sum();
    stats
}
