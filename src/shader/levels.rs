//! Tests: every level of vectors, and one fragment at a time, give the same bits.

use std::sync::Mutex;

use super::{
    Uniforms, bump, custom, diffuse, displacement, mirror, normal, phong,
    sampler::{Sampler2d, SamplerCube, Wrap},
    texture, wireframe,
};
use crate::{
    cubemap::Cubemap,
    glsl::{Exponent, Vec3},
    lanes::{Lane, Part, level::Level},
    math::splitmix64,
    mesh::Attributes,
    raster::{DrawCall, FragmentProgram, Framebuffer, Primitives, Stats, VertexProgram, draw},
    scene::{Filter, Shader},
    texture::Texture,
};

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

#[expect(clippy::cast_precision_loss, reason = "24 bits")]
fn random(i: usize) -> f32 {
    (splitmix64(i as u64) >> 40) as f32 / 8_388_608.0 - 1.0
}

/// A vertex somewhere around the picture.
fn vertex(i: usize) -> Attributes {
    let [x, y, z] = [0, 1, 2].map(|k| random(11 * i + k));
    Attributes {
        in_position: [1.5 * x, 1.5 * y, z],
        in_normal: [3, 4, 5].map(|k| random(11 * i + k)),
        in_tangent: [6, 7, 8].map(|k| random(11 * i + k)),
        in_uv: [9, 10].map(|k| random(11 * i + k)),
    }
}

/// A program that writes down the bits of its colours.
struct Record<'a, F>(F, &'a Mutex<Vec<[u64; 3]>>);

impl<F: FragmentProgram<N>, const N: usize> FragmentProgram<N> for Record<'_, F> {
    type Varyings<L: Lane> = F::Varyings<L>;

    #[inline(always)]
    fn stage<L: Lane>(&self, token: L::Token) -> impl Fn(F::Varyings<L>) -> Vec3<L> {
        let stage = self.0.stage::<L>(token);
        move |varyings| {
            let color = stage(varyings);
            let channels = <[L; 3]>::from(color).map(bits);
            let fragments = (0..channels[0].len()).map(|i| [0, 1, 2].map(|k| channels[k][i]));
            self.1.lock().unwrap().extend(fragments);
            color
        }
    }
}

/// The bits of every lane, NaNs made one.
fn bits<L: Lane>(value: L) -> Vec<u64> {
    let mut bits = Vec::new();
    value.each_part(|_, part| {
        bits.extend((0..<L::Part as Part>::WIDTH).map(|i| (part.lane(i) + 0.0_f64.copysign(-1.0)).to_bits()));
    });
    bits
}

/// How fragments are shaded.
#[derive(Clone, Copy, Debug)]
enum Way {
    Vectors,
    OneByOne,
}

/// What must be the same.
struct Outcome {
    rgb: Vec<u8>,
    depth: Vec<u32>,
    ids: Vec<u32>,
    stats: Stats,
    /// The bits of the colours of all fragments.
    colors: Vec<[u64; 3]>,
}

impl Outcome {
    /// What is not the same in another.
    fn differences(&self, other: &Self) -> Vec<&'static str> {
        let same = [
            ("rgb", self.rgb == other.rgb),
            ("depth", self.depth == other.depth),
            ("ids", self.ids == other.ids),
            ("stats", self.stats == other.stats),
            ("colours", self.colors == other.colors),
        ];
        same.into_iter().filter(|&(_, same)| !same).map(|(what, _)| what).collect()
    }
}

/// Draws triangles, many and some small, and lines with a program.
fn outcome<F: FragmentProgram<N>, const N: usize>(
    way: Way,
    samples: u32,
    program: impl VertexProgram<Attributes, F::Varyings<f32>>,
    fragment: F,
) -> Outcome {
    let triangles: Vec<[u32; 3]> = (0..60).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    let (triangles, colors) = (Primitives::Triangles(&triangles), Mutex::new(Vec::new()));
    let record = Record(fragment, &colors);
    let call = match way {
        Way::Vectors => DrawCall::new(triangles, 180, vertex, program, record),
        Way::OneByOne => DrawCall::one_by_one::<f32, _, _, N>(triangles, 180, vertex, program, record),
    };
    let lines = Primitives::Lines(&[[0, 7], [50, 3], [12, 100]]);
    let wires =
        DrawCall::new(lines, 180, vertex, wireframe::vertex(&UNIFORMS), wireframe::Fragment { u: UNIFORMS });
    // One tile, because tiles come in any order.
    let mut framebuffer = Framebuffer::new(64, 60, samples);
    let stats = draw(&mut framebuffer, [0.2; 3], &[call, wires], true);
    let depth = framebuffer.depth().into_iter().map(f32::to_bits).collect();
    let (rgb, ids) = (framebuffer.rgb(), framebuffer.ids());
    let of_triangles = ids.iter().filter(|&&id| id >> 24 == 1).count();
    let mut colors = colors.into_inner().unwrap();
    assert!(colors.len() >= of_triangles);
    colors.truncate(of_triangles);
    Outcome { rgb, depth, ids, stats, colors }
}

/// Every program of the module by every way gives what the first way gives.
fn programs(mut check: impl FnMut(&str, &dyn Fn(Way, u32) -> Outcome), filter: Filter) {
    let texels = |n: usize| (0..n).map(|i| [0, 1, 2].map(|k| random(3 * i + k).abs())).collect::<Vec<_>>();
    let u = UNIFORMS;
    let picture = Texture::from_rgb(7, 5, &texels(35)).unwrap();
    let map = Texture::from_rgb(8, 8, &texels(64)).unwrap();
    let faces = [0, 1, 2, 3, 4, 5].map(|_| Texture::from_rgb(9, 9, &texels(81)).unwrap());
    let cubemap = Cubemap::new("test", faces).unwrap();
    let u_texture_1 = Sampler2d { texture: &picture, filter, wrap_v: Wrap::Repeat };
    let u_texture_2 = Sampler2d { texture: &map, filter, wrap_v: Wrap::Clamp };
    let u_texture_cubemap = SamplerCube { cubemap: &cubemap, filter, seamless: true };
    check("wireframe", &|way, n| outcome(way, n, wireframe::vertex(&u), wireframe::Fragment { u }));
    check("normal", &|way, n| outcome(way, n, normal::vertex(&u), normal::Fragment {}));
    check("diffuse", &|way, n| outcome(way, n, diffuse::vertex(&u), diffuse::Fragment { u }));
    check("phong", &|way, n| outcome(way, n, phong::vertex(&u), phong::Fragment { u }));
    check("texture", &|way, n| outcome(way, n, texture::vertex(&u), texture::Fragment { u_texture_1 }));
    check("mirror", &|way, n| outcome(way, n, mirror::vertex(&u), mirror::Fragment { u, u_texture_cubemap }));
    check("bump", &|way, n| outcome(way, n, bump::vertex(&u), bump::Fragment { u, u_texture_2 }));
    check("displacement", &|way, n| {
        let vertex = displacement::vertex(&u, u_texture_2);
        outcome(way, n, vertex, displacement::Fragment { u, u_texture_2 })
    });
    check("custom", &|way, n| {
        let fragment = custom::Fragment { u, u_texture_1, u_texture_2, u_texture_cubemap };
        outcome(way, n, custom::vertex(&u, u_texture_2), fragment)
    });
}

#[test]
fn every_level_gives_the_bits_of_one_fragment_at_a_time() {
    for filter in [Filter::Bilinear, Filter::Nearest] {
        let mut seen = Vec::new();
        programs(
            |name, outcome| {
                let alone = outcome(Way::OneByOne, 1);
                assert!(alone.stats.fragments > 2500, "{name}: {:?}", alone.stats);
                Level::for_each(|level| {
                    let differing = alone.differences(&outcome(Way::Vectors, 1));
                    assert!(differing.is_empty(), "{name} at {level:?}: {differing:?}");
                    seen.push(name.to_owned());
                });
            },
            filter,
        );
        seen.sort_unstable();
        let levels = Level::available().len();
        let mut all: Vec<&str> = Shader::NAMES.iter().flat_map(|&(name, _)| vec![name; levels]).collect();
        all.sort_unstable();
        assert_eq!(seen, all, "every shader at every level");
    }
}

/// With several samples as well; there the order of fragments is not that of the pixels.
#[test]
fn every_level_gives_the_same_picture_of_four_samples() {
    let check = |name: &str, outcome: &dyn Fn(Way, u32) -> Outcome| {
        let first = outcome(Way::OneByOne, 4);
        Level::for_each(|level| {
            let mut differing = first.differences(&outcome(Way::Vectors, 4));
            differing.retain(|&what| what != "colours");
            assert!(differing.is_empty(), "{name} at {level:?}: {differing:?}");
        });
    };
    programs(check, Filter::Bilinear);
}
