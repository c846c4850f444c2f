//! Vertex stage: every vertex of a mesh through the vertex program once.

use rayon::prelude::*;

use super::{
    clip,
    setup::{Corner, Viewport},
};
use crate::{
    dispatch::{Work, dispatch},
    mesh::Attributes,
    shader::glsl::VertexProgram,
};

/// What the vertex stage puts out.
#[derive(Clone, Debug)]
pub(super) struct VertexBuffer {
    /// `gl_Position` per vertex: clip space.
    pub(super) positions: Vec<[f32; 4]>,
    /// Each vertex in the window.
    pub(super) corners: Vec<Corner>,
    /// Of each vertex, the planes of the view volume that it lies outside of (see `clip`).
    pub(super) outside: Vec<u8>,
    /// Varyings, `stride` numbers a vertex.
    pub(super) varyings: Vec<f32>,
    /// Varyings per vertex.
    pub(super) stride: usize,
}

/// Vertices that one thread takes at a time.
const GROUP: usize = 1024;

/// Finds the places of vertices in the window.
struct Place<'a> {
    viewport: &'a Viewport,
    positions: &'a [[f32; 4]],
    corners: &'a mut [Corner],
    outside: &'a mut [u8],
}

impl Work for Place<'_> {
    #[inline(always)]
    fn run(self) {
        let places = self.corners.iter_mut().zip(self.outside);
        for (&position, (corner, outside)) in self.positions.iter().zip(places) {
            *corner = self.viewport.corner(position);
            *outside = clip::outside(position);
        }
    }
}

/// Runs `program` over `count` vertices and finds their places in the window.
pub(super) fn run<const N: usize>(
    count: usize,
    viewport: &Viewport,
    attributes: impl Fn(usize) -> Attributes + Sync,
    program: &impl VertexProgram<N>,
) -> VertexBuffer {
    let mut positions = vec![[0.0; 4]; count];
    let mut corners = vec![Corner::default(); count];
    let mut outside = vec![0; count];
    let mut varyings = vec![[0.0; N]; count];
    let shaded = positions.par_chunks_mut(GROUP).zip(varyings.par_chunks_mut(GROUP));
    let placed = corners.par_chunks_mut(GROUP).zip(outside.par_chunks_mut(GROUP));
    shaded.zip(placed).enumerate().for_each(|(group, ((positions, varyings), (corners, outside)))| {
        for (i, (position, varying)) in positions.iter_mut().zip(varyings).enumerate() {
            (*position, *varying) = program(&attributes(group * GROUP + i));
        }
        dispatch(Place { viewport, positions, corners, outside });
    });
    VertexBuffer { positions, corners, outside, varyings: varyings.into_flattened(), stride: N }
}
