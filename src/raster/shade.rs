//! Fragment stage: interpolates the varyings at the pixel centre and runs the fragment program.
//!
//! Barycentric coordinates l are computed in f64 from the unsnapped window positions, rounded
//! once, and weighted with 1/w: a = Σ lᵢ·rᵢ·aᵢ / Σ lᵢ·rᵢ. Inside the triangle all weights are
//! positive, so nothing cancels: the roundings add up to at most 11·2⁻²⁴·max |aᵢ|, and stay below
//! 6·2⁻²⁴·max |aᵢ| in tests against f64 (4.6 is the largest seen).

use std::{hint::black_box, marker::PhantomData, ops::Range};

use super::{
    assemble::{Chunk, Handle, place},
    framebuffer::{TILE, TILE_PIXELS},
    setup::Triangle,
    vertex::VertexBuffer,
};
use crate::{
    dispatch::Work,
    lanes::{Lane, WIDTH},
    shader::glsl::{FragmentProgram, Vec3},
};

/// A tile's side as the fragment list counts pixels.
#[expect(clippy::cast_possible_truncation, reason = "a tile is 64 pixels wide")]
const TILE_SIDE: u16 = TILE as u16;

/// Pixels of a block of four by two. Small triangles fill blocks better than rows, and the fewer
/// triangles meet in a group of fragments, the less there is to interpolate.
const BLOCK: [u16; WIDTH] = [0, 1, 2, 3, TILE_SIDE, TILE_SIDE + 1, TILE_SIDE + 2, TILE_SIDE + 3];

/// Whether eight pixels are those of a block.
#[inline(always)]
pub(super) fn is_block(pixels: &[u16; WIDTH]) -> bool {
    let differing = |seen, (&pixel, offset): (&u16, u16)| seen | (pixel.wrapping_sub(pixels[0]) ^ offset);
    pixels.iter().zip(BLOCK).fold(0, differing) == 0
}

/// The pixels of a tile, block by block.
pub(super) fn in_blocks() -> impl Iterator<Item = usize> {
    let rows = (0..TILE_PIXELS).step_by(2 * TILE);
    let firsts = rows.flat_map(|row| (row..row + TILE).step_by(4));
    firsts.flat_map(|first| BLOCK.map(|offset| first + usize::from(offset)))
}

/// The fragments of one draw call in one tile. Every pixel and primitive is listed once; the
/// lists are filled up to a multiple of eight by repeating the last fragment.
#[derive(Debug, Default)]
pub(super) struct FragmentList {
    /// How many fragments are meant. The lists have room for more.
    pub(super) len: usize,
    /// Place of the pixel in the tile.
    pub(super) pixels: Vec<u16>,
    /// Samples of the pixel in which the primitive is seen.
    pub(super) weights: Vec<u8>,
    /// The primitives.
    pub(super) primitives: Vec<Handle>,
    /// Colours, one plane a channel, 0..=1: what the fragment stage puts out.
    pub(super) colors: [Vec<f32>; 3],
}

/// What the fragment stage needs besides the list.
pub(super) struct ShadeInput<'a> {
    /// Window position (y up) of the centre of the tile's first pixel.
    pub(super) origin: [f32; 2],
    pub(super) chunks: &'a [Chunk],
    pub(super) vertices: &'a VertexBuffer,
}

impl FragmentList {
    /// Empties the list and makes room for what a tile's samples may see. A list is used again and again,
    /// and what it held is not cleared.
    pub(super) fn clear(&mut self, samples: usize) {
        let room = TILE_PIXELS * samples + WIDTH;
        self.len = 0;
        self.pixels.resize(room, 0);
        self.weights.resize(room, 0);
        self.primitives.resize(room, 0);
        for plane in &mut self.colors {
            plane.resize(room, 0.0);
        }
    }

    /// Lists the pixels of a tile with one sample whose visible primitive is in `handles`, block by block.
    #[inline(always)]
    pub(super) fn list_visible(&mut self, visible: &[Handle], handles: &Range<Handle>) {
        // A block is written as a whole, and what was not meant is overwritten by the next.
        let mut len = 0;
        for first in (0..visible.len()).step_by(2 * TILE).flat_map(|row| (row..row + TILE).step_by(4)) {
            let mut block = [0; WIDTH];
            block[..4].copy_from_slice(&visible[first..first + 4]);
            block[4..].copy_from_slice(&visible[first + TILE..first + TILE + 4]);
            if block.iter().fold(0, |seen, handle| seen | handle) == 0 {
                continue;
            }
            let (Some(pixels), Some(primitives)) = (
                self.pixels[len..].first_chunk_mut::<WIDTH>(),
                self.primitives[len..].first_chunk_mut::<WIDTH>(),
            ) else {
                return;
            };
            if block.iter().fold(true, |all, handle| all & handles.contains(handle)) {
                *pixels = BLOCK.map(|offset| place_in_tile(first) + offset);
                *primitives = block;
                len += WIDTH;
                continue;
            }
            let mut kept = 0;
            for (offset, primitive) in BLOCK.into_iter().zip(block) {
                // Written always and kept only if it is one: no branch to mispredict.
                pixels[kept % WIDTH] = place_in_tile(first) + offset;
                primitives[kept % WIDTH] = primitive;
                kept += usize::from(handles.contains(&primitive));
            }
            len += kept;
        }
        self.len = len;
    }

    /// Adds the primitives that the samples of a pixel see, each once.
    pub(super) fn add_pixel(&mut self, pixel: usize, seen: impl Iterator<Item = Handle>) {
        let first = self.len;
        for primitive in seen {
            let known = &self.primitives[first..self.len];
            if let Some(known) = known.iter().position(|&other| other == primitive) {
                self.weights[first + known] += 1;
            } else {
                self.add(pixel, primitive, 1);
            }
        }
    }

    /// Adds a primitive that `samples` (at most 16) samples of a pixel see.
    #[expect(clippy::cast_possible_truncation, reason = "at most 16")]
    pub(super) fn add(&mut self, pixel: usize, primitive: Handle, samples: usize) {
        self.pixels[self.len] = place_in_tile(pixel);
        self.weights[self.len] = samples as u8;
        self.primitives[self.len] = primitive;
        self.len += 1;
    }

    /// Fills the lists up.
    pub(super) fn finish(&mut self) {
        let Some(last) = self.len.checked_sub(1) else { return };
        let (pixel, primitive) = (self.pixels[last], self.primitives[last]);
        let rest = self.len..self.len.next_multiple_of(WIDTH);
        self.pixels[rest.clone()].fill(pixel);
        self.primitives[rest].fill(primitive);
    }

    /// The pixels, filled up.
    #[inline(always)]
    pub(super) fn filled(&self) -> &[u16] {
        &self.pixels[..self.len.next_multiple_of(WIDTH)]
    }
}

/// The number of a pixel as the list keeps it.
#[expect(clippy::cast_possible_truncation, reason = "a tile has 4096 pixels")]
fn place_in_tile(pixel: usize) -> u16 {
    pixel as u16
}

/// Shades all fragments of a list; colours are clamped to 0..=1, NaN is 0.
pub(super) struct Shade<'a, L, const N: usize, P> {
    pub(super) input: &'a ShadeInput<'a>,
    pub(super) list: &'a mut FragmentList,
    pub(super) program: &'a P,
    pub(super) varyings: PhantomData<[L; N]>,
}

impl<L: Lane, const N: usize, P: FragmentProgram<L, N>> Work for Shade<'_, L, N, P> {
    #[inline(always)]
    fn run(self) {
        let Self { input, list, program, .. } = self;
        let FragmentList { len, pixels, primitives, colors: [red, green, blue], .. } = list;
        let pixels = &pixels[..len.next_multiple_of(WIDTH)];
        let mut planes = [Plane::default(); PLANES];
        let groups = pixels.chunks_exact(L::LANES).zip(primitives.chunks_exact(L::LANES));
        let colors = red.chunks_exact_mut(L::LANES).zip(green.chunks_exact_mut(L::LANES));
        let colors = colors.zip(blue.chunks_exact_mut(L::LANES));
        for ((pixels, primitives), ((red, green), blue)) in groups.zip(colors) {
            // Kept in memory in between: whole vectors come out of it, and the compiler optimises the two
            // halves by themselves, which it does better than both at once.
            let varyings = black_box(interpolate(input, pixels, primitives, &mut planes));
            let Vec3 { x, y, z } = program(&varyings);
            clamp(x).store(red);
            clamp(y).store(green);
            clamp(z).store(blue);
        }
    }
}

/// The varyings of one group of fragments, which may belong to several triangles.
#[inline(always)]
fn interpolate<L: Lane, const N: usize>(
    input: &ShadeInput<'_>,
    pixels: &[u16],
    primitives: &[Handle],
    planes: &mut [Plane<N>; PLANES],
) -> [L; N] {
    let mut result = [L::splat(0.0); N];
    if N == 0 {
        return result;
    }
    let [x0, y0] = input.origin;
    let (x0, y0) = (<L::Double as Lane>::splat(x0), <L::Double as Lane>::splat(y0));
    let x = x0 + L::Double::from_fn(|i| f32::from(pixels[i] % TILE_SIDE));
    let y = y0 - L::Double::from_fn(|i| f32::from(pixels[i] / TILE_SIDE));
    let (first, mut previous) = (primitives[0], 0);
    let alone = primitives.iter().fold(true, |all, &other| all & (other == first));
    for (i, &primitive) in primitives.iter().enumerate().take(if alone { 1 } else { WIDTH }) {
        // Three triangles or more may be interpolated again, which changes nothing.
        if primitive == previous || (i > 0 && primitive == first) {
            continue;
        }
        let plane = &mut planes[primitive as usize % PLANES];
        if plane.primitive != primitive {
            *plane = Plane::of(input, primitive);
        }
        let at = plane.interpolate::<L>(x, y);
        if i == 0 {
            result = at;
        } else {
            let mut mask = [false; WIDTH];
            for (mask, &other) in mask.iter_mut().zip(primitives) {
                *mask = other == primitive;
            }
            for (result, at) in result.iter_mut().zip(at) {
                *result = result.replace(&mask, at);
            }
        }
        previous = primitive;
    }
    result
}

/// Triangles that are kept ready for interpolation: about as many as meet in two rows of a tile.
const PLANES: usize = 32;

/// What interpolation needs to know of a triangle.
#[derive(Clone, Copy)]
struct Plane<const N: usize> {
    /// Which triangle; 0 is none.
    primitive: Handle,
    /// 1/w of each corner.
    r: [f32; 3],
    /// Window position of the first corner.
    origin: [f64; 2],
    /// What the barycentric coordinates of the second and third corner grow by per pixel right and up.
    steps: [[f64; 2]; 2],
    /// Of each corner.
    varyings: [[f32; N]; 3],
}

impl<const N: usize> Default for Plane<N> {
    fn default() -> Self {
        Self { primitive: 0, r: [0.0; 3], origin: [0.0; 2], steps: [[0.0; 2]; 2], varyings: [[0.0; N]; 3] }
    }
}

impl<const N: usize> Plane<N> {
    #[inline(always)]
    fn of(input: &ShadeInput<'_>, primitive: Handle) -> Self {
        let (chunk, index) = place(primitive);
        let chunk = &input.chunks[chunk];
        let Triangle { vertices: [i0, i1, i2], scale, .. } = chunk.triangles[index];
        let corner = |vertex: u32| chunk.corner(vertex, input.vertices).window;
        let (a, b, c) = (corner(i0), corner(i1), corner(i2));
        let d = |to: f32, from: f32| f64::from(to) - f64::from(from);
        let step = |gx: f64, gy: f64| [gx * scale, gy * scale];
        let varyings = |vertex: u32| *chunk.varyings_of::<N>(vertex, input.vertices);
        Self {
            primitive,
            r: [a.r, b.r, c.r],
            origin: [a.x.into(), a.y.into()],
            steps: [step(d(c.y, a.y), -d(c.x, a.x)), step(-d(b.y, a.y), d(b.x, a.x))],
            varyings: [varyings(i0), varyings(i1), varyings(i2)],
        }
    }

    /// The varyings at window positions (x, y).
    #[inline(always)]
    fn interpolate<L: Lane>(&self, x: L::Double, y: L::Double) -> [L; N] {
        let (x, y) = (x - L::splat_double(self.origin[0]), y - L::splat_double(self.origin[1]));
        let at = |[gx, gy]: [f64; 2]| L::splat_double(gx) * x + L::splat_double(gy) * y;
        let (l1, l2) = (at(self.steps[0]), at(self.steps[1]));
        let l0 = <L::Double as Lane>::splat(1.0) - l1 - l2;
        // Through memory, because the compiler otherwise mixes their lanes up. Before they are narrowed: it
        // would write halves, and reading a vector has to wait for halves of it.
        let (l0, l1, l2) = (L::narrow(black_box(l0)), L::narrow(black_box(l1)), L::narrow(black_box(l2)));
        let w0 = l0 * L::splat(self.r[0]);
        let w1 = l1 * L::splat(self.r[1]);
        let w2 = l2 * L::splat(self.r[2]);
        let w = L::splat(1.0) / (w0 + w1 + w2);
        let [a, b, c] = &self.varyings;
        let mut result = [L::splat(0.0); N];
        for (k, result) in result.iter_mut().enumerate() {
            *result = (w0 * L::splat(a[k]) + w1 * L::splat(b[k]) + w2 * L::splat(c[k])) * w;
        }
        result
    }
}

/// Clamps to 0..=1; NaN gives 0.
#[inline(always)]
fn clamp<L: Lane>(x: L) -> L {
    L::splat(1.0).select_less(x, L::splat(1.0), L::splat(0.0).select_less(x, x, L::splat(0.0)))
}
