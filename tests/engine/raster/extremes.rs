//! No clip-space coordinate makes the rasteriser panic or draw nonsense: what has no finite place
//! in the window is dropped and counted, and every depth stays between 0 and 1.

use crate::support::{Canvas, Picture, cases, flat};
use drape::raster::{Primitives, Stats};
use proptest::prelude::*;

const CANVAS: Canvas = Canvas::new(40, 40);

fn line(ends: [[f32; 4]; 2]) -> Picture {
    CANVAS.draw(&[flat(Primitives::Lines(&[[0, 1]]), &ends, [1.0; 3])])
}

/// Any bits at all, huge, tiny and ordinary numbers.
fn coordinate() -> impl Strategy<Value = f32> {
    let any = any::<u32>().prop_map(f32::from_bits);
    let special = prop::sample::select(vec![
        0.0,
        -0.0,
        1.0,
        -1.0,
        1e30,
        -1e30,
        f32::MAX,
        f32::MIN,
        1e-30,
        f32::MIN_POSITIVE,
        1e-45,
        -1e-45,
        f32::NAN,
        f32::INFINITY,
        f32::NEG_INFINITY,
    ]);
    prop_oneof![1 => any, 1 => special, 6 => -2.0..2.0_f32]
}

fn position() -> impl Strategy<Value = [f32; 4]> {
    let w = prop_oneof![3 => 0.01..4.0_f32, 1 => coordinate()];
    (coordinate(), coordinate(), coordinate(), w).prop_map(|(x, y, z, w)| [x, y, z, w])
}

/// What must hold for one primitive, whatever it is.
fn check(picture: &Picture, positions: &[[f32; 4]]) -> Result<(), TestCaseError> {
    let Stats { outside, non_finite, degenerate, no_sample, drawn, covered, fragments, .. } = picture.stats;
    prop_assert!(picture.depth.iter().all(|depth| (0.0..=1.0).contains(depth)), "{:?}", picture.stats);
    prop_assert!(
        outside + non_finite + degenerate + no_sample + drawn >= 1,
        "uncounted: {:?}",
        picture.stats
    );
    if !positions.as_flattened().iter().all(|c| c.is_finite()) {
        prop_assert_eq!((non_finite, drawn), (1, 0));
    }
    let shown = picture.ids.iter().filter(|&&id| id == 1 << 24 | 1).count() as u64;
    prop_assert_eq!((covered, fragments), (shown, shown));
    prop_assert!(drawn > 0 || shown == 0);
    Ok(())
}

proptest! {
    #![proptest_config(cases(20_000))]

    #[test]
    fn any_triangle(corners in prop::array::uniform3(position())) {
        check(&CANVAS.triangle(corners), &corners)?;
    }

    #[test]
    fn any_line(ends in prop::array::uniform2(position())) {
        check(&line(ends), &ends)?;
    }
}

/// A triangle that fills the picture, one coordinate of it replaced.
#[test]
fn one_bad_coordinate_of_one_corner_is_enough() {
    let full = [[-1.0, -1.0, 0.0, 1.0], [3.0, -1.0, 0.0, 1.0], [-1.0, 3.0, 0.0, 1.0]];
    assert_eq!(CANVAS.triangle(full).stats.covered, 1600);
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        for (corner, axis) in (0..3).flat_map(|corner| (0..4).map(move |axis| (corner, axis))) {
            let mut corners: [[f32; 4]; 3] = full;
            corners[corner][axis] = bad;
            let stats = CANVAS.triangle(corners).stats;
            assert_eq!((stats.non_finite, stats.covered), (1, 0), "{bad} at {corner}, {axis}");
        }
    }
}

/// Up to 2^32 a corner is clipped like any other; beyond it is dropped, as f64 cannot place the cut.
#[test]
fn corners_far_away_are_clipped_and_those_at_1e30_dropped() {
    for (far, covered) in [(4e9, 1600), (1e30, 0)] {
        let dropped = u64::from(covered == 0);
        let corners = [[-far, -far, 0.0, 1.0], [far, -far, 0.0, 1.0], [0.0, far, 0.0, 1.0]];
        let stats = CANVAS.triangle(corners).stats;
        assert_eq!((stats.covered, stats.clipped, stats.non_finite), (covered, 1 - dropped, dropped));
        let stats = line([[-far, 1e-6, 0.0, 1.0], [far, 1e-6, 0.0, 1.0]]).stats;
        assert_eq!((stats.covered, stats.non_finite), (covered / 40, dropped));
    }
}

#[test]
fn bad_primitives_do_not_touch_their_neighbours() {
    let positions = [
        [-1.0, -1.0, 0.0, 1.0],
        [3.0, -1.0, 0.0, 1.0],
        [-1.0, 3.0, 0.0, 1.0],
        [f32::NAN, 0.0, 0.0, 1.0],
        [0.0, f32::INFINITY, 0.0, 1.0],
        [0.0; 4],
    ];
    let triangles = [[0, 1, 3], [0, 1, 2], [4, 1, 2], [5, 5, 5], [0, 3, 4]];
    let picture = CANVAS.triangles(&positions, &triangles);
    assert!(picture.ids.iter().all(|&id| id == 1 << 24 | 2), "the second triangle alone is seen");
    // It is cut by two planes, into two.
    assert_eq!((picture.stats.non_finite, picture.stats.clipped, picture.stats.drawn), (4, 1, 2));
}
