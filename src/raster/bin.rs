//! Primitive assembly and binning: clips and sets up primitives in chunks of fixed size, each on
//! one thread, and lists for every tile the primitives that may touch it, in submission order.

use super::{
    clip::{ClipVertex, clip_polygon, clip_segment, outside},
    framebuffer::TILE,
    setup::{Bounds, Dropped, Line, Triangle, Viewport},
    vertex::VertexBuffer,
};

/// Primitives of a mesh per chunk. Fixed, so that the work is cut alike for any number of threads.
pub(super) const CHUNK: usize = 2048;

/// Primitives that a chunk can hold after clipping: a triangle becomes at most 7.
const CHUNK_BITS: u32 = 14;

/// Largest coordinate in clip space. With larger ones, clipping in f64 loses the digits that place
/// what is left in the window.
const CLIP_LIMIT: f32 = 4_294_967_296.0;

/// The place of a primitive among all chunks, plus one: 0 is nothing.
pub(super) type Handle = u32;

/// A chunk of a draw call's primitives, ready for the tiles.
#[derive(Debug, Default)]
pub(super) struct Chunk {
    /// Index of the draw call.
    pub(super) call: usize,
    pub(super) triangles: Vec<Triangle>,
    pub(super) lines: Vec<Line>,
    /// Varyings of the vertices that clipping made.
    clipped_varyings: Vec<f32>,
    bounds: Vec<Bounds>,
    offsets: Vec<u32>,
    entries: Vec<u32>,
    pub(super) counts: Counts,
}

/// What became of a chunk's primitives.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Counts {
    pub(super) outside: u64,
    pub(super) clipped: u64,
    pub(super) non_finite: u64,
    pub(super) degenerate: u64,
    pub(super) no_sample: u64,
    pub(super) drawn: u64,
}

/// The handle of primitive `index` of chunk `chunk`.
#[expect(
    clippy::cast_possible_truncation,
    reason = "2^18 chunks of 2048 are more than an index buffer holds"
)]
pub(super) fn handle(chunk: usize, index: u32) -> Handle {
    ((chunk as u32) << CHUNK_BITS) + index + 1
}

/// The chunk and index of a handle other than 0.
pub(super) fn place(handle: Handle) -> (usize, usize) {
    let place = handle - 1;
    ((place >> CHUNK_BITS) as usize, (place & ((1 << CHUNK_BITS) - 1)) as usize)
}

impl Chunk {
    /// The triangles `first..` of a mesh.
    pub(super) fn of_triangles(
        (call, first): (usize, usize),
        triangles: &[[u32; 3]],
        vertices: &VertexBuffer,
        viewport: &Viewport,
    ) -> Self {
        let mut chunk = Self { call, ..Self::default() };
        for (i, &corners) in triangles.iter().enumerate() {
            chunk.add_triangle(corners, number(first + i), vertices, viewport);
        }
        chunk
    }

    /// The lines `first..` of a mesh.
    pub(super) fn of_lines(
        (call, first): (usize, usize),
        lines: &[[u32; 2]],
        vertices: &VertexBuffer,
        viewport: &Viewport,
    ) -> Self {
        let mut chunk = Self { call, ..Self::default() };
        for (i, &ends) in lines.iter().enumerate() {
            chunk.add_line(ends, number(first + i), vertices, viewport);
        }
        chunk
    }

    fn add_triangle(&mut self, corners: [u32; 3], source: u32, vertices: &VertexBuffer, viewport: &Viewport) {
        let positions = corners.map(|corner| vertices.positions[corner as usize]);
        let codes = positions.map(outside);
        if !in_range(&positions) {
            self.counts.non_finite += 1;
        } else if codes[0] & codes[1] & codes[2] != 0 {
            self.counts.outside += 1;
        } else if codes == [0; 3] {
            self.set_up_triangle(positions, corners, source, viewport);
        } else {
            self.clip_triangle(corners, codes[0] | codes[1] | codes[2], source, vertices, viewport);
        }
    }

    /// Clips a triangle and sets up the fan that is left.
    fn clip_triangle(
        &mut self,
        corners: [u32; 3],
        planes: u8,
        source: u32,
        vertices: &VertexBuffer,
        viewport: &Viewport,
    ) {
        let mut polygon: Vec<ClipVertex> =
            (0..3).map(|i| unclipped(vertices.positions[corners[i] as usize], i)).collect();
        clip_polygon(&mut polygon, planes);
        if polygon.len() < 3 {
            self.counts.outside += 1;
            return;
        }
        let made: Vec<_> =
            polygon.iter().map(|v| (round(v.position), self.add_vertex(v, corners, vertices))).collect();
        let [first, rest @ ..] = &made[..] else { return };
        self.counts.clipped += 1;
        for pair in rest.windows(2) {
            let fan = [*first, pair[0], pair[1]];
            self.set_up_triangle(fan.map(|v| v.0), fan.map(|v| v.1), source, viewport);
        }
    }

    /// The number of a clipped polygon's vertex: a corner keeps its own, others are new.
    fn add_vertex(&mut self, vertex: &ClipVertex, corners: [u32; 3], vertices: &VertexBuffer) -> u32 {
        if let Some(corner) = (0..3).find(|&i| vertex.weights[i] == 1.0) {
            return corners[corner];
        }
        let stride = vertices.stride;
        let index = vertices.positions.len() + self.clipped_varyings.len().checked_div(stride).unwrap_or(0);
        for k in 0..stride {
            let at = |i: usize| f64::from(vertices.varyings[corners[i] as usize * stride + k]);
            let [w0, w1, w2] = vertex.weights;
            #[expect(clippy::cast_possible_truncation, reason = "varyings are f32")]
            self.clipped_varyings.push((w0 * at(0) + w1 * at(1) + w2 * at(2)) as f32);
        }
        number(index)
    }

    fn set_up_triangle(
        &mut self,
        positions: [[f32; 4]; 3],
        vertices: [u32; 3],
        source: u32,
        viewport: &Viewport,
    ) {
        match viewport.triangle(positions, vertices, source) {
            Ok((triangle, bounds)) => {
                self.triangles.push(triangle);
                self.bounds.push(bounds);
                self.counts.drawn += 1;
            }
            Err(dropped) => self.drop(dropped),
        }
    }

    fn add_line(&mut self, ends: [u32; 2], source: u32, vertices: &VertexBuffer, viewport: &Viewport) {
        let positions = ends.map(|end| vertices.positions[end as usize]);
        let codes = positions.map(outside);
        let mut clipped = positions;
        if !in_range(&positions) {
            return self.drop(Dropped::NonFinite);
        }
        if codes != [0; 2] {
            let ends = [unclipped(positions[0], 0), unclipped(positions[1], 1)];
            let Some(ends) = clip_segment(ends, codes[0] | codes[1]) else {
                self.counts.outside += 1;
                return;
            };
            self.counts.clipped += 1;
            clipped = ends.map(|end| round(end.position));
        }
        match viewport.line(clipped, source) {
            Ok((line, bounds)) => {
                self.lines.push(line);
                self.bounds.push(bounds);
                self.counts.drawn += 1;
            }
            Err(dropped) => self.drop(dropped),
        }
    }

    fn drop(&mut self, dropped: Dropped) {
        match dropped {
            Dropped::NonFinite => self.counts.non_finite += 1,
            Dropped::Degenerate => self.counts.degenerate += 1,
            Dropped::NoSample => self.counts.no_sample += 1,
        }
    }

    /// Sorts the primitives into the tiles that their bounds touch, keeping their order.
    pub(super) fn sort_into_tiles(&mut self, columns: usize, tiles: usize) {
        let touched = |b: &Bounds| {
            let (x, y) = (b.x.map(|x| x / TILE), b.y.map(|y| y / TILE));
            (y[0]..=y[1]).flat_map(move |row| (x[0]..=x[1]).map(move |column| row * columns + column))
        };
        self.offsets = vec![0; tiles + 1];
        for tile in self.bounds.iter().flat_map(touched) {
            self.offsets[tile + 1] += 1;
        }
        for tile in 0..tiles {
            self.offsets[tile + 1] += self.offsets[tile];
        }
        let mut next = self.offsets.clone();
        self.entries = vec![0; self.offsets[tiles] as usize];
        for (i, bounds) in self.bounds.iter().enumerate() {
            for tile in touched(bounds) {
                self.entries[next[tile] as usize] = number(i);
                next[tile] += 1;
            }
        }
    }

    /// The primitives that may touch a tile, in submission order.
    pub(super) fn in_tile(&self, tile: usize) -> &[u32] {
        &self.entries[self.offsets[tile] as usize..self.offsets[tile + 1] as usize]
    }

    /// The bounds of primitive `index`.
    pub(super) fn bounds(&self, index: u32) -> Bounds {
        self.bounds[index as usize]
    }

    /// The varyings of a vertex: the mesh's own come first, then those that clipping made.
    #[inline(always)]
    pub(super) fn varyings_of<'a, const N: usize>(
        &'a self,
        vertex: u32,
        vertices: &'a VertexBuffer,
    ) -> &'a [f32; N] {
        let (vertex, own) = (vertex as usize, vertices.positions.len());
        let (buffer, index) =
            if vertex < own { (&vertices.varyings, vertex) } else { (&self.clipped_varyings, vertex - own) };
        buffer[index * N..].first_chunk().unwrap_or(&[0.0; N])
    }
}

/// Corner `i` of a primitive, before clipping.
fn unclipped(position: [f32; 4], i: usize) -> ClipVertex {
    let mut weights = [0.0; 3];
    weights[i] = 1.0;
    ClipVertex { position: position.map(f64::from), weights }
}

/// Whether no coordinate is NaN, infinite or far too large.
fn in_range(positions: &[[f32; 4]]) -> bool {
    positions.as_flattened().iter().all(|c| c.abs() <= CLIP_LIMIT)
}

#[expect(clippy::cast_possible_truncation, reason = "clip space is f32")]
fn round(position: [f64; 4]) -> [f32; 4] {
    position.map(|c| c as f32)
}

/// Numbers of vertices and primitives fit in the index buffer's u32.
#[expect(clippy::cast_possible_truncation, reason = "as the line above says")]
fn number(i: usize) -> u32 {
    i as u32
}
