//! With 4, 8 and 16 samples, coverage and depth are decided per sample at the standard positions,
//! a primitive is shaded once a pixel, and pictures approach the true coverage.

#![expect(clippy::unwrap_used, reason = "a helper that fails is a test that fails")]
#![expect(clippy::cast_possible_truncation, reason = "colours and positions are small")]

use std::sync::Mutex;

use crate::support::{
    Canvas, Picture, Record, Vertex, cases,
    coverage::{Point, covers, sample, snapped},
    flat, program, window,
};
use drape::raster::{DrawCall, Primitives};
use proptest::prelude::*;

const CANVAS: Canvas = Canvas::new(32, 32);

/// The standard positions of Direct3D 11 as its specification prints them: from the pixel's
/// centre, in 1/16 pixel, x right and y down.
fn standard(samples: u32) -> &'static [[i32; 2]] {
    match samples {
        1 => &[[0, 0]],
        4 => &[[-2, -6], [6, -2], [-6, 2], [2, 6]],
        8 => &[[1, -3], [-1, 3], [5, 1], [-3, -5], [-5, 5], [-7, -1], [3, 7], [7, -7]],
        _ => &[
            [1, 1],
            [-1, -3],
            [-3, 2],
            [4, -1],
            [-5, -2],
            [2, 5],
            [5, 3],
            [3, -5],
            [-2, 6],
            [0, -7],
            [-4, -6],
            [-6, 4],
            [-8, 0],
            [7, -4],
            [6, 7],
            [-7, -8],
        ],
    }
}

/// The samples of a pixel in 1/256 pixel, y up.
fn samples_of(pixel: [u32; 2], samples: u32) -> Vec<Point> {
    let offset = |position: &[i32; 2]| position.map(|c| u32::try_from(c + 8).unwrap());
    standard(samples).iter().map(|position| sample(pixel, offset(position), CANVAS)).collect()
}

/// How many of the samples see each of the three channels of a pixel of full colours.
fn seen(color: [u8; 3], samples: u32) -> [u32; 3] {
    color.map(|c| {
        let count = f64::from(c) * f64::from(samples) / 255.0;
        assert!((count - count.round()).abs() < 0.1, "{c} is no whole number of samples");
        count.round() as u32
    })
}

/// Inside of the view volume, at different depths.
fn position() -> impl Strategy<Value = [f32; 4]> {
    let grid = (-16..=16_i8).prop_map(|c| f32::from(c) / 16.0);
    let c = || prop_oneof![-1.0..=1.0_f32, grid.clone()];
    (c(), c(), -1.0..0.99_f32).prop_map(|(x, y, z)| [x, y, z, 1.0])
}

fn count() -> impl Strategy<Value = u32> {
    prop::sample::select(vec![1_u32, 4, 8, 16])
}

/// Window depth of a triangle at a point in 1/256 pixel.
fn depth(triangle: &[[f32; 4]], p: Point) -> f64 {
    let corners: Vec<[f64; 3]> = triangle
        .iter()
        .map(|&corner| window(corner, CANVAS).map(f64::from))
        .map(|[x, y, z, _]| [x, y, z])
        .collect();
    let p = [p[0] as f64 / 256.0, p[1] as f64 / 256.0];
    let area =
        |a: &[f64], b: &[f64], c: &[f64]| (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
    let [a, b, c] = [&corners[0], &corners[1], &corners[2]];
    let l = [area(&p, b, c), area(a, &p, c), area(a, b, &p)];
    (0..3).map(|i| l[i] * corners[i][2]).sum::<f64>() / area(a, b, c)
}

proptest! {
    #![proptest_config(cases(400))]

    /// A red and a green triangle, which may cross: each sample sees the nearer one at that sample.
    #[test]
    fn every_sample_is_as_the_oracle_says(
        corners in prop::array::uniform6(position()),
        samples in count(),
    ) {
        let canvas = CANVAS.samples(samples);
        let (red, green) = corners.split_at(3);
        let picture = canvas.draw(&[
            flat(Primitives::Triangles(&[[0, 1, 2]]), red, [1.0, 0.0, 0.0]),
            flat(Primitives::Triangles(&[[0, 1, 2]]), green, [0.0, 1.0, 0.0]),
        ]);
        let snap = |triangle: &[[f32; 4]]| [0, 1, 2].map(|i| snapped(triangle[i], CANVAS));
        let (red_snapped, green_snapped) = (snap(red), snap(green));
        let (mut fragments, mut covered) = (0, 0);
        for (pixel, &color) in CANVAS.pixels().zip(&picture.rgb) {
            let (mut expected, mut ties) = ([0; 3], 0);
            for p in samples_of(pixel, samples) {
                match (covers(red_snapped, p), covers(green_snapped, p)) {
                    (true, true) => {
                        let nearer = depth(red, p) - depth(green, p);
                        ties += u32::from(nearer.abs() < 1e-6);
                        expected[usize::from(nearer > 0.0)] += 1;
                    }
                    (is_red, is_green) => {
                        expected[0] += u32::from(is_red);
                        expected[1] += u32::from(is_green);
                    }
                }
            }
            let seen = seen(color, samples);
            prop_assert!(seen == expected || ties > 0, "{:?}: {:?} for {:?}", pixel, seen, expected);
            fragments += seen.iter().filter(|&&count| count > 0).count() as u64;
            covered += u64::from(seen != [0; 3]);
        }
        prop_assert_eq!((picture.stats.fragments, picture.stats.covered), (fragments, covered));
    }
}

/// The fragment program is run once a pixel and triangle: with the varyings at the pixel's centre if all samples
/// are covered, else at the first sample that is.
#[test]
fn a_primitive_is_shaded_once_a_pixel_inside_of_it() {
    let vertex = |x: f32, y: f32| Vertex { clip: [x, y, 0.0, 1.0], varyings: [(x + 1.0) * 16.0, 0.0, 0.0] };
    let vertices = [vertex(-0.9, -0.8), vertex(0.95, -0.3), vertex(-0.2, 0.9)];
    for samples in [1, 4, 8, 16] {
        let runs = Mutex::new(Vec::new());
        let call = DrawCall::one_by_one::<f32, _, _, 3>(
            Primitives::Triangles(&[[0, 1, 2]]),
            3,
            |i| vertices[i],
            program,
            Record(&runs),
        );
        let picture = CANVAS.samples(samples).draw(&[call]);
        let shown = picture.rgb.iter().filter(|&&color| color != [0; 3]).count() as u64;
        assert!(shown > 300, "{shown} pixels");
        assert_eq!(picture.stats.fragments, shown, "{samples} samples");
        let runs = runs.into_inner().unwrap();
        let triangle = [0, 1, 2].map(|i| snapped(vertices[i].clip, CANVAS));
        // Pixels whose samples agree have runs of their own; both are filled up to whole blocks of eight.
        let agrees =
            |pixel: &[u32; 2]| samples_of(*pixel, samples).iter().all(|&point| covers(triangle, point));
        let agreeing = CANVAS.pixels().filter(agrees).count() as u64;
        let filled = agreeing.next_multiple_of(8) + (shown - agreeing).next_multiple_of(8);
        assert_eq!(runs.len() as u64, filled, "{samples} samples");
        let mut expected: Vec<f64> = CANVAS
            .pixels()
            .filter_map(|pixel| {
                let points = samples_of(pixel, samples);
                let first = points.iter().find(|&&point| covers(triangle, point))?;
                let all = points.iter().all(|&point| covers(triangle, point));
                Some(if all { f64::from(pixel[0]) + 0.5 } else { first[0] as f64 / 256.0 })
            })
            .collect();
        // Some fragments are repeated to fill up a block.
        let mut found: Vec<f64> = runs.iter().map(|&[x, ..]| x).collect();
        [&mut expected, &mut found].into_iter().for_each(|places| places.sort_by(f64::total_cmp));
        let missing = |of: &[f64], places: &[f64]| {
            of.iter().filter(|&x| !places.iter().any(|place| (x - place).abs() < 1e-4)).count()
        };
        assert_eq!((missing(&expected, &found), missing(&found, &expected)), (0, 0), "{samples} samples");
        let off_centre = expected.iter().filter(|x| (*x - x.floor() - 0.5).abs() > 1e-4).count();
        assert!(if samples == 1 { off_centre == 0 } else { off_centre > 30 }, "{off_centre}");
    }
}

proptest! {
    #![proptest_config(cases(300))]

    /// What is interpolated never leaves the range of the corners, however narrow the triangle: no white fringe on
    /// black.
    #[test]
    fn nothing_is_taken_from_beyond_an_edge(
        corners in prop::array::uniform3(position()), w in prop::array::uniform3(0.2..5.0_f32), samples in count(),
    ) {
        let vertex = |i: usize| {
            let [x, y, z, _] = corners[i];
            Vertex { clip: [x * w[i], y * w[i], z * w[i], w[i]], varyings: [[0.0, 0.5, 1.0][i], 0.0, 0.0] }
        };
        let runs = Mutex::new(Vec::new());
        let triangles = Primitives::Triangles(&[[0, 1, 2]]);
        let call = DrawCall::one_by_one::<f32, _, _, 3>(triangles, 3, vertex, program, Record(&runs));
        let _ = CANVAS.samples(samples).draw(&[call]);
        // Snapping to 1/256 pixel covers samples that far beyond the edge.
        let window = [0, 1, 2].map(|i| window(vertex(i).clip, CANVAS).map(f64::from));
        let side = |i: usize| [0, 1].map(|k| window[(i + 1) % 3][k] - window[i][k]);
        let area = (side(0)[0] * side(1)[1] - side(0)[1] * side(1)[0]).abs();
        let longest = (0..3).map(|i| side(i).map(|c| c * c).iter().sum::<f64>().sqrt()).fold(0.0, f64::max);
        let ratio = f64::from(w.into_iter().fold(0.0, f32::max) / w.into_iter().fold(9.0, f32::min));
        let beyond = ratio * longest / area / 128.0 + 1e-5;
        for [value, ..] in runs.into_inner().unwrap() {
            prop_assert!(value > -beyond && value < 1.0 + beyond, "{value}, {beyond} at most, {samples} samples");
        }
    }
}

/// The mean of the clamped linear colours, rounded half to even, over the background.
#[test]
fn a_pixel_is_the_mean_of_its_samples() {
    // Left of x = 1/2 of a pixel column: half of the samples of 4, 8 and 16 lie there.
    let half = [
        [-1.0, -1.0, 0.0, 1.0],
        [1.0 / 32.0, -1.0, 0.0, 1.0],
        [1.0 / 32.0, 1.0, 0.0, 1.0],
        [-1.0, 1.0, 0.0, 1.0],
    ];
    for samples in [4_u32, 8, 16] {
        let left = standard(samples).iter().filter(|position| position[0] < 0).count();
        let share = left as f32 / samples as f32;
        let quad = Primitives::Triangles(&[[0, 1, 2], [2, 3, 0]]);
        let picture = CANVAS.samples(samples).draw(&[flat(quad, &half, [0.75, 7.0, -3.0])]);
        let expected = [0.75 * share, share, 0.0].map(|c| (255.0 * c).round_ties_even() as u8);
        // The uppermost samples of the first row lie on the picture's border.
        for (pixel, color) in CANVAS.pixels().zip(&picture.rgb).filter(|([x, y], _)| *x == 16 && *y > 0) {
            assert_eq!(*color, expected, "{samples} samples, pixel {pixel:?}");
        }
    }
}

/// Mean colour of a picture in 0..=1.
fn mean(picture: &Picture) -> f64 {
    picture.rgb.iter().map(|color| f64::from(color[0]) / 255.0).sum::<f64>() / picture.rgb.len() as f64
}

/// The root mean square error of the area of 25 discs falls with the number of samples.
#[test]
fn more_samples_come_closer_to_the_area_of_a_disc() {
    let corner = |i: u32, [x, y]: [f64; 2]| {
        let (sin, cos) = drape::math::sin_cos_degrees(f64::from(i) * 360.0 / 512.0);
        [0.7 * cos + x, 0.7 * sin + y, 0.0, 1.0].map(|c| c as f32)
    };
    let area = std::f64::consts::PI * 0.49 / 4.0;
    let fan: Vec<[u32; 3]> = (1..511).map(|i| [0, i, i + 1]).collect();
    let errors = [1, 4, 8, 16].map(|samples| {
        let square = |i: u32| {
            let centre = [i % 5, i / 5].map(|k| f64::from(k) * 0.0271 - 0.05);
            let corners: Vec<[f32; 4]> = (0..512).map(|i| corner(i, centre)).collect();
            let error = mean(&CANVAS.samples(samples).triangles(&corners, &fan)) - area;
            error * error
        };
        ((0..25).map(square).sum::<f64>() / 25.0).sqrt()
    });
    println!("{errors:?}");
    assert!(errors[0] < 5e-3 && errors[3] < 5e-4, "{errors:?}");
    assert!(errors.is_sorted_by(|less, more| more < less), "{errors:?}");
}

/// The root mean square error of the pixels on the edge of half planes at 90 angles falls with the
/// number of samples.
#[test]
fn more_samples_come_closer_to_the_area_of_a_half_plane() {
    let errors = [1_u32, 4, 8, 16].map(|samples| {
        let (mut sum, mut pixels) = (0.0, 0);
        for degrees in 0..90 {
            let (sin, cos) = drape::math::sin_cos_degrees(f64::from(degrees) * 4.0 + 1.3);
            // Everything on the left of a line through the middle of the picture.
            let at = |along: f64, left: f64| {
                [along * cos - left * sin, along * sin + left * cos].map(|c| c as f32)
            };
            let corners = [at(-9.0, 0.0), at(9.0, 0.0), at(0.0, 9.0)].map(|[x, y]| [x, y, 0.0, 1.0]);
            let picture = CANVAS.samples(samples).triangle(corners);
            for ([column, row], color) in CANVAS.pixels().zip(&picture.rgb) {
                let middle = [f64::from(column) - 15.5, 15.5 - f64::from(row)];
                let distance = middle[1] * cos - middle[0] * sin;
                if distance.abs() < 0.5 * (sin.abs() + cos.abs()) {
                    let error = f64::from(color[0]) / 255.0 - half_plane(distance, [sin.abs(), cos.abs()]);
                    sum += error * error;
                    pixels += 1;
                }
            }
        }
        (sum / f64::from(pixels)).sqrt()
    });
    println!("{errors:?}");
    for (pair, factor) in errors.windows(2).zip([0.5, 0.7, 0.8]) {
        assert!(pair[1] < pair[0] * factor, "{errors:?}");
    }
}

/// The area of a unit square that lies within `distance` of its centre along the unit normal whose
/// components have the sizes `n`: the integral of the box's trapezium profile.
fn half_plane(distance: f64, n: [f64; 2]) -> f64 {
    let (small, large) = (n[0].min(n[1]), n[0].max(n[1]));
    let (inner, outer) = ((large - small) / 2.0, (large + small) / 2.0);
    let d = distance.abs();
    let half = if d <= inner { d / large } else { 0.5 - (outer - d) * (outer - d) / (2.0 * small * large) };
    0.5 + half.copysign(distance)
}
