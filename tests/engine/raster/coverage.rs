//! The rasteriser covers exactly the pixels whose centres lie inside the snapped triangle, and
//! triangles that share an edge share no pixel and leave none out.

#![expect(clippy::cast_possible_truncation, reason = "window positions are small")]

use crate::support::{
    Canvas, cases,
    coverage::{Point, SUBPIXELS, area, covered, snapped},
    rows,
};
use proptest::prelude::*;

/// Positions are given in 1/4096 pixel: sixteen times finer than the snapping grid.
const FINE: i32 = 4096;

/// Corners in 1/4096 pixel, x right, y up.
type Corners = [[i32; 2]; 3];

const ORDERS: [[usize; 3]; 6] = [[0, 1, 2], [1, 2, 0], [2, 0, 1], [0, 2, 1], [2, 1, 0], [1, 0, 2]];

/// The clip-space position of a window position. Exact, since both sides are powers of two.
fn clip([x, y]: [i32; 2], canvas: Canvas) -> [f32; 4] {
    let ndc = |c: i32, extent: u32| {
        let half = extent as i32 * FINE / 2;
        (c - half) as f32 / half as f32
    };
    [ndc(x, canvas.width), ndc(y, canvas.height), 0.0, 1.0]
}

/// The window position on the snapping grid, in integers: rounded half to even.
fn snap(position: [i32; 2]) -> Point {
    position.map(|c| {
        let (floor, rest) = (c.div_euclid(16), c.rem_euclid(16));
        let up = rest > 8 || (rest == 8 && floor % 2 != 0);
        i128::from(floor + i32::from(up))
    })
}

fn drawn(corners: Corners, canvas: Canvas) -> Vec<bool> {
    let picture = canvas.triangle(corners.map(|corner| clip(corner, canvas)));
    picture.ids.iter().map(|&id| id != 0).collect()
}

/// One coordinate in a picture 64 pixels wide, of all the kinds that a rule could treat apart.
fn coordinate() -> impl Strategy<Value = i32> {
    prop_oneof![
        0..=64 * FINE,
        (0..=64 * 256).prop_map(|c| c * 16),
        (0..64 * 256).prop_map(|c| c * 16 + 8),
        (0..64).prop_map(|c| c * FINE + FINE / 2),
        (0..=64).prop_map(|c| c * FINE),
    ]
}

fn anywhere() -> impl Strategy<Value = Corners> {
    prop::array::uniform3(prop::array::uniform2(coordinate()))
}

/// The third corner a few grid steps from the line through the others.
fn sliver() -> impl Strategy<Value = Corners> {
    let step = prop::array::uniform2(-40..=40_i32);
    (anywhere(), 0..=64_i32, step).prop_map(|([a, b, _], part, step)| {
        let near = |i: usize| (a[i] + (b[i] - a[i]) / 64 * part + step[i]).clamp(0, 64 * FINE);
        [a, b, [near(0), near(1)]]
    })
}

/// At most a pixel or so wide.
fn subpixel() -> impl Strategy<Value = Corners> {
    let step = prop::array::uniform2(-FINE..=FINE);
    (prop::array::uniform2(FINE..63 * FINE), step.clone(), step)
        .prop_map(|(a, b, c)| [a, [a[0] + b[0], a[1] + b[1]], [a[0] + c[0], a[1] + c[1]]])
}

fn mirrored([x, y]: [i32; 2], axes: [bool; 2]) -> [i32; 2] {
    let mirror = |c: i32, mirrored: bool| if mirrored { 64 * FINE - c } else { c };
    [mirror(x, axes[0]), mirror(y, axes[1])]
}

proptest! {
    #![proptest_config(cases(1500))]

    #[test]
    fn every_pixel_is_as_the_oracle_says(
        corners in prop_oneof![anywhere(), sliver(), subpixel()],
        mirror in any::<[bool; 2]>(),
    ) {
        let canvas = Canvas::new(64, 64);
        let corners = corners.map(|corner| mirrored(corner, mirror));
        let expected = covered(corners.map(snap), canvas);
        for order in ORDERS {
            prop_assert_eq!(&drawn(order.map(|i| corners[i]), canvas), &expected, "order {:?}", order);
        }
    }
}

proptest! {
    #![proptest_config(cases(200))]

    /// Several tiles, none of them full, and corners with any w: the oracle snaps by the definition
    /// of window positions. What is counted is what is in the picture.
    #[test]
    fn pictures_of_any_size_and_corners_of_any_w(
        size in prop::array::uniform2(1..200_u32),
        corners in prop::array::uniform3((-1.0..=1.0_f32, -1.0..=1.0_f32, 0.1..16.0_f32)),
    ) {
        let canvas = Canvas::new(size[0], size[1]);
        let corners = corners.map(|(x, y, w)| [x * w, y * w, 0.0, w]);
        let expected = covered(corners.map(|corner| snapped(corner, canvas)), canvas);
        let picture = canvas.triangle(corners);
        let drawn: Vec<bool> = picture.ids.iter().map(|&id| id != 0).collect();
        prop_assert_eq!(&drawn, &expected);
        let count = expected.iter().filter(|&&covered| covered).count() as u64;
        prop_assert_eq!((picture.stats.covered, picture.stats.fragments), (count, count));
    }

    #[test]
    fn the_spokes_of_a_fan_are_seamless(
        centre in prop::array::uniform2(coordinate().prop_filter("on the rim", |c| *c % (64 * FINE) != 0)),
        rim in prop::collection::btree_set(0..256 * FINE, 1..20),
    ) {
        // The rim runs once around the picture; a fan of all of it covers every pixel.
        let mut rim: Vec<i32> = rim.into_iter().chain((0..4).map(|side| side * 64 * FINE)).collect();
        rim.sort_unstable();
        rim.dedup();
        let on_rim = |at: i32| match (at / (64 * FINE), at % (64 * FINE)) {
            (0, c) => [c, 0],
            (1, c) => [64 * FINE, c],
            (2, c) => [64 * FINE - c, 64 * FINE],
            (_, c) => [0, 64 * FINE - c],
        };
        let next = rim.iter().cycle().skip(1);
        let fan: Vec<Corners> = rim.iter().zip(next).map(|(&a, &b)| [centre, on_rim(a), on_rim(b)]).collect();
        assert_exactly_once(&fan)?;
    }

    #[test]
    fn the_steps_of_a_strip_are_seamless(
        steps in prop::collection::vec((any::<bool>(), step()), 1..20),
    ) {
        let right = 64 * FINE;
        let (mut bottom, mut top, mut strip) = (0, 0, Vec::new());
        for (at_top, step) in steps.into_iter().chain([(true, right), (false, right)]) {
            let side = if at_top { &mut top } else { &mut bottom };
            let before = *side;
            *side = (before + step).min(right);
            let (side, y) = (*side, if at_top { right } else { 0 });
            strip.push([[before, y], [side, y], if at_top { [bottom, 0] } else { [top, right] }]);
        }
        assert_exactly_once(&strip)?;
    }

    #[test]
    fn the_cells_of_a_grid_are_seamless(
        jitter in prop::collection::vec(prop::array::uniform2(-FINE..=FINE), 49),
        split in prop::collection::vec(any::<bool>(), 64),
    ) {
        // Inner points of a grid of 8 × 8 cells move by up to a pixel of the eight between them.
        let point = |i: usize, j: usize| {
            let inner = (1..8).contains(&i) && (1..8).contains(&j);
            let [dx, dy] = if inner { jitter[(j - 1) * 7 + i - 1] } else { [0, 0] };
            [i as i32 * 8 * FINE + dx, j as i32 * 8 * FINE + dy]
        };
        let cells = (0..64).flat_map(|cell| {
            let (i, j) = (cell % 8, cell / 8);
            let [a, b, c, d] = [point(i, j), point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)];
            if split[cell] { [[a, b, c], [c, d, a]] } else { [[b, c, d], [b, a, d]] }
        });
        assert_exactly_once(&cells.collect::<Vec<_>>())?;
    }
}

/// Up to twelve pixels, often whole or half ones.
fn step() -> impl Strategy<Value = i32> {
    prop_oneof![1..12 * FINE, (1..24).prop_map(|halves| halves * FINE / 2)]
}

/// Draws each triangle alone: the counts are 1 in every pixel.
fn assert_exactly_once(triangles: &[Corners]) -> Result<(), TestCaseError> {
    let canvas = Canvas::new(64, 64);
    let mut counts = vec![0; 64 * 64];
    for &triangle in triangles {
        for (count, drawn) in counts.iter_mut().zip(drawn(triangle, canvas)) {
            *count += i32::from(drawn);
        }
    }
    prop_assert!(counts.iter().all(|&count| count == 1), "counts {counts:?} of {triangles:?}");
    Ok(())
}

#[test]
fn corners_without_an_area_draw_nothing_and_are_counted() {
    let canvas = Canvas::new(64, 64);
    let point = [20 * FINE + 5, 30 * FINE];
    let line = [0, 16, 48].map(|i| [20 * FINE + 7 * i, 30 * FINE + 3 * i]);
    for corners in [[point; 3], [point, point, [0, 0]], line] {
        let snapped_area = area(corners.map(snap));
        let picture = canvas.triangle(corners.map(|corner| clip(corner, canvas)));
        assert_eq!((snapped_area, picture.stats.degenerate, picture.stats.covered), (0, 1, 0));
    }
}

#[test]
fn a_sample_on_a_left_or_bottom_edge_is_inside_and_on_no_other() {
    // A square whose sides run through pixel centres: rows from the top, as in the picture.
    let canvas = Canvas::new(8, 8);
    let at = |c: i32| c * FINE + FINE / 2;
    let [a, b, c, d] = [[at(2), at(2)], [at(5), at(2)], [at(5), at(5)], [at(2), at(5)]];
    let corners = [a, b, c, d].map(|corner| clip(corner, canvas));
    let picture = canvas.triangles(&corners, &[[0, 1, 2], [2, 3, 0]]);
    let expected =
        ["........", "........", "........", "..###...", "..###...", "..###...", "........", "........"];
    assert_eq!(rows(canvas, &picture), expected);
}

#[test]
fn the_oracle_knows_its_grid() {
    assert_eq!(snap([24, 40]), [2, 2]);
    assert_eq!(snap([-24, 8]), [-2, 0]);
    assert_eq!(
        snapped(clip([FINE, 2 * FINE], Canvas::new(8, 8)), Canvas::new(8, 8)),
        [SUBPIXELS, 2 * SUBPIXELS]
    );
}
