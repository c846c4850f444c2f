//! Texture lookups are the formulas' values: nearest and bilinear, REPEAT on pictures.

#![expect(clippy::cast_possible_truncation, reason = "texel indices and colours are small")]

use crate::support::{cases, shaders::noise};
use drape::{
    glsl::Vec3,
    lanes::{F64, Part},
    scene::Filter,
    shader::sampler::{Sampler2d, Wrap, texture},
    texture::Texture,
};
use proptest::prelude::*;

pub(super) fn lanes<L: Part>(color: Vec3<L>) -> [f64; 3] {
    [color.x, color.y, color.z].map(|channel| channel.lane(0))
}

/// The bilinear formula in f64, with texel indices mapped by `index(i, size)`.
pub(super) fn bilinear(picture: &Texture, u: f64, v: f64, index: impl Fn(i64, i64) -> i64) -> [f64; 3] {
    let (w, h) = (picture.width() as i64, picture.height() as i64);
    let (x, y) = (u * w as f64 - 0.5, v * h as f64 - 0.5);
    let (i, j) = (x.floor(), y.floor());
    let (fx, fy) = (x - i, y - j);
    let texel = |di: i64, dj: i64, c: usize| {
        f64::from(picture.texel(index(i as i64 + di, w) as usize, index(j as i64 + dj, h) as usize)[c])
    };
    std::array::from_fn(|c| {
        (texel(0, 0, c) * (1.0 - fx) + texel(1, 0, c) * fx) * (1.0 - fy)
            + (texel(0, 1, c) * (1.0 - fx) + texel(1, 1, c) * fx) * fy
    })
}

fn repeat(i: i64, n: i64) -> i64 {
    ((i % n) + n) % n
}

pub(super) fn clamp_to_edge(i: i64, n: i64) -> i64 {
    i.max(0).min(n - 1)
}

pub(super) fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).fold(0.0, |largest, i| (a[i] - b[i]).abs().max(largest))
}

/// 2⁻²²
pub(super) const ROUNDING: f64 = 1.0 / 4_194_304.0;

/// Random, whole and half texels, in -1..=2.
fn coordinate() -> impl Strategy<Value = f32> {
    prop_oneof![-1.0..=2.0_f32, (-64..=128_i16).prop_map(|c| f32::from(c) / 64.0), -0.01..0.01_f32]
}

fn any_side() -> impl Strategy<Value = usize> {
    prop_oneof![1..=1024_usize, 1..=5_usize]
}

fn power_of_two() -> impl Strategy<Value = usize> {
    (0..=10_u32).prop_map(|bits| 1 << bits)
}

proptest! {
    #![proptest_config(cases(60))]

    /// The weights' error is that of u·w rounded to f32.
    #[test]
    fn bilinear_is_within_its_bound(
        size in (any_side(), any_side()),
        at in prop::collection::vec((coordinate(), coordinate()), 500),
        seed in any::<u64>(),
    ) {
        let picture = noise(size.0, size.1, seed);
        let sampler = Sampler2d { texture: &picture, filter: Filter::Bilinear, wrap_v: Wrap::Repeat };
        let bound = (size.0 + size.1 + 2) as f64 * ROUNDING;
        for (u, v) in at {
            let expected = bilinear(&picture, u.into(), v.into(), repeat);
            let error = distance(lanes(texture(sampler, [u, v])), expected);
            prop_assert!(error <= bound, "{} over {} at {}, {}", error, bound, u, v);
            let error = distance(lanes(texture(sampler, [u, v].map(F64::from))), expected);
            prop_assert!(error <= 1e-12, "{} in f64", error);
        }
    }

    /// From 0 on u·w - 0.5 is exact, and only the mixing rounds; nearest is exact everywhere.
    #[test]
    fn sides_of_powers_of_two_have_exact_weights(
        size in (power_of_two(), power_of_two()),
        at in prop::collection::vec((coordinate(), coordinate()), 500),
        seed in any::<u64>(),
    ) {
        let picture = noise(size.0, size.1, seed);
        let [smooth, nearest] =
            [Filter::Bilinear, Filter::Nearest].map(|filter| Sampler2d { texture: &picture, filter, wrap_v: Wrap::Repeat });
        for (u, v) in at {
            let (s, t) = (u.abs(), v.abs());
            let expected = bilinear(&picture, s.into(), t.into(), repeat);
            let error = distance(lanes(texture(smooth, [s, t])), expected);
            prop_assert!(error <= 2.0 * ROUNDING, "{} at {}, {}", error, s, t);
            let index = |c: f32, n: usize| repeat((f64::from(c) * n as f64).floor() as i64, n as i64) as usize;
            let [r, g, b, _] = picture.texel(index(u, size.0), index(v, size.1)).map(f64::from);
            prop_assert_eq!(lanes(texture(nearest, [u, v])), [r, g, b]);
        }
    }
}

#[test]
fn the_first_row_is_at_v_0_and_both_axes_repeat() {
    let [a, b, c, d, e, f] =
        [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.5; 3], [0.0; 3], [1.0; 3]];
    let picture = Texture::from_rgb(3, 2, &[a, b, c, d, e, f]).unwrap();
    let sampler = Sampler2d { texture: &picture, filter: Filter::Nearest, wrap_v: Wrap::Repeat };
    let at = |u: f32, v: f32| lanes(texture(sampler, [u, v])).map(|channel| channel as f32);
    assert_eq!([at(0.1, 0.2), at(0.5, 0.2), at(0.9, 0.2)], [a, b, c]);
    assert_eq!([at(0.1, 0.8), at(0.5, 0.8), at(0.9, 0.8)], [d, e, f]);
    assert_eq!([at(-0.1, 0.2), at(1.1, 0.2), at(-0.9, -0.8), at(0.5, -0.1)], [c, a, a, e]);
    assert_eq!([at(f32::NAN, f32::NAN), at(0.0, 0.0), at(1.0, 1.0)], [a, a, a]);
}
