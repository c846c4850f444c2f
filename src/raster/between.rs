//! Triangles that lie between the samples, found eight at a time: in a fine mesh those are nearly all.

use fearless_simd::{Simd, SimdBase, SimdMask, i32x8};

use super::{setup::Viewport, tiling::SUBPIXELS, vertex::VertexBuffer};
use crate::lanes::level::dispatch;

/// Triangles that are looked at side by side.
const GROUP: usize = 8;

/// Width and height in 1/256 pixel below which an area fits in 32 bits.
const SMALL: i32 = 1 << 14;

/// Which triangles of a chunk lie between the samples.
#[derive(Clone, Debug, Default)]
pub(super) struct Between {
    /// Whether most of them may: else it is not asked.
    pub(super) fine: bool,
    /// What [`between_samples`] finds of each whole group.
    groups: Vec<u8>,
}

impl Between {
    /// Looks at the triangles of a chunk, and says how many it found.
    pub(super) fn find(
        &mut self,
        triangles: &[[u32; 3]],
        vertices: &VertexBuffer,
        viewport: &Viewport,
    ) -> u64 {
        let groups = &mut self.groups;
        groups.resize(if self.fine { triangles.len() / GROUP } else { 0 }, 0);
        dispatch!(simd => find_between(simd, triangles, vertices, viewport, groups));
        groups.iter().map(|found| u64::from(found.count_ones())).sum()
    }

    /// Whether triangle `i` of the chunk was found.
    pub(super) fn holds(&self, i: usize) -> bool {
        self.groups.get(i / GROUP).is_some_and(|found| found >> (i % GROUP) & 1 == 1)
    }
}

/// [`between_samples`] of one group after the other.
#[inline(always)]
fn find_between<S: Simd>(
    simd: S,
    triangles: &[[u32; 3]],
    vertices: &VertexBuffer,
    viewport: &Viewport,
    groups: &mut [u8],
) {
    for (group, found) in triangles.as_chunks().0.iter().zip(groups) {
        *found = between_samples(simd, group, vertices, viewport);
    }
}

/// A bit for each triangle, the first one lowest: set where it lies within the view volume, has an area, and covers no
/// sample. It may be missing where a triangle is large.
#[inline(always)]
#[expect(clippy::cast_possible_truncation, reason = "eight bits")]
fn between_samples<S: Simd>(
    simd: S,
    triangles: &[[u32; 3]; GROUP],
    vertices: &VertexBuffer,
    viewport: &Viewport,
) -> u8 {
    let (mut corners, mut outside) = ([[[0; GROUP]; 3]; 2], [0; GROUP]);
    for (i, triangle) in triangles.iter().enumerate() {
        for (corner, &vertex) in triangle.iter().enumerate() {
            // Where it is not known, the triangle is not small.
            let [x, y] = vertices.corners[vertex as usize].snapped().unwrap_or([-SMALL; 2]);
            (corners[0][corner][i], corners[1][corner][i]) = (x, y);
            outside[i] |= i32::from(vertices.outside[vertex as usize]);
        }
    }
    let ([ab, ac], x) = along_axis(simd, corners[0], viewport.spread[0]);
    let ([down_ab, down_ac], y) = along_axis(simd, corners[1], viewport.spread[1]);
    let area = ab * down_ac - down_ab * ac;
    let within = i32x8::load_array(simd, outside) - 1;
    // Negative where all of it is true.
    let found = (x.between | y.between) & x.small & y.small & (area | -area) & within;
    found.simd_lt(0).to_bitmask() as u8
}

/// What is negative where triangles are small along an axis, and where no sample lies between their first and last
/// position there.
struct Extent<S: Simd> {
    small: i32x8<S>,
    between: i32x8<S>,
}

/// From the first corners to the others along an axis, and how far that extends.
#[inline(always)]
fn along_axis<S: Simd>(
    simd: S,
    corners: [[i32; GROUP]; 3],
    [low, high]: [i32; 2],
) -> ([i32x8<S>; 2], Extent<S>) {
    let [a, b, c] = corners;
    let (a, b, c) = (i32x8::load_array(simd, a), i32x8::load_array(simd, b), i32x8::load_array(simd, c));
    let (first, last) = (a.min(b).min(c), a.max(b).max(c));
    // As `Viewport::bounds` has it.
    let pixels = [
        (first - high + (SUBPIXELS - 1)) >> SUBPIXELS.trailing_zeros(),
        (last - low) >> SUBPIXELS.trailing_zeros(),
    ];
    let extent = Extent { small: last - first - SMALL, between: pixels[1] - pixels[0] };
    ([b - a, c - a], extent)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{lanes::level::Level, math::splitmix64, raster::assemble::Chunk};

    /// Vertices within `7680 / scale` pixels, some of them outside of the view volume, or NaN.
    fn vertices(viewport: &Viewport, scale: f32) -> VertexBuffer {
        let mut vertices = VertexBuffer { stride: 1, ..VertexBuffer::default() };
        for i in 0..512 {
            let bits = splitmix64(i);
            let place = |bits: u64| (bits % 128) as f32 / scale;
            let mut position = [place(bits), place(bits >> 8), 0.0, 1.0];
            match bits >> 16 & 63 {
                0 => position[0] = 1.5,
                1 => position[2] = f32::NAN,
                _ => {}
            }
            vertices.positions.push(position);
            vertices.corners.push(viewport.corner(position));
            vertices.outside.push(crate::raster::clip::outside(position));
            vertices.varyings.push(0.0);
        }
        vertices
    }

    #[test]
    fn what_is_found_side_by_side_is_what_set_up_drops() {
        for (samples, scale) in [(1, 4000.0), (4, 24_000.0)] {
            let viewport = Viewport::new(120, 120, samples);
            let vertices = vertices(&viewport, scale);
            let near = |i: u32, k: u32| (i * 7 + k * (i % 5)) % 512;
            let triangles: Vec<[u32; 3]> = (0..2003).map(|i| [0, 1, 2].map(|k| near(i, k))).collect();
            let mut expected = Chunk::default();
            expected.set_triangles((0, 0), &triangles, &vertices, &viewport);
            assert!(
                expected.counts.no_sample > 100 && expected.counts.degenerate > 0,
                "{:?}",
                expected.counts
            );
            Level::for_each(|level| {
                let mut chunk = Chunk::default();
                chunk.between.fine = true;
                chunk.set_triangles((0, 0), &triangles, &vertices, &viewport);
                assert_eq!(chunk.counts, expected.counts, "{level:?}");
                let sources = |chunk: &Chunk| chunk.triangles.iter().map(|t| t.source).collect::<Vec<_>>();
                assert_eq!(sources(&chunk), sources(&expected));
                let found: u32 = chunk.between.groups.iter().map(|found| found.count_ones()).sum();
                assert!(u64::from(found) > expected.counts.no_sample / 2, "{found}");
            });
        }
    }
}
