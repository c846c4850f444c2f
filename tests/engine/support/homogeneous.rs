//! The oracle of clipping: which pixels show a triangle, without clipping it (Olano and Greer
//! 1997), exact in i128.
//!
//! Pixel (X, Y) sees Σ λᵢVᵢ with λᵢ = det(p, Vⱼ, Vₖ)/det(V₀, V₁, V₂) over (x, y, w), p = (X, Y, 1).
//! It is in the picture if all λᵢ > 0 and -1 <= Σ λᵢzᵢ <= 1. All five are linear in X and Y.

use super::Canvas;

/// Unit of the coordinates: 1/1024.
pub(crate) const UNIT: i128 = 1024;

/// A clip-space position in [`UNIT`]s.
pub(crate) type Clip = [i128; 4];

/// What is known of a pixel when window positions may be off by 1/256 pixel along each axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Seen {
    Yes,
    No,
    NearAnEdge,
}

/// a·X + b·Y + c
type Linear = [i128; 3];

/// The position as the rasteriser gets it, which must be exact.
pub(crate) fn clip(v: Clip) -> [f32; 4] {
    v.map(|c| {
        let value = c as f32 / UNIT as f32;
        assert_eq!((f64::from(value) * UNIT as f64) as i128, c, "more than 24 bits");
        value
    })
}

fn cross([ax, ay, aw]: Linear, [bx, by, bw]: Linear) -> Linear {
    [ay * bw - aw * by, aw * bx - ax * bw, ax * by - ay * bx]
}

fn dot(a: Linear, b: Linear) -> i128 {
    (0..3).map(|i| a[i] * b[i]).sum()
}

/// The five functions that are positive inside; `None` for a triangle seen edge on.
fn functions(triangle: [Clip; 3]) -> Option<[Linear; 5]> {
    let [a, b, c] = triangle.map(|[x, y, _, w]| [x, y, w]);
    let determinant = dot(a, cross(b, c));
    let lambda = [cross(b, c), cross(c, a), cross(a, b)].map(|l| l.map(|k| k * determinant.signum()));
    let depth: Linear = std::array::from_fn(|k| (0..3).map(|i| lambda[i][k] * triangle[i][2]).sum());
    let near_far = |sign: i128| [sign * depth[0], sign * depth[1], sign * depth[2] + determinant.abs()];
    (determinant != 0).then_some([lambda[0], lambda[1], lambda[2], near_far(1), near_far(-1)])
}

/// Whether a pixel (column, row from the top) shows a triangle at its centre.
pub(crate) fn seen(triangle: [Clip; 3], [column, row]: [u32; 2], canvas: Canvas) -> Seen {
    let Some(functions) = functions(triangle) else { return Seen::NearAnEdge };
    let [width, height] = [canvas.width, canvas.height].map(i128::from);
    let [x, y] = [2 * i128::from(column) + 1 - width, height - 2 * i128::from(row) - 1];
    // X = x/width, Y = y/height; 1/256 pixel is 2/(256·extent) of them.
    let surely = |[a, b, c]: Linear| {
        let value = (a * x * height + b * y * width + c * width * height) * 128;
        let slack = a.abs() * height + b.abs() * width;
        if value.abs() > slack { value.signum() } else { 0 }
    };
    let signs = functions.map(surely);
    if signs.contains(&-1) {
        Seen::No
    } else if signs == [1; 5] {
        Seen::Yes
    } else {
        Seen::NearAnEdge
    }
}
