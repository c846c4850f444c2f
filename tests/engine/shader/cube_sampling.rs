//! Cube-map lookups are the formulas' values: GL's face table and CLAMP_TO_EDGE, or across the edges where that is
//! asked for.

#![expect(clippy::cast_possible_truncation, reason = "texel indices and colours are small")]

use crate::support::{
    cases,
    shaders::{cube, noise},
};
use drape::{
    cubemap::Cubemap,
    glsl::vec3,
    math::splitmix64,
    scene::Filter,
    shader::sampler::{Sampler2d, SamplerCube, Wrap, texture, texture_cube},
    texture::Texture,
};
use proptest::prelude::*;

use super::sampling::{ROUNDING, bilinear, clamp_to_edge, distance, lanes};

/// Face and (s, t) of a direction by the table of the GL specification; ties z before y before x.
fn face([x, y, z]: [f64; 3]) -> (usize, f64, f64) {
    let longest = x.abs().max(y.abs()).max(z.abs());
    let (face, sc, tc) = if z.abs() == longest {
        if z > 0.0 { (4, x, -y) } else { (5, -x, -y) }
    } else if y.abs() == longest {
        if y > 0.0 { (2, x, z) } else { (3, x, -z) }
    } else if x > 0.0 {
        (0, -z, -y)
    } else {
        (1, z, -y)
    };
    (face, (sc / longest + 1.0) / 2.0, (tc / longest + 1.0) / 2.0)
}

fn look(cubemap: &Cubemap, filter: Filter, [x, y, z]: [f32; 3]) -> [f64; 3] {
    lanes(texture_cube(SamplerCube { cubemap, filter, seamless: false }, vec3(x, y, z)))
}

proptest! {
    #![proptest_config(cases(40))]

    #[test]
    fn cube_lookups_are_within_their_bound(
        size in 1..=256_usize,
        directions in prop::collection::vec(prop::array::uniform3(prop_oneof![-1.0..=1.0_f32, (-2..=2_i8).prop_map(f32::from)]), 500),
        seed in any::<u64>(),
    ) {
        let map = cube(|i| noise(size, size, seed ^ i as u64));
        // The coordinate has three roundings more than that of a picture.
        let bound = (4 * size + 2) as f64 * ROUNDING;
        for direction in directions.into_iter().filter(|direction| *direction != [0.0; 3]) {
            let (face, s, t) = face(direction.map(f64::from));
            let expected = bilinear(&map.faces()[face], s, t, clamp_to_edge);
            let error = distance(look(&map, Filter::Bilinear, direction), expected);
            prop_assert!(error <= bound, "{} over {} at {:?}", error, bound, direction);
        }
    }
}

/// All 26 directions of the cube's faces, edges and corners.
#[test]
fn ties_go_to_z_before_y_before_x() {
    let flat = |i: usize| Texture::from_rgb(1, 1, &[[i as f32, 0.0, 0.0]]).unwrap();
    let map = cube(flat);
    for code in (0..27).filter(|&code| code != 13) {
        let direction = [code % 3, code / 3 % 3, code / 9].map(|c| c as f32 - 1.0);
        let expected = match direction {
            [_, _, 1.0] => 4,
            [_, _, -1.0] => 5,
            [_, 1.0, _] => 2,
            [_, -1.0, _] => 3,
            [1.0, ..] => 0,
            _ => 1,
        };
        for filter in [Filter::Nearest, Filter::Bilinear] {
            assert_eq!(look(&map, filter, direction)[0], f64::from(expected), "{direction:?}");
        }
    }
}

/// A map painted with the directions of its texels, by the table's inverse, shows the direction of
/// every lookup: no face is swapped or turned, and across the twelve edges nothing jumps.
#[test]
fn every_direction_finds_itself() {
    let size = 64;
    let direction = |face: usize, s: f64, t: f64| match face {
        0 => [1.0, -t, -s],
        1 => [-1.0, -t, s],
        2 => [s, 1.0, t],
        3 => [s, -1.0, -t],
        4 => [s, -t, 1.0],
        _ => [-s, -t, -1.0],
    };
    let map = cube(|face| {
        let texels: Vec<[f32; 3]> = (0..size * size)
            .map(|i| {
                let [s, t] = [i % size, i / size].map(|k| (k as f64 + 0.5) / (size as f64 / 2.0) - 1.0);
                direction(face, s, t).map(|c| c as f32)
            })
            .collect();
        Texture::from_rgb(size, size, &texels).unwrap()
    });
    for i in 0..20_000 {
        let [x, y, z] = [0, 1, 2].map(|k| (splitmix64(3 * i + k) >> 40) as f32 / 8_388_608.0 - 1.0);
        let longest = f64::from(x.abs().max(y.abs()).max(z.abs()));
        let expected = [x, y, z].map(|c| f64::from(c) / longest);
        // Within half a texel of an edge the lookup clamps to the face.
        let error = distance(look(&map, Filter::Bilinear, [x, y, z]), expected);
        assert!(error <= 1.001 / size as f64, "{error} at {expected:?}");
    }
}

/// The texels of a face with those of its neighbours around it, found by the direction of each: what lies beyond an
/// edge is the nearest texel of the face that the direction hits, and beyond a corner the mean of the three.
fn around(map: &Cubemap, of: usize, i: i64, j: i64) -> [f64; 3] {
    let n = map.size() as i64;
    let texel = |face: usize, i: i64, j: i64| {
        [0, 1, 2].map(|c| f64::from(map.faces()[face].texel(i as usize, j as usize)[c]))
    };
    let inside = |k: i64| (0..n).contains(&k);
    let beyond = |i: i64, j: i64| {
        // A millionth beyond the edge, so that the direction hits the next face.
        let at =
            |k: i64| if inside(k) { (2 * k + 1 - n) as f64 } else { k.signum() as f64 * (n as f64 + 1e-6) };
        let [s, t] = [at(i), at(j)].map(|c| c / n as f64);
        let direction = match of {
            0 => [1.0, -t, -s],
            1 => [-1.0, -t, s],
            2 => [s, 1.0, t],
            3 => [s, -1.0, -t],
            4 => [s, -t, 1.0],
            _ => [-s, -t, -1.0],
        };
        let (face, s, t) = face(direction);
        let [i, j] = [s, t].map(|c| ((c * n as f64) as i64).min(n - 1));
        texel(face, i, j)
    };
    match (inside(i), inside(j)) {
        (true, true) => texel(of, i, j),
        (false, false) => {
            let [ci, cj] = [i, j].map(|k| k.clamp(0, n - 1));
            let meet = [texel(of, ci, cj), beyond(i, cj), beyond(ci, j)];
            [0, 1, 2].map(|c| (meet[0][c] + meet[1][c] + meet[2][c]) / 3.0)
        }
        _ => beyond(i, j),
    }
}

proptest! {
    #![proptest_config(cases(40))]

    #[test]
    fn seamless_lookups_blend_with_the_next_face(
        size in 1..=32_usize,
        directions in prop::collection::vec(prop::array::uniform3(prop_oneof![-1.0..=1.0_f32, (-2..=2_i8).prop_map(f32::from)]), 400),
        seed in any::<u64>(),
    ) {
        let map = cube(|i| noise(size, size, seed ^ i as u64));
        for [x, y, z] in directions.into_iter().filter(|direction| *direction != [0.0; 3]) {
            let (of, s, t) = face([x, y, z].map(f64::from));
            let (u, v) = (s * size as f64 - 0.5, t * size as f64 - 0.5);
            let (i, j) = (u.floor(), v.floor());
            let (fx, fy) = (u - i, v - j);
            let texel = |di: i64, dj: i64| around(&map, of, i as i64 + di, j as i64 + dj);
            let mix = |a: [f64; 3], b: [f64; 3], f: f64| [0, 1, 2].map(|c| a[c] * (1.0 - f) + b[c] * f);
            let expected = mix(mix(texel(0, 0), texel(1, 0), fx), mix(texel(0, 1), texel(1, 1), fx), fy);
            let sampler = SamplerCube { cubemap: &map, filter: Filter::Bilinear, seamless: true };
            let error = distance(lanes(texture_cube(sampler, vec3(x, y, z))), expected);
            prop_assert!(error <= (4 * size + 2) as f64 * ROUNDING, "{} at {:?} of {}", error, [x, y, z], size);
        }
    }
}

/// On the edges and corners of a cube of noise nothing jumps, and it does without.
#[test]
fn seamless_lookups_do_not_jump() {
    let map = cube(|i| noise(16, 16, i as u64));
    let jump = |seamless: bool, a: [f32; 3], b: [f32; 3]| {
        let at = |[x, y, z]: [f32; 3]| {
            lanes(texture_cube(
                SamplerCube { cubemap: &map, filter: Filter::Bilinear, seamless },
                vec3(x, y, z),
            ))
        };
        distance(at(a), at(b))
    };
    let (mut with, mut without) = (0.0_f64, 0.0_f64);
    for code in (0..27).filter(|&code| code != 13) {
        let towards = [code % 3, code / 3 % 3, code / 9].map(|c| c as f32 - 1.0);
        for i in 0..200_u64 {
            let nudge = |salt: u64| {
                [0, 1, 2]
                    .map(|k| ((splitmix64(900 * i + 3 * salt + k) >> 40) as f32 / 8_388_608.0 - 1.0) * 1e-5)
            };
            let along = towards.map(|c| if c == 0.0 { i as f32 / 100.0 - 1.0 } else { c });
            let add = |by: [f32; 3]| [0, 1, 2].map(|k| along[k] + by[k]);
            let (a, b) = (add(nudge(1)), add(nudge(2)));
            with = with.max(jump(true, a, b));
            without = without.max(jump(false, a, b));
        }
    }
    assert!(with < 2e-3 && without > 0.3, "{with} with, {without} without");
}

#[test]
fn no_direction_at_all_reads_the_middle_of_the_first_face() {
    let map = cube(|i| noise(8, 8, i as u64));
    for filter in [Filter::Nearest, Filter::Bilinear] {
        let middle = lanes(texture(
            Sampler2d { texture: &map.faces()[0], filter, wrap_v: Wrap::Repeat },
            [0.5_f32, 0.5],
        ));
        for bad in [[0.0; 3], [-0.0; 3], [f32::NAN; 3], [1.0, f32::NAN, 0.0], [f32::NAN, 0.0, 1.0]] {
            assert_eq!(look(&map, filter, bad), middle, "{bad:?}");
        }
    }
}
