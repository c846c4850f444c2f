//! Triangles that leave the view volume, pass behind the eye or are too large for the window are
//! drawn where they are seen, without seams.

use std::cell::Cell;

use crate::support::{
    Canvas, Picture, cases,
    coverage::area,
    homogeneous::{Clip, Seen, UNIT, clip, seen},
};
use proptest::{prelude::*, test_runner::TestRunner};

const CANVAS: Canvas = Canvas::new(64, 64);

fn draw(triangle: [Clip; 3]) -> Picture {
    CANVAS.triangle(triangle.map(clip))
}

fn counts(picture: &Picture) -> Vec<u32> {
    picture.ids.iter().map(|&id| u32::from(id != 0)).collect()
}

/// Pixels that the picture and the oracle disagree on, and how many the oracle leaves open.
fn compare(counts: &[u32], triangle: [Clip; 3]) -> (Vec<[u32; 2]>, usize) {
    let known: Vec<Seen> = CANVAS.pixels().map(|pixel| seen(triangle, pixel, CANVAS)).collect();
    let wrong = |&(_, (count, seen)): &(_, (&u32, &Seen))| match seen {
        Seen::Yes => *count != 1,
        Seen::No => *count != 0,
        Seen::NearAnEdge => *count > 1,
    };
    let wrong = CANVAS.pixels().zip(counts.iter().zip(&known)).filter(wrong).map(|(pixel, _)| pixel);
    (wrong.collect(), known.iter().filter(|&&seen| seen == Seen::NearAnEdge).count())
}

/// A coordinate of at most 14 bits, times up to 2^`shift`.
fn coordinate(shift: u32) -> impl Strategy<Value = i128> {
    (-8192..=8192_i128, prop_oneof![2 => Just(0), 1 => 0..=shift]).prop_map(|(c, shift)| c << shift)
}

/// Inside, outside, behind the eye, near w = 0.
fn position(shift: u32) -> impl Strategy<Value = Clip> {
    let z = prop_oneof![2 => -UNIT..=UNIT, 1 => coordinate(shift)];
    let w = prop_oneof![4 => 1..8192_i128, 1 => Just(UNIT), 2 => -8192..=8192_i128];
    (coordinate(shift), coordinate(shift), z, w).prop_map(|(x, y, z, w)| [x, y, z, w])
}

#[test]
fn every_pixel_is_as_the_oracle_says() {
    let (pixels, open, drawn) = (Cell::new(0), Cell::new(0), Cell::new(0));
    let checked = TestRunner::new(cases(4000)).run(&prop::array::uniform3(position(18)), |triangle| {
        let picture = draw(triangle);
        let (wrong, near_edges) = compare(&counts(&picture), triangle);
        prop_assert!(wrong.is_empty(), "wrong at {wrong:?}, {:?}", picture.stats);
        pixels.set(pixels.get() + 4096);
        open.set(open.get() + near_edges);
        drawn.set(drawn.get() + picture.stats.covered);
        Ok(())
    });
    checked.unwrap();
    assert!(open.get() * 50 < pixels.get(), "the oracle leaves open {open:?} of {pixels:?} pixels");
    assert!(drawn.get() * 20 > pixels.get() as u64, "only {drawn:?} of {pixels:?} pixels show a triangle");
}

proptest! {
    #![proptest_config(cases(400))]

    /// A triangle through any planes, cut into nine: each edge between two of them is clipped from
    /// both sides. Every pixel of it is covered exactly once, and none outside.
    #[test]
    fn cut_edges_are_seamless(
        triangle in prop::array::uniform3(position(4)),
        weights in prop::array::uniform4(prop::array::uniform2(1..=3_i128)),
    ) {
        let triangle = triangle.map(|v| v.map(|c| c << 6));
        let mut total = vec![0; 4096];
        let parts = split(triangle, weights[0]);
        for part in (0..3).flat_map(|i| split(parts[i], weights[i + 1])) {
            for (total, count) in total.iter_mut().zip(counts(&draw(part))) {
                *total += count;
            }
        }
        let (wrong, _) = compare(&total, triangle);
        prop_assert!(wrong.is_empty(), "wrong at {:?}", wrong);
    }

    /// A fan around a point of the picture, its rim up to 2^30 pictures away on all sides.
    #[test]
    fn a_huge_fan_covers_every_pixel_once(
        centre in prop::array::uniform2(-900..=900_i128),
        rim in prop::collection::vec((8..=10_i128, 2..=7_i128, 0..=28_u32), 8),
    ) {
        let rim: Vec<Clip> = rim
            .iter()
            .zip(0..)
            .map(|(&(far, aside, shift), i)| {
                let [x, y] = match i {
                    0 => [far, aside], 1 => [aside, far], 2 => [-aside, far], 3 => [-far, aside],
                    4 => [-far, -aside], 5 => [-aside, -far], 6 => [aside, -far], _ => [far, -aside],
                };
                [x << (shift + 8), y << (shift + 8), 0, UNIT]
            })
            .collect();
        let spokes = rim.iter().zip(rim.iter().cycle().skip(1));
        let fan: Vec<_> = spokes.map(|(&a, &b)| [[centre[0], centre[1], 0, UNIT], a, b]).collect();
        // From some centres the rim is not seen all round in order.
        prop_assume!(fan.iter().all(|corners| area(corners.map(|[x, y, ..]| [x, y])) > 0));
        let mut total = vec![0; 4096];
        for corners in fan {
            let picture = draw(corners);
            for (total, count) in total.iter_mut().zip(counts(&picture)) {
                *total += count;
            }
        }
        let bad: Vec<_> = CANVAS.pixels().zip(&total).filter(|&(_, &count)| count != 1).collect();
        prop_assert!(bad.is_empty(), "{:?}", bad);
    }
}

/// Three triangles around an inner point with weights of eighths.
fn split([a, b, c]: [Clip; 3], [wa, wb]: [i128; 2]) -> [[Clip; 3]; 3] {
    let inner = std::array::from_fn(|i| (wa * a[i] + wb * b[i] + (8 - wa - wb) * c[i]) / 8);
    [[a, b, inner], [b, c, inner], [c, a, inner]]
}

/// Each plane cuts a rectangle in the middle: what is left is the inner half, to the pixel.
#[test]
fn every_plane_cuts_at_its_place() {
    let one = UNIT;
    let halves: [(&str, [Clip; 4]); 6] = [
        (
            "near",
            [
                [-one, -one, -3 * one, one],
                [one, -one, one, one],
                [one, one, one, one],
                [-one, one, -3 * one, one],
            ],
        ),
        (
            "far",
            [
                [-one, -one, 3 * one, one],
                [one, -one, -one, one],
                [one, one, -one, one],
                [-one, one, 3 * one, one],
            ],
        ),
        ("left", [[-3 * one, -one, 0, one], [0, -one, 0, one], [0, one, 0, one], [-3 * one, one, 0, one]]),
        ("right", [[0, -one, 0, one], [3 * one, -one, 0, one], [3 * one, one, 0, one], [0, one, 0, one]]),
        ("bottom", [[-one, -3 * one, 0, one], [one, -3 * one, 0, one], [one, 0, 0, one], [-one, 0, 0, one]]),
        ("top", [[-one, 0, 0, one], [one, 0, 0, one], [one, 3 * one, 0, one], [-one, 3 * one, 0, one]]),
    ];
    for (plane, corners) in halves {
        let picture = CANVAS.triangles(&corners.map(clip), &[[0, 1, 2], [2, 3, 0]]);
        let expected = |[x, y]: [u32; 2]| match plane {
            "near" | "far" | "right" => x >= 32,
            "left" => x < 32,
            "bottom" => y >= 32,
            _ => y < 32,
        };
        for (pixel, &id) in CANVAS.pixels().zip(&picture.ids) {
            assert_eq!(id != 0, expected(pixel), "{plane} plane, pixel {pixel:?}");
        }
        assert_eq!(picture.stats.clipped, 2, "{plane} plane");
        assert_eq!(picture.stats.fragments, 64 * 32, "{plane} plane");
    }
}

/// The planes themselves belong to the view volume.
#[test]
fn depth_from_plane_to_plane_is_drawn_and_nothing_beyond() {
    for (z, drawn) in [(-1536, false), (-1025, false), (-1024, true), (0, true), (1024, true), (1025, false)]
    {
        let picture = draw([[-UNIT, -UNIT, z, UNIT], [3 * UNIT, -UNIT, z, UNIT], [-UNIT, 3 * UNIT, z, UNIT]]);
        let depth = (z + 1024) as f32 / 2048.0;
        // A depth of 1 is that of the cleared picture, and the test is LESS.
        let seen = drawn && depth < 1.0;
        assert_eq!(picture.stats.covered, if seen { 4096 } else { 0 }, "z = {z}/1024");
        assert_eq!(picture.stats.outside, u64::from(!drawn), "z = {z}/1024");
        assert!(picture.depth.iter().all(|&d| d == if seen { depth } else { 1.0 }), "z = {z}/1024");
    }
}
