//! What the tests of the rasteriser share: drawing straight from clip space, and window positions
//! by their definition.

#![allow(dead_code, reason = "each test uses some of these")]
#![allow(clippy::unwrap_used, reason = "a helper that fails is a test that fails")]
#![allow(clippy::cast_possible_truncation, reason = "window positions are f32 and pixels few")]

pub(crate) mod coverage;
pub(crate) mod homogeneous;
pub(crate) mod shaders;

use std::sync::Mutex;

use drape::{
    glsl::Vec3,
    lanes::{F64, Lane, Part},
    raster::{self, DrawCall, FragmentProgram, Framebuffer, NoVaryings, Primitives, Stats, VertexOutput},
};
use proptest::{prelude::ProptestConfig, test_runner::RngSeed};

/// `count` cases, the same in every run unless the variable `PROPTEST_RNG_SEED` names others.
pub(crate) fn cases(count: u32) -> ProptestConfig {
    let default = ProptestConfig::default();
    let seed = match default.rng_seed {
        RngSeed::Random => 1,
        RngSeed::Fixed(seed) => seed,
    };
    ProptestConfig { cases: count, rng_seed: RngSeed::Fixed(seed), failure_persistence: None, ..default }
}

/// Width, height and samples of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Canvas {
    pub(crate) width: u32,
    pub(crate) height: u32,
    pub(crate) samples: u32,
}

/// A position in clip space with three varyings.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Vertex {
    pub(crate) clip: [f32; 4],
    pub(crate) varyings: [f32; 3],
}

/// What `draw` leaves, pixels row by row from the top.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Picture {
    pub(crate) rgb: Vec<[u8; 3]>,
    pub(crate) depth: Vec<f32>,
    pub(crate) ids: Vec<u32>,
    pub(crate) stats: Stats,
}

impl Canvas {
    pub(crate) const fn new(width: u32, height: u32) -> Self {
        Self { width, height, samples: 1 }
    }

    pub(crate) const fn samples(self, samples: u32) -> Self {
        Self { samples, ..self }
    }

    /// Every pixel (column, row from the top), row by row.
    pub(crate) fn pixels(self) -> impl Iterator<Item = [u32; 2]> {
        (0..self.height).flat_map(move |y| (0..self.width).map(move |x| [x, y]))
    }

    /// Draws calls over black.
    pub(crate) fn draw(self, calls: &[DrawCall<'_>]) -> Picture {
        let mut framebuffer = Framebuffer::new(self.width, self.height, self.samples);
        let stats = raster::draw(&mut framebuffer, [0.0; 3], calls, true);
        let rgb = framebuffer.rgb().as_chunks().0.to_vec();
        Picture { rgb, depth: framebuffer.depth(), ids: framebuffer.ids(), stats }
    }

    /// Draws white triangles at clip-space positions.
    pub(crate) fn triangles(self, positions: &[[f32; 4]], triangles: &[[u32; 3]]) -> Picture {
        self.draw(&[flat(Primitives::Triangles(triangles), positions, [1.0; 3])])
    }

    /// Draws one white triangle.
    pub(crate) fn triangle(self, corners: [[f32; 4]; 3]) -> Picture {
        self.triangles(&corners, &[[0, 1, 2]])
    }
}

drape::fragment_program! {
    /// One colour.
    pub(crate) struct Flat { color: [f32; 3] }
    |NoVaryings {}| color
}

/// Primitives at clip-space positions in one colour.
pub(crate) fn flat<'a>(
    primitives: Primitives<'a>,
    positions: &'a [[f32; 4]],
    color: [f32; 3],
) -> DrawCall<'a> {
    let program = |&clip: &[f32; 4]| (clip, NoVaryings::default());
    DrawCall::new(primitives, positions.len(), |i| positions[i], program, Flat { color })
}

drape::varyings! {
    /// Three numbers.
    pub(crate) struct Three { v_three: vec3 }
}

/// A program that puts out its varyings as a colour, and writes them down.
pub(crate) struct Record<'a>(pub(crate) &'a Mutex<Vec<[f64; 3]>>);

impl FragmentProgram<3> for Record<'_> {
    type Varyings<L: Lane> = Three<L>;

    #[inline(always)]
    fn stage<L: Lane>(&self, _token: L::Token) -> impl Fn(Three<L>) -> Vec3<L> {
        |Three { v_three }| {
            let channels = <[L; 3]>::from(v_three).map(lanes);
            let fragments = (0..channels[0].len()).map(|i| [0, 1, 2].map(|k| channels[k][i]));
            self.0.lock().unwrap().extend(fragments);
            v_three
        }
    }
}

/// The lanes of a value.
pub(crate) fn lanes<L: Lane>(value: L) -> Vec<f64> {
    let mut lanes = Vec::new();
    value.each_part(|_, part| lanes.extend((0..<L::Part as Part>::WIDTH).map(|i| part.lane(i))));
    lanes
}

/// In which numbers fragments are shaded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Numbers {
    /// Vectors of f32, as pictures are drawn.
    Vectors,
    /// One f32 at a time.
    F32,
    /// One f64 at a time.
    F64,
}

/// The varyings of every fragment of `triangles` row by row (of a picture of one tile), as the fragment
/// program gets them.
pub(crate) fn varyings(
    numbers: Numbers,
    canvas: Canvas,
    vertices: &[Vertex],
    triangles: &[[u32; 3]],
) -> (Vec<[f64; 3]>, Picture) {
    let seen = Mutex::new(Vec::new());
    let (triangles, count) = (Primitives::Triangles(triangles), vertices.len());
    let attributes = |i: usize| vertices[i];
    let call = match numbers {
        Numbers::Vectors => DrawCall::new(triangles, count, attributes, program, Record(&seen)),
        Numbers::F32 => {
            DrawCall::one_by_one::<f32, _, _, 3>(triangles, count, attributes, program, Record(&seen))
        }
        Numbers::F64 => {
            DrawCall::one_by_one::<F64, _, _, 3>(triangles, count, attributes, program, Record(&seen))
        }
    };
    let picture = canvas.draw(&[call]);
    let mut seen = seen.into_inner().unwrap();
    assert!(seen.len() >= picture.stats.fragments as usize, "each fragment is shaded");
    seen.truncate(picture.stats.fragments as usize);
    (row_by_row(canvas, &picture, seen), picture)
}

/// What was seen in a picture of one tile, from the order of shading, which is by blocks of 4 × 2
/// pixels, to row by row.
fn row_by_row(canvas: Canvas, picture: &Picture, seen: Vec<[f64; 3]>) -> Vec<[f64; 3]> {
    let mut pixels: Vec<[u32; 2]> =
        canvas.pixels().zip(&picture.ids).filter(|&(_, &id)| id != 0).map(|(pixel, _)| pixel).collect();
    assert_eq!(pixels.len(), seen.len(), "a fragment a pixel");
    pixels.sort_by_key(|&[x, y]| (y / 2, x / 4, y, x));
    let mut placed: Vec<_> = pixels.into_iter().zip(seen).collect();
    placed.sort_by_key(|&([x, y], _)| (y, x));
    placed.into_iter().map(|(_, seen)| seen).collect()
}

/// The text picture of what is drawn, rows from the top: `#` where something is.
pub(crate) fn rows(canvas: Canvas, picture: &Picture) -> Vec<String> {
    let mark = |&id: &u32| if id == 0 { '.' } else { '#' };
    picture.ids.chunks(canvas.width as usize).map(|row| row.iter().map(mark).collect()).collect()
}

/// The vertex program that puts out what it gets.
pub(crate) fn program(vertex: &Vertex) -> VertexOutput<Three<f32>> {
    (vertex.clip, Three { v_three: vertex.varyings.into() })
}

/// The window position (x right, y up, depth, 1/w) of a clip-space position: r = 1/w and
/// clip·r in f32, then ndc·(extent/2) + extent/2 in f64, rounded to f32.
pub(crate) fn window([x, y, z, w]: [f32; 4], canvas: Canvas) -> [f32; 4] {
    let r = 1.0 / w;
    let place = |clip: f32, extent: u32| {
        let half = f64::from(extent) / 2.0;
        (f64::from(clip * r) * half + half) as f32
    };
    [place(x, canvas.width), place(y, canvas.height), z * r * 0.5 + 0.5, r]
}
