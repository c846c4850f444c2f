//! Primitive assembly: clips and sets up primitives in chunks of fixed size, each on one thread.

use super::{
    between::Between,
    bin::Bins,
    clip::{ClipVertex, FAR, clip_polygon, clip_segment},
    handle::{number, per_chunk},
    primitives::Primitives,
    setup::{Corner, Dropped, Line, Triangle, Viewport},
    vertex::VertexBuffer,
};
use crate::share::share_out;

/// A chunk of a draw call's primitives, ready for the tiles.
#[derive(Clone, Debug, Default)]
pub(super) struct Chunk {
    /// Index of the draw call.
    pub(super) call: usize,
    pub(super) between: Between,
    pub(super) triangles: Vec<Triangle>,
    pub(super) lines: Vec<Line>,
    /// The vertices that clipping and set-up made; their numbers follow those of the mesh.
    made: Vec<Corner>,
    made_varyings: Vec<f32>,
    pub(super) bins: Bins,
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

/// Clips, sets up and bins the primitives of all calls, chunk by chunk.
pub(super) fn assemble(
    calls: &[Primitives<'_>],
    buffers: &[VertexBuffer],
    viewport: &Viewport,
    chunks: &mut Vec<Chunk>,
) {
    let firsts = |(call, primitives): (usize, &Primitives<'_>)| {
        (0..primitives.len()).step_by(per_chunk(primitives.len())).map(move |first| (call, first))
    };
    let starts: Vec<(usize, usize)> = calls.iter().enumerate().flat_map(firsts).collect();
    chunks.resize_with(starts.len(), Chunk::default);
    share_out(chunks.iter_mut().zip(starts), |(chunk, (call, first))| {
        let last = calls[call].len().min(first + per_chunk(calls[call].len()));
        match calls[call] {
            Primitives::Triangles(all) => {
                // Where there are fewer triangles than that, most of them cover a sample.
                chunk.between.fine = all.len() > viewport.width * viewport.height / 2;
                chunk.set_triangles((call, first), &all[first..last], &buffers[call], viewport);
            }
            Primitives::Lines(all) => {
                chunk.set_lines((call, first), &all[first..last], &buffers[call], viewport);
            }
        }
    });
}

impl Chunk {
    /// Empties the chunk, and keeps its memory.
    fn clear(&mut self, call: usize) {
        self.call = call;
        self.triangles.clear();
        self.lines.clear();
        self.made.clear();
        self.made_varyings.clear();
        self.counts = Counts::default();
    }

    /// Takes the triangles `first..` of a mesh, and nothing else.
    pub(super) fn set_triangles(
        &mut self,
        (call, first): (usize, usize),
        triangles: &[[u32; 3]],
        vertices: &VertexBuffer,
        viewport: &Viewport,
    ) {
        self.clear(call);
        self.counts.no_sample += self.between.find(triangles, vertices, viewport);
        for (i, &corners) in triangles.iter().enumerate() {
            if !self.between.holds(i) {
                self.add_triangle(corners, number(first + i), vertices, viewport);
            }
        }
        self.bins.set(self.triangles.iter().map(|triangle| triangle.bounds));
    }

    /// Takes the lines `first..` of a mesh, and nothing else.
    pub(super) fn set_lines(
        &mut self,
        (call, first): (usize, usize),
        lines: &[[u32; 2]],
        vertices: &VertexBuffer,
        viewport: &Viewport,
    ) {
        self.clear(call);
        for (i, &ends) in lines.iter().enumerate() {
            self.add_line(ends, number(first + i), vertices, viewport);
        }
        self.bins.set(self.lines.iter().map(|line| line.bounds));
    }

    fn add_triangle(&mut self, corners: [u32; 3], source: u32, vertices: &VertexBuffer, viewport: &Viewport) {
        let outside = |corner: u32| vertices.outside[corner as usize];
        let (a, b, c) = (outside(corners[0]), outside(corners[1]), outside(corners[2]));
        if (a | b | c) & FAR != 0 {
            self.counts.non_finite += 1;
        } else if a & b & c != 0 {
            self.counts.outside += 1;
        } else if a | b | c == 0 {
            self.set_up_triangle(corners, source, vertices, viewport);
        } else {
            self.clip_triangle(corners, a | b | c, source, vertices, viewport);
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
        let made: Vec<u32> =
            polygon.iter().map(|v| self.add_vertex(v, corners, vertices, viewport)).collect();
        let [first, rest @ ..] = &made[..] else { return };
        self.counts.clipped += 1;
        for pair in rest.windows(2) {
            self.set_up_triangle([*first, pair[0], pair[1]], source, vertices, viewport);
        }
    }

    /// The number of a clipped polygon's vertex: a corner keeps its own, others are new.
    fn add_vertex(
        &mut self,
        vertex: &ClipVertex,
        corners: [u32; 3],
        vertices: &VertexBuffer,
        viewport: &Viewport,
    ) -> u32 {
        if let Some(corner) = (0..3).find(|&i| vertex.weights[i] == 1.0) {
            return corners[corner];
        }
        let stride = vertices.stride;
        for k in 0..stride {
            let at = |i: usize| f64::from(vertices.varyings[corners[i] as usize * stride + k]);
            let [w0, w1, w2] = vertex.weights;
            #[expect(clippy::cast_possible_truncation, reason = "varyings are f32")]
            self.made_varyings.push((w0 * at(0) + w1 * at(1) + w2 * at(2)) as f32);
        }
        self.make(viewport.corner(round(vertex.position)), vertices)
    }

    /// The number of a new vertex, whose varyings were just added.
    fn make(&mut self, corner: Corner, vertices: &VertexBuffer) -> u32 {
        self.made.push(corner);
        number(vertices.positions.len() + self.made.len() - 1)
    }

    fn set_up_triangle(
        &mut self,
        vertices: [u32; 3],
        source: u32,
        buffer: &VertexBuffer,
        viewport: &Viewport,
    ) {
        let [a, b, c] = vertices;
        let corners = [self.corner(a, buffer), self.corner(b, buffer), self.corner(c, buffer)];
        match viewport.triangle(corners, vertices, source) {
            Ok(triangle) if triangle.scale.is_finite() => {
                self.triangles.push(triangle);
                self.counts.drawn += 1;
            }
            Ok(triangle) => {
                // The planes of depth and attributes need an area; the snapped corners have one.
                let vertices = triangle.vertices.map(|vertex| self.add_on_grid(vertex, buffer, viewport));
                self.set_up_triangle(vertices, source, buffer, viewport);
            }
            Err(dropped) => self.drop(dropped),
        }
    }

    /// The number of a new vertex: `vertex` moved onto the snapping grid.
    fn add_on_grid(&mut self, vertex: u32, buffer: &VertexBuffer, viewport: &Viewport) -> u32 {
        let (varyings, first) = self.varyings_at(vertex, buffer, buffer.stride);
        let copy = varyings[first..first + buffer.stride].to_vec();
        self.made_varyings.extend(copy);
        self.make(viewport.on_grid(self.corner(vertex, buffer)), buffer)
    }

    fn add_line(&mut self, ends: [u32; 2], source: u32, vertices: &VertexBuffer, viewport: &Viewport) {
        let planes = ends.iter().fold(0, |planes, &end| planes | vertices.outside[end as usize]);
        let mut corners = ends.map(|end| vertices.corners[end as usize]);
        if planes & FAR != 0 {
            return self.drop(Dropped::NonFinite);
        }
        if planes != 0 {
            let positions = ends.map(|end| vertices.positions[end as usize]);
            let ends = [unclipped(positions[0], 0), unclipped(positions[1], 1)];
            let Some(ends) = clip_segment(ends, planes) else {
                self.counts.outside += 1;
                return;
            };
            self.counts.clipped += 1;
            corners = ends.map(|end| viewport.corner(round(end.position)));
        }
        match viewport.line(corners, source) {
            Ok(line) => {
                self.lines.push(line);
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

    /// A vertex in the window: the mesh's own come first, then those that were made.
    #[inline(always)]
    pub(super) fn corner(&self, vertex: u32, vertices: &VertexBuffer) -> Corner {
        let (vertex, own) = (vertex as usize, vertices.positions.len());
        if vertex < own { vertices.corners[vertex] } else { self.made[vertex - own] }
    }

    /// The corners of a triangle.
    #[inline(always)]
    pub(super) fn corners(&self, triangle: &Triangle, vertices: &VertexBuffer) -> [Corner; 3] {
        let [a, b, c] = triangle.vertices;
        [self.corner(a, vertices), self.corner(b, vertices), self.corner(c, vertices)]
    }

    /// The varyings of a vertex.
    #[inline(always)]
    pub(super) fn varyings_of<'a, const N: usize>(
        &'a self,
        vertex: u32,
        vertices: &'a VertexBuffer,
    ) -> &'a [f32; N] {
        let (varyings, first) = self.varyings_at(vertex, vertices, N);
        varyings[first..].first_chunk().unwrap_or(&[0.0; N])
    }

    /// The array that holds the varyings of a vertex, and where they start.
    #[inline(always)]
    fn varyings_at<'a>(
        &'a self,
        vertex: u32,
        vertices: &'a VertexBuffer,
        stride: usize,
    ) -> (&'a [f32], usize) {
        let (vertex, own) = (vertex as usize, vertices.positions.len());
        if vertex < own {
            (&vertices.varyings, vertex * stride)
        } else {
            (&self.made_varyings, (vertex - own) * stride)
        }
    }
}

/// Corner `i` of a primitive, before clipping.
fn unclipped(position: [f32; 4], i: usize) -> ClipVertex {
    let mut weights = [0.0; 3];
    weights[i] = 1.0;
    ClipVertex { position: position.map(f64::from), weights }
}

#[expect(clippy::cast_possible_truncation, reason = "clip space is f32")]
fn round(position: [f64; 4]) -> [f32; 4] {
    position.map(|c| c as f32)
}
