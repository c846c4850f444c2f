//! Vertex stage: every vertex of a mesh through the vertex program once.

use super::{
    clip,
    program::{Varyings, VertexProgram},
    setup::{Corner, Viewport},
};
use crate::{lanes::level::dispatch_plain, share::share_out};

/// What the vertex stage puts out.
#[derive(Clone, Debug, Default)]
pub(super) struct VertexBuffer {
    /// `gl_Position` per vertex: clip space.
    pub(super) positions: Vec<[f32; 4]>,
    /// Each vertex in the window.
    pub(super) corners: Vec<Corner>,
    /// Of each vertex, the planes of the view volume that it lies outside of (see `clip`).
    pub(super) outside: Vec<u8>,
    /// Varyings, `stride` numbers a vertex.
    pub(super) varyings: Vec<f32>,
    /// Varyings per vertex, or 1 if there are none.
    pub(super) stride: usize,
}

/// Vertices that one thread takes at a time.
const GROUP: usize = 1024;

/// Projects vertices into the window.
#[inline(always)]
fn project(viewport: &Viewport, positions: &[[f32; 4]], corners: &mut [Corner], outside: &mut [u8]) {
    let projected = corners.iter_mut().zip(outside);
    for (&position, (corner, outside)) in positions.iter().zip(projected) {
        *corner = viewport.corner(position);
        *outside = clip::outside(position);
    }
}

impl VertexBuffer {
    /// Runs `program` over `count` vertices and projects them into the window. What the buffer held
    /// does not matter; its memory is used.
    pub(super) fn fill<A, V: Varyings<f32, N>, const N: usize>(
        &mut self,
        count: usize,
        viewport: &Viewport,
        attributes: impl Fn(usize) -> A + Sync,
        program: &impl VertexProgram<A, V>,
    ) {
        let stride = N.max(1);
        self.stride = stride;
        self.positions.resize(count, [0.0; 4]);
        self.corners.resize(count, Corner::default());
        self.outside.resize(count, 0);
        self.varyings.resize(count * stride, 0.0);
        let shaded = self.positions.chunks_mut(GROUP).zip(self.varyings.chunks_mut(GROUP * stride));
        let placed = self.corners.chunks_mut(GROUP).zip(self.outside.chunks_mut(GROUP));
        share_out(shaded.zip(placed).enumerate(), |(group, ((positions, varyings), (corners, outside)))| {
            let vertices = positions.iter_mut().zip(varyings.chunks_exact_mut(stride));
            for (vertex, (position, varyings)) in (group * GROUP..).zip(vertices) {
                let output = program(&attributes(vertex));
                *position = output.0;
                output.1.write(varyings);
            }
            dispatch_plain!(project(viewport, positions, corners, outside));
        });
    }
}
