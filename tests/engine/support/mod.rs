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
    lanes::{Lane, Wide},
    mesh::Attributes,
    raster::{self, DrawCall, Framebuffer, Primitives, Stats},
    shader::glsl::{VertexOutput, vec3},
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
        let (stats, _) = raster::draw(&mut framebuffer, [0.0; 3], calls, true);
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

/// Primitives at clip-space positions in one colour.
pub(crate) fn flat<'a>(
    primitives: Primitives<'a>,
    positions: &'a [[f32; 4]],
    color: [f32; 3],
) -> DrawCall<'a> {
    let vertex = |i: usize| Vertex { clip: positions[i], varyings: [0.0; 3] };
    let [r, g, b] = color;
    DrawCall::new::<Wide<f32>, 0>(
        primitives,
        positions.len(),
        move |i| attributes(&vertex(i)),
        |a: &Attributes| (program(a).0, []),
        move |_: &[Wide<f32>; 0]| vec3(Lane::splat(r), Lane::splat(g), Lane::splat(b)),
    )
}

/// The varyings of every fragment of `triangles` in the order of shading (that of the pixels, for
/// a picture of one tile), as the fragment program gets them in lanes `L`.
pub(crate) fn varyings<L: Lane + 'static>(
    canvas: Canvas,
    vertices: &[Vertex],
    triangles: &[[u32; 3]],
) -> (Vec<[f64; 3]>, Picture) {
    let seen = Mutex::new(Vec::new());
    let fragment = |v: &[L; 3]| {
        let mut seen = seen.lock().unwrap();
        seen.extend((0..L::LANES).map(|lane| v.map(|value| value.lane(lane))));
        vec3(v[0], v[1], v[2])
    };
    let attributes = |i: usize| attributes(&vertices[i]);
    let call = DrawCall::new::<L, 3>(
        Primitives::Triangles(triangles),
        vertices.len(),
        attributes,
        program,
        fragment,
    );
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

/// A vertex packed into attributes, for [`program`] to unpack.
pub(crate) fn attributes(vertex: &Vertex) -> Attributes {
    let [x, y, z, w] = vertex.clip;
    Attributes {
        in_position: [x, y, z],
        in_uv: [w, 0.0],
        in_normal: vertex.varyings,
        ..Attributes::default()
    }
}

/// The vertex program that puts out what [`attributes`] packed.
pub(crate) fn program(a: &Attributes) -> VertexOutput<3> {
    let ([x, y, z], [w, _]) = (a.in_position, a.in_uv);
    ([x, y, z, w], a.in_normal)
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
