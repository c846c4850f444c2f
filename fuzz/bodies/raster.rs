//! The rasteriser: positions in clip space and varyings of any bits give a picture, the same one for every number of
//! threads, every level of vector instructions and one fragment at a time.

use std::sync::OnceLock;

use drape::cubemap::Cubemap;
use drape::glsl::Exponent;
use drape::lanes::level::Level;
use drape::raster::{DrawCall, FragmentProgram, Framebuffer, NoVaryings, Primitives, Stats, draw};
use drape::scene::Filter;
use drape::shader::default::{Lit, Relief, Textured};
use drape::shader::sampler::{Sampler2d, SamplerCube, Wrap};
use drape::shader::{Uniforms, bump, mirror, phong, texture};
use drape::texture::Texture;
use rayon::{ThreadPool, ThreadPoolBuilder};

/// Longest side of a picture: more than a tile.
const SIDE: u8 = 100;

/// Most vertices and primitives.
const MOST: u8 = 24;

/// Numbers of a vertex: a position in clip space, and varyings.
const NUMBERS: usize = 15;

/// Draws what the bytes describe: a header, the corners of the primitives, and the bits of the vertices. What is
/// missing is 0.
pub(crate) fn run(bytes: &[u8]) {
    let mut rest = bytes.iter().copied();
    let input = Input::read(&mut || rest.next().unwrap_or(0));
    let widest = in_pool(3, || input.draw(Way::Vectors));
    let [baseline, alone] = in_pool(1, || {
        Level::Baseline.limit();
        let baseline = input.draw(Way::Vectors);
        Level::Avx512.limit();
        [baseline, input.draw(Way::OneByOne)]
    });
    assert!(widest == baseline, "3 threads and the widest vectors, 1 thread and the narrowest: {input:?}");
    assert!(widest == alone, "vectors, and one fragment at a time: {input:?}");
    widest.check(&input);
}

/// What is drawn.
#[derive(Debug)]
struct Input {
    size: [u32; 2],
    samples: u32,
    program: u8,
    vertices: Vec<[f32; NUMBERS]>,
    triangles: Vec<[u32; 3]>,
    lines: Vec<[u32; 2]>,
}

/// How fragments are shaded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Way {
    Vectors,
    OneByOne,
}

/// What is left in the framebuffer.
#[derive(PartialEq)]
struct Picture {
    rgb: Vec<u8>,
    depth: Vec<u32>,
    ids: Vec<u32>,
    stats: Stats,
}

impl Input {
    fn read(byte: &mut impl FnMut() -> u8) -> Self {
        let size = [0, 1].map(|_| u32::from(byte() % SIDE) + 1);
        let kind = byte();
        let samples = [1, 4, 8, 16][usize::from(kind >> 6)];
        let program = kind & 0b1111;
        let [vertices, triangles, lines] = [byte() % MOST + 1, byte() % MOST, byte() % MOST];
        let mut corner = || u32::from(byte() % vertices);
        let triangles = (0..triangles).map(|_| [corner(), corner(), corner()]).collect();
        let lines = (0..lines).map(|_| [corner(), corner()]).collect();
        let mut number = || f32::from_le_bytes([byte(), byte(), byte(), byte()]);
        let vertices = (0..vertices).map(|_| [(); NUMBERS].map(|()| number())).collect();
        Self { size, samples, program, vertices, triangles, lines }
    }

    /// Draws the picture with the program that is asked for.
    fn draw(&self, way: Way) -> Picture {
        let Pictures { map, cubemap } = pictures();
        let filter = if self.program & 4 == 0 { Filter::Bilinear } else { Filter::Nearest };
        let wrap_v = if self.program & 8 == 0 { Wrap::Repeat } else { Wrap::Clamp };
        let map = Sampler2d { texture: map, filter, wrap_v };
        match self.program & 3 {
            0 => {
                let fragment = texture::Fragment { u_texture_1: map };
                let varyings = |v: &[f32; NUMBERS]| (position(v), Textured { v_uv: two(v, 4) });
                self.draw_with(way, varyings, fragment)
            }
            1 => {
                let fragment = phong::Fragment { u: UNIFORMS };
                self.draw_with(way, |v: &[f32; NUMBERS]| (position(v), lit(v)), fragment)
            }
            2 => {
                let u_texture_cubemap = SamplerCube { cubemap, filter, seamless: self.program & 8 == 0 };
                let fragment = mirror::Fragment { u: UNIFORMS, u_texture_cubemap };
                self.draw_with(way, |v: &[f32; NUMBERS]| (position(v), lit(v)), fragment)
            }
            _ => {
                let fragment = bump::Fragment { u: UNIFORMS, u_texture_2: map };
                self.draw_with(way, |v: &[f32; NUMBERS]| (position(v), relief(v)), fragment)
            }
        }
    }

    /// Draws the triangles with a program, and the lines over them; one by one twice, into the same framebuffer.
    fn draw_with<F: FragmentProgram<N>, const N: usize>(
        &self,
        way: Way,
        vertex: impl Fn(&[f32; NUMBERS]) -> ([f32; 4], F::Varyings<f32>) + Send + Sync,
        fragment: F,
    ) -> Picture {
        let triangles = Primitives::Triangles(&self.triangles);
        let (count, attributes) = (self.vertices.len(), |i: usize| self.vertices[i]);
        let calls = [
            match way {
                Way::Vectors => DrawCall::new(triangles, count, attributes, vertex, fragment),
                Way::OneByOne => {
                    DrawCall::one_by_one::<f32, _, _, N>(triangles, count, attributes, vertex, fragment)
                }
            },
            DrawCall::new(
                Primitives::Lines(&self.lines),
                count,
                attributes,
                |v: &[f32; NUMBERS]| (position(v), NoVaryings::default()),
                Flat { color: [0.9, 0.5, 0.1] },
            ),
        ];
        let mut framebuffer = Framebuffer::new(self.size[0], self.size[1], self.samples);
        let mut picture = || {
            let stats = draw(&mut framebuffer, [0.25; 3], &calls, true);
            let depth = framebuffer.depth().into_iter().map(f32::to_bits).collect();
            Picture { rgb: framebuffer.rgb(), depth, ids: framebuffer.ids(), stats }
        };
        let first = picture();
        assert!(way == Way::Vectors || first == picture(), "a framebuffer that was used before: {self:?}");
        first
    }
}

impl Picture {
    /// What holds of every picture.
    fn check(&self, input: &Input) {
        let pixels = (input.size[0] * input.size[1]) as usize;
        assert_eq!([self.rgb.len(), self.depth.len(), self.ids.len()], [3 * pixels, pixels, pixels]);
        let depth = |bits: &u32| (0.0..=1.0).contains(&f32::from_bits(*bits));
        assert!(self.depth.iter().all(depth), "a depth beyond 0 and 1: {input:?}");
        let Stats { outside, non_finite, degenerate, no_sample, drawn, .. } = self.stats;
        let primitives = (input.triangles.len() + input.lines.len()) as u64;
        assert!(
            outside + non_finite + degenerate + no_sample + drawn >= primitives,
            "not each is counted: {:?} of {input:?}",
            self.stats
        );
    }
}

drape::fragment_program! {
    /// One colour.
    struct Flat { color: [f32; 3] }
    |NoVaryings {}| color
}

const IDENTITY: [[f32; 4]; 4] =
    [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]];

const UNIFORMS: Uniforms = Uniforms {
    u_model: IDENTITY,
    u_view_projection: IDENTITY,
    u_cam_pos: [0.1, 0.2, 3.0],
    u_color: [0.9, 0.8, 0.7],
    u_light_pos: [1.0, 2.0, 2.0],
    u_light_intensity: [3.0; 3],
    u_light_color: [1.0; 3],
    u_ka: 0.1,
    u_kd: 0.7,
    u_ks: 1.0,
    u_shininess: Exponent::Real(37.5),
    u_km: 0.25,
    u_normal_scaling: 2.0,
    u_height_scaling: 0.1,
    u_bitangent: -1.0,
    u_two_sided: 1.0,
};

fn position(vertex: &[f32; NUMBERS]) -> [f32; 4] {
    [vertex[0], vertex[1], vertex[2], vertex[3]]
}

fn two(vertex: &[f32; NUMBERS], first: usize) -> [f32; 2] {
    [vertex[first], vertex[first + 1]]
}

fn three(vertex: &[f32; NUMBERS], first: usize) -> [f32; 3] {
    [vertex[first], vertex[first + 1], vertex[first + 2]]
}

fn lit(vertex: &[f32; NUMBERS]) -> Lit<f32> {
    Lit { v_position: three(vertex, 4).into(), v_normal: three(vertex, 7).into() }
}

fn relief(vertex: &[f32; NUMBERS]) -> Relief<f32> {
    Relief {
        v_position: three(vertex, 6).into(),
        v_normal: three(vertex, 9).into(),
        v_tangent: three(vertex, 12).into(),
        v_uv: two(vertex, 4),
    }
}

/// What the programs look into.
struct Pictures {
    map: Texture,
    cubemap: Cubemap,
}

fn pictures() -> &'static Pictures {
    static PICTURES: OnceLock<Pictures> = OnceLock::new();
    PICTURES.get_or_init(|| {
        let texels = |count: u16, salt: u16| -> Vec<[f32; 3]> {
            let channel = |i: u16, k: u16| f32::from((i * 37 + k * 61 + salt * 17) % 101) / 100.0;
            (0..count).map(|i| [0, 1, 2].map(|k| channel(i, k))).collect()
        };
        let map = Texture::from_rgb(7, 5, &texels(35, 0)).expect("a texture");
        let face = |salt: u16| Texture::from_rgb(3, 3, &texels(9, salt)).expect("a face");
        let cubemap = Cubemap::new("cube", [0, 1, 2, 3, 4, 5].map(face)).expect("a cube map");
        Pictures { map, cubemap }
    })
}

/// Does work with so many threads, 1 or 3.
fn in_pool<T: Send>(threads: usize, work: impl FnOnce() -> T + Send) -> T {
    static POOLS: [OnceLock<ThreadPool>; 2] = [const { OnceLock::new() }; 2];
    let new = || ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
    POOLS[usize::from(threads > 1)].get_or_init(new).install(work)
}
