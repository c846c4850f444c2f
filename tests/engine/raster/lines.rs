//! Lines are those of OpenGL's diamond-exit rule, pixel by pixel, one fragment a column (or row).

use crate::support::{Canvas, Picture, cases, flat};
use drape::raster::Primitives;
use proptest::prelude::*;

/// Ends in 1/256 pixel, x right, y up.
type End = [i32; 2];

const CANVAS: Canvas = Canvas::new(32, 32);
const SIDE: i32 = 32 * 256;

/// The oracle: every pixel's diamond against the segment, by separating axes, in i128.
///
/// Both ends are moved by -(ε, ε²). Lengths are in 2^-48 pixel with ε = 2^-28 and ε² = 2^-48
/// pixel: ends on the grid of 1/256 pixel differ by so much more that no smaller ε decides otherwise.
mod oracle {
    use super::{Canvas, End};

    const PIXEL: i128 = 1 << 48;
    const EPSILON: i128 = 1 << 20;

    fn moved([x, y]: End) -> [i128; 2] {
        [i128::from(x) * (PIXEL / 256) - EPSILON, i128::from(y) * (PIXEL / 256) - 1]
    }

    /// Whether the open diamond and the closed segment overlap when seen along `axis`.
    fn overlap(axis: [i128; 2], ends: [[i128; 2]; 2], centre: [i128; 2]) -> bool {
        let along = |p: [i128; 2]| axis[0] * (p[0] - centre[0]) + axis[1] * (p[1] - centre[1]);
        let reach = PIXEL / 2 * axis[0].abs().max(axis[1].abs());
        let [a, b] = ends.map(along);
        a.min(b) < reach && a.max(b) > -reach
    }

    /// Whether a line draws a pixel (column, row from the top).
    pub(super) fn draws(ends: [End; 2], [column, row]: [u32; 2], canvas: Canvas) -> bool {
        let [x, y] = [column, canvas.height - 1 - row].map(|p| i128::from(p) * PIXEL + PIXEL / 2);
        let ends = ends.map(moved);
        let [dx, dy] = [ends[1][0] - ends[0][0], ends[1][1] - ends[0][1]];
        let meets = [[1, 1], [1, -1], [-dy, dx]].into_iter().all(|axis| overlap(axis, ends, [x, y]));
        let leaves = (ends[1][0] - x).abs() + (ends[1][1] - y).abs() >= PIXEL / 2;
        meets && leaves
    }
}

/// The clip-space position of a window position, with depth 0.25, exact.
fn clip([x, y]: End) -> [f32; 4] {
    let ndc = |c: i32| (2 * c - SIDE) as f32 / SIDE as f32;
    [ndc(x), ndc(y), -0.5, 1.0]
}

fn draw(ends: [End; 2]) -> Picture {
    CANVAS.draw(&[flat(Primitives::Lines(&[[0, 1]]), &ends.map(clip), [1.0; 3])])
}

fn drawn(ends: [End; 2]) -> Vec<bool> {
    draw(ends).ids.iter().map(|&id| id != 0).collect()
}

/// On and off pixel centres, borders and the corners of diamonds.
fn end() -> impl Strategy<Value = End> {
    let c = prop_oneof![0..=SIDE, (0..=32 * 2).prop_map(|c| c * 128), (0..=32 * 8).prop_map(|c| c * 32)];
    prop::array::uniform2(c)
}

/// At most two pixels along each axis.
fn short() -> impl Strategy<Value = [End; 2]> {
    (end(), prop::array::uniform2(-512..=512_i32))
        .prop_map(|(from, step)| [from, [0, 1].map(|i| (from[i] + step[i]).clamp(0, SIDE))])
}

proptest! {
    #![proptest_config(cases(8000))]

    #[test]
    fn every_pixel_is_as_the_oracle_says(
        ends in prop_oneof![[end(), end()], short()],
    ) {
        let expected: Vec<bool> =
            CANVAS.pixels().map(|pixel| oracle::draws(ends, pixel, CANVAS)).collect();
        prop_assert_eq!(drawn(ends), expected);
    }
}

proptest! {
    #![proptest_config(cases(500))]

    /// A polyline that goes one way has one fragment in every column (or row) on its way.
    #[test]
    fn joined_segments_have_no_gaps_and_no_doubles(
        steps in prop::collection::vec((1..2048_i32, -64..=64_i32), 1..40),
        start in end(),
        along_y in any::<bool>(),
        backwards in any::<bool>(),
    ) {
        let turn = |[x, y]: End| {
            let x = if backwards { SIDE - x } else { x };
            if along_y { [y, x] } else { [x, y] }
        };
        // A line along the picture's very bottom (or left) is moved out of it.
        let mut points = vec![[start[0], start[1].max(1)]];
        for (step, slope) in steps {
            let [x, y] = points[points.len() - 1];
            let step = step.min(SIDE - x);
            let rise = step * slope / 64;
            points.push([x + step, (y + rise).clamp(1, SIDE)]);
        }
        let mut columns = [0; 32];
        for pair in points.windows(2) {
            for (pixel, drawn) in CANVAS.pixels().zip(drawn([turn(pair[0]), turn(pair[1])])) {
                let up = [pixel[0] as usize, 31 - pixel[1] as usize];
                columns[up[usize::from(along_y)]] += i32::from(drawn);
            }
        }
        // The columns between the pixel that the polyline starts in and the one it ends in.
        let pixel = |x: i32| if backwards { x.div_euclid(256) } else { (x - 1).div_euclid(256) };
        let first = pixel(points[0][0]) + 1;
        let last = pixel(points[points.len() - 1][0]) - 1;
        let on_way = |c: i32| if backwards { 31 - c } else { c };
        for column in first..=last {
            prop_assert_eq!(columns[on_way(column) as usize], 1, "column {} of {:?}", column, &points);
        }
    }

    /// Depth runs straight from end to end in the window, to the rounding of f32.
    #[test]
    fn depth_is_linear_in_the_window(
        from in end(), to in end(), w in prop::array::uniform2(0.25..4.0_f32), z in prop::array::uniform2(0.0..=0.9_f32),
    ) {
        let length = [0, 1].map(|i| (to[i] - from[i]).abs());
        prop_assume!(length[0].max(length[1]) > 1024);
        let axis = usize::from(length[1] > length[0]);
        let ends = [(from, w[0], z[0]), (to, w[1], z[1])].map(|(end, w, z)| {
            let [x, y, ..] = clip(end);
            [x * w, y * w, (2.0 * z - 1.0) * w, w]
        });
        let picture = CANVAS.draw(&[flat(Primitives::Lines(&[[0, 1]]), &ends, [1.0; 3])]);
        for ([x, y], (&id, &depth)) in CANVAS.pixels().zip(picture.ids.iter().zip(&picture.depth)) {
            if id != 0 {
                let centre = [x, 31 - y].map(|c| f64::from(c) * 256.0 + 128.0);
                let part = (centre[axis] - f64::from(from[axis])) / f64::from(to[axis] - from[axis]);
                // The last centre may lie beyond an end; depth is at least 0.
                let expected = (f64::from(z[0]) + f64::from(z[1] - z[0]) * part).max(0.0);
                prop_assert!((f64::from(depth) - expected).abs() < 1e-6, "{} for {}", depth, expected);
            }
        }
    }
}

/// From the probe of a GL driver: the last pixel is left out.
#[test]
fn a_line_from_centre_to_centre_leaves_out_its_last_pixel() {
    let at = |x: i32, y: i32| [x * 256 + 128, y * 256 + 128];
    let picture = draw([at(2, 3), at(9, 6)]);
    let pixels: Vec<[u32; 2]> = CANVAS
        .pixels()
        .zip(&picture.ids)
        .filter(|&(_, &id)| id != 0)
        .map(|([x, y], _)| [x, 31 - y])
        .collect();
    let mut pixels = pixels;
    pixels.sort_unstable();
    assert_eq!(pixels, [[2, 3], [3, 3], [4, 4], [5, 4], [6, 5], [7, 5], [8, 6]]);
    assert!(drawn([at(4, 4), at(4, 4)]).iter().all(|&drawn| !drawn), "no length, no pixel");
}

#[test]
fn lines_that_leave_the_picture_reach_its_border() {
    for (from, to) in [
        ([-100.0, 0.3, 0.0, 1.0], [100.0, 0.3, 0.0, 1.0]),
        ([-4e9, 0.3, 0.0, 1.0], [4e9, 0.3, 0.0, 1.0]),
        ([-3.0, 0.2, 0.0, 2.0], [3.0, 0.2, 0.0, 2.0]),
    ] {
        let picture = CANVAS.draw(&[flat(Primitives::Lines(&[[0, 1]]), &[from, to], [1.0; 3])]);
        let mut columns = [0; 32];
        for ([x, _], &id) in CANVAS.pixels().zip(&picture.ids) {
            columns[x as usize] += u32::from(id != 0);
        }
        assert_eq!(columns, [1; 32], "{from:?} to {to:?}");
        assert_eq!(picture.stats.clipped, 1);
    }
}
