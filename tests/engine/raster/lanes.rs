//! One fragment at a time or eight side by side, every program gives the same bits.

use crate::support::{
    Canvas, Vertex,
    shaders::{cube, fragment, noise, random, smooth, smooth_cube, uniforms},
    varyings,
};
use drape::{
    lanes::{Lane, WIDTH, Wide},
    shader::{bump, custom, diffuse, displacement, glsl::Vec3, mirror, normal, phong, texture, wireframe},
};

/// Runs a program on 3200 fragments, whose varyings are those of `fragment` from `first` on, in one
/// lane and in eight.
fn same_bits<const N: usize>(
    first: usize,
    one: impl Fn(&[f32; N]) -> Vec3<f32>,
    eight: impl Fn(&[Wide<f32>; N]) -> Vec3<Wide<f32>>,
) {
    for group in 0..400 {
        let varyings: [[f32; N]; WIDTH] = std::array::from_fn(|lane| {
            let all = fragment(group * 8 + lane as u64);
            std::array::from_fn(|k| all[first + k])
        });
        let wide = eight(&std::array::from_fn(|k| Wide(varyings.map(|v| v[k]))));
        for (lane, varyings) in varyings.iter().enumerate() {
            let alone = one(varyings);
            let bits = |color: [f32; 3]| color.map(f32::to_bits);
            assert_eq!(
                bits([alone.x, alone.y, alone.z]),
                bits([wide.x.0[lane], wide.y.0[lane], wide.z.0[lane]]),
                "{varyings:?}"
            );
        }
    }
}

#[test]
fn every_program_gives_the_same_bits_in_one_lane_and_in_eight() {
    let u = &uniforms();
    let (picture, heights, map) = (noise(37, 53, 1), noise(64, 32, 2), cube(|i| noise(17, 17, i as u64)));
    let (one, two, environment) = (smooth(&picture), smooth(&heights), smooth_cube(&map));
    same_bits(0, wireframe::fragment(u), wireframe::fragment(u));
    same_bits(3, normal::fragment(u), normal::fragment(u));
    same_bits(0, diffuse::fragment(u), diffuse::fragment(u));
    same_bits(0, phong::fragment(u), phong::fragment(u));
    same_bits(9, texture::fragment(u, one), texture::fragment(u, one));
    same_bits(0, mirror::fragment(u, environment), mirror::fragment(u, environment));
    same_bits(0, bump::fragment(u, two), bump::fragment(u, two));
    same_bits(0, displacement::fragment(u, two), displacement::fragment(u, two));
    same_bits(0, custom::fragment(u, one, two, environment), custom::fragment(u, one, two, environment));
}

/// Groups of eight may hold fragments of several triangles.
#[test]
fn interpolation_gives_the_same_bits_in_one_lane_and_in_eight() {
    let vertex = |i: u64| {
        let [x, y, z, a, b, c, w] = [0, 1, 2, 3, 4, 5, 6].map(|k| random(7 * i + k));
        let w = w + 1.5;
        Vertex { clip: [x * w, y * w, z * w, w], varyings: [a, b, c] }
    };
    let vertices: Vec<Vertex> = (0..300).map(vertex).collect();
    let triangles: Vec<[u32; 3]> = (0..100).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    let canvas = Canvas::new(64, 64);
    let (one, picture) = varyings::<f32>(canvas, &vertices, &triangles);
    assert!(one.len() > 3000, "{} fragments", one.len());
    assert_eq!((one, picture), varyings::<Wide<f32>>(canvas, &vertices, &triangles));
    let (one, picture) = varyings::<f64>(canvas, &vertices, &triangles);
    assert_eq!((one, picture), varyings::<Wide<f64>>(canvas, &vertices, &triangles));
}

/// Every operation of the lanes is that of plain numbers, also on those without a size.
#[test]
fn every_operation_is_that_of_plain_numbers() {
    let special = [0.0, -0.0, 1.0, -1.5, f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 1e-45, 2.5, -2.5, 1e30];
    for &a in &special {
        for &b in &special {
            let (x, y) = (Wide::splat(a), Wide::<f32>::splat(b));
            let pairs = [
                (x + y, a + b),
                (x - y, a - b),
                (x * y, a * b),
                (x / y, a / b),
                (-x, -a),
                (Lane::sqrt(x), Lane::sqrt(a)),
                (Lane::floor(x), Lane::floor(a)),
                (Lane::abs(x), if a < 0.0 { -a } else { a }),
                (Lane::max(x, y), if b < a { a } else { b }),
                (Lane::min(x, y), if a < b { a } else { b }),
                (x.select_less(y, x, y), if a < b { a } else { b }),
            ];
            for (i, (wide, one)) in pairs.into_iter().enumerate() {
                let same = |lane: f32| lane.to_bits() == one.to_bits() || (lane.is_nan() && one.is_nan());
                assert!(wide.0.into_iter().all(same), "operation {i} of {a} and {b}: {wide:?} for {one}");
            }
        }
    }
    let mask = [true, false, true, false, false, true, false, false];
    let replaced = Wide([1.0_f32; WIDTH]).replace(&mask, Wide::from_fn(|i| 10.0 + i as f32));
    assert_eq!(replaced.0, [10.0, 1.0, 12.0, 1.0, 1.0, 15.0, 1.0, 1.0]);
}

/// Whole numbers become what a cast makes of them, also where some lanes are too large for the short way.
#[test]
fn whole_numbers_become_the_integers_of_a_cast() {
    let near = [0.0, -0.0, 1.0, -1.0, 255.0, -16_384.0, 4_194_303.0, -4_194_303.0];
    let far =
        [4_194_304.0, -4_194_305.0, 16_777_216.0, 3e9, -3e9, f32::NAN, f32::INFINITY, f32::NEG_INFINITY];
    for lanes in [near, far, std::array::from_fn(|i| if i == 5 { far[3] } else { near[i] })] {
        #[expect(clippy::cast_possible_truncation, reason = "what is tested")]
        let cast = lanes.map(|lane| lane as i32);
        assert_eq!(Wide(lanes).to_whole().0, cast, "{lanes:?}");
        assert_eq!(Wide(lanes.map(f64::from)).to_whole().0, cast, "{lanes:?}");
        for (lane, cast) in lanes.into_iter().zip(cast) {
            assert_eq!(lane.to_whole().0, [cast, 0, 0, 0, 0, 0, 0, 0]);
            assert_eq!(f64::from(lane).to_whole().0[0], cast);
        }
    }
}
