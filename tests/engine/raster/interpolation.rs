//! Varyings are perspective-correct to 6·2⁻²⁴ of the largest corner value, and depth is linear in
//! the window to half an ulp.

use crate::support::{Canvas, Numbers, Picture, Vertex, cases, varyings, window};
use proptest::prelude::*;

const CANVAS: Canvas = Canvas::new(64, 64);

/// Half the distance from 1 to the next f32: the largest relative error of one rounding.
const U: f64 = 1.0 / 16_777_216.0;

/// Window position, depth and 1/w of the corners, as the definition gives them in f32.
type Corners = [[f64; 4]; 3];

fn corners(vertices: &[Vertex; 3]) -> Corners {
    vertices.map(|vertex| window(vertex.clip, CANVAS).map(f64::from))
}

fn area([a, b, c]: Corners) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])
}

/// Barycentric coordinates of a window position, as ratios of areas.
fn barycentric(corners: Corners, [x, y]: [f64; 2]) -> [f64; 3] {
    let p = [x, y, 0.0, 0.0];
    let [a, b, c] = corners;
    [[p, b, c], [a, p, c], [a, b, p]].map(|part| area(part) / area(corners))
}

/// Σ lᵢrᵢaᵢ / Σ lᵢrᵢ in f64.
fn perspective(l: [f64; 3], corners: Corners, values: [f64; 3]) -> f64 {
    let weights: [f64; 3] = std::array::from_fn(|i| l[i] * corners[i][3]);
    let sum: f64 = weights.iter().sum();
    (0..3).map(|i| weights[i] * values[i]).sum::<f64>() / sum
}

/// Centres of the pixels that a picture of one tile shows, y up, in the order of shading.
fn centres(picture: &Picture) -> Vec<[f64; 2]> {
    let centre = |[x, y]: [u32; 2]| [f64::from(x) + 0.5, f64::from(CANVAS.height - y) - 0.5];
    CANVAS.pixels().zip(&picture.ids).filter(|&(_, &id)| id != 0).map(|(pixel, _)| centre(pixel)).collect()
}

fn value() -> impl Strategy<Value = f32> {
    prop_oneof![-1.0..=1.0_f32, -1e6..=1e6_f32, Just(0.0), Just(1.0)]
}

fn vertex() -> impl Strategy<Value = Vertex> {
    let ndc = || -1.0..=1.0_f32;
    (ndc(), ndc(), ndc(), 0.2..4.0_f32, prop::array::uniform3(value()))
        .prop_map(|(x, y, z, w, varyings)| Vertex { clip: [x * w, y * w, z * w, w], varyings })
}

/// Triangles inside of the picture, at least half a pixel in area.
fn triangle() -> impl Strategy<Value = [Vertex; 3]> {
    prop::array::uniform3(vertex()).prop_filter("a sliver", |vertices| area(corners(vertices)).abs() > 1.0)
}

fn largest(values: [f64; 3]) -> f64 {
    values.into_iter().fold(0.0, |largest, value| value.abs().max(largest))
}

/// The largest error of a varying in one triangle, in units of 2⁻²⁴ of the largest corner value,
/// divided by κ² with κ = Σ|lᵢrᵢ| / |Σ lᵢrᵢ|, which is 1 inside and grows outside of the corners.
fn worst_error(numbers: Numbers, vertices: &[Vertex; 3], unit: f64) -> f64 {
    let (seen, picture) = varyings(numbers, CANVAS, vertices, &[[0, 1, 2]]);
    let corners = corners(vertices);
    let mut worst: f64 = 0.0;
    for (seen, centre) in seen.iter().zip(centres(&picture)) {
        let l = barycentric(corners, centre);
        let weights = [0, 1, 2].map(|i| l[i] * corners[i][3]);
        let kappa = weights.iter().map(|w| w.abs()).sum::<f64>() / weights.iter().sum::<f64>().abs();
        for (k, seen) in seen.iter().enumerate() {
            let values = vertices.map(|vertex| f64::from(vertex.varyings[k]));
            let error = (seen - perspective(l, corners, values)).abs();
            worst = worst.max(error / (unit * largest(values).max(f64::MIN_POSITIVE) * kappa * kappa));
        }
    }
    worst
}

proptest! {
    #![proptest_config(cases(1500))]

    #[test]
    fn varyings_are_within_six_roundings(vertices in triangle()) {
        let worst = worst_error(Numbers::Vectors, &vertices, U);
        prop_assert!(worst <= 6.0, "{} roundings", worst);
    }

    /// The same program in f64 lanes has only the roundings of f64, its own and the oracle's: over
    /// areas from 1/2 to 4096 pixels they are some 2⁻⁵³·4096.
    #[test]
    fn in_f64_lanes_varyings_have_no_other_error(vertices in triangle()) {
        let worst = worst_error(Numbers::F64, &vertices, U * U * 128.0);
        prop_assert!(worst <= 1.0, "{} times 2^-41", worst);
    }

    /// The plane through the unsnapped corners, rounded once.
    #[test]
    fn depth_is_linear_in_the_window(vertices in triangle()) {
        let (_, picture) = varyings(Numbers::F32, CANVAS, &vertices, &[[0, 1, 2]]);
        let corners = corners(&vertices);
        let depths = picture.depth.iter().zip(&picture.ids).filter(|&(_, &id)| id != 0);
        for (centre, (&depth, _)) in centres(&picture).into_iter().zip(depths) {
            let l = barycentric(corners, centre);
            let exact = (0..3).map(|i| l[i] * corners[i][2]).sum::<f64>().max(0.0);
            let ulp = f64::from(depth.next_up() - depth);
            prop_assert!((f64::from(depth) - exact).abs() <= 0.5001 * ulp + 1e-13, "{} for {}", depth, exact);
        }
    }

    /// By projective geometry from clip space, without window positions: the ray through a pixel
    /// meets the triangle where its three determinants say. Window positions are rounded to f32,
    /// so the bound is that of a point moved by 2⁻¹⁹ pixel; corners may also be clipped.
    #[test]
    fn varyings_are_those_of_the_point_that_is_seen(
        mut vertices in prop::array::uniform3(vertex()),
        beyond in prop::array::uniform3(prop::array::uniform2(1.0..3.0_f32)),
    ) {
        for (vertex, by) in vertices.iter_mut().zip(beyond) {
            (vertex.clip[0], vertex.clip[1]) = (vertex.clip[0] * by[0], vertex.clip[1] * by[1]);
        }
        let clip = vertices.map(|vertex| vertex.clip.map(f64::from));
        let at = |[x, y]: [f64; 2]| [(x - 32.0) / 32.0, (y - 32.0) / 32.0, 0.0, 1.0];
        let volume = determinant(clip);
        prop_assume!(volume.abs() > 0.05);
        let (seen, picture) = varyings(Numbers::Vectors, CANVAS, &vertices, &[[0, 1, 2]]);
        for (seen, centre) in seen.iter().zip(centres(&picture)) {
            let weights = |p: [f64; 4]| {
                let [a, b, c] = clip;
                [[p, b, c], [a, p, c], [a, b, p]].map(determinant)
            };
            let value = |centre: [f64; 2], values: [f64; 3]| {
                let w = weights(at(centre));
                (0..3).map(|i| w[i] * values[i]).sum::<f64>() / w.iter().sum::<f64>()
            };
            for (k, seen) in seen.iter().enumerate() {
                let values = vertices.map(|vertex| f64::from(vertex.varyings[k]));
                let exact = value(centre, values);
                let step = 1.0 / 1024.0;
                let slope = [[step, 0.0], [0.0, step]]
                    .map(|[dx, dy]| (value([centre[0] + dx, centre[1] + dy], values) - exact).abs() / step);
                let bound = 1e-5 * largest(values) + (slope[0] + slope[1]) / 65_536.0;
                prop_assert!((seen - exact).abs() <= bound, "{} for {} ± {}", seen, exact, bound);
            }
        }
    }
}

/// The determinant of three positions over x, y and w.
fn determinant([a, b, c]: [[f64; 4]; 3]) -> f64 {
    let [a, b, c] = [a, b, c].map(|[x, y, _, w]| [x, y, w]);
    a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
        + a[2] * (b[0] * c[1] - b[1] * c[0])
}

/// Halfway in the window between w = 1 and w = 3, a varying has gone a quarter of its way, not half.
#[test]
fn perspective_is_not_affine() {
    let at =
        |x: f32, y: f32, w: f32, value: f32| Vertex { clip: [x * w, y * w, 0.0, w], varyings: [value; 3] };
    let vertices =
        [at(-1.0, -1.0, 1.0, 0.0), at(1.0, -1.0, 3.0, 1.0), at(-1.0, 1.0, 1.0, 0.0), at(1.0, 1.0, 3.0, 1.0)];
    let (seen, picture) = varyings(Numbers::F64, Canvas::new(63, 63), &vertices, &[[0, 1, 2], [2, 1, 3]]);
    assert_eq!(picture.stats.fragments, 63 * 63);
    for row in seen.chunks(63) {
        assert!((row[31][0] - 0.25).abs() < 1e-6, "{}", row[31][0]);
    }
}
