//! Vertex stage: every vertex of a mesh through the vertex program once.

use rayon::prelude::*;

use crate::{mesh::Attributes, shader::glsl::VertexProgram};

/// What the vertex stage puts out.
#[derive(Clone, Debug)]
pub(super) struct VertexBuffer {
    /// `gl_Position` per vertex: clip space.
    pub(super) positions: Vec<[f32; 4]>,
    /// Varyings, `stride` numbers a vertex.
    pub(super) varyings: Vec<f32>,
    /// Varyings per vertex.
    pub(super) stride: usize,
}

/// Vertices that one thread takes at a time.
const GROUP: usize = 1024;

/// Runs `program` over `count` vertices.
pub(super) fn run<const N: usize>(
    count: usize,
    attributes: impl Fn(usize) -> Attributes + Sync,
    program: &impl VertexProgram<N>,
) -> VertexBuffer {
    let mut positions = vec![[0.0; 4]; count];
    let mut varyings = vec![[0.0; N]; count];
    let groups = positions.par_chunks_mut(GROUP).zip(varyings.par_chunks_mut(GROUP)).enumerate();
    groups.for_each(|(group, (positions, varyings))| {
        for (i, (position, varying)) in positions.iter_mut().zip(varyings).enumerate() {
            (*position, *varying) = program(&attributes(group * GROUP + i));
        }
    });
    VertexBuffer { positions, varyings: varyings.into_flattened(), stride: N }
}
