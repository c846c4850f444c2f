//! Hard shapes with smooth edges: a bitmap finer than the picture, averaged at the end.

use super::SIZE;

/// Fine cells along the side of a texel.
const FINE: usize = 4;
/// Fine cells along the side of a mask.
const SIDE: usize = FINE * SIZE;

/// What part of each texel is covered. Places are (u, v) in 0..1, v downward; u goes around.
pub(super) struct Mask {
    cells: Vec<bool>,
}

impl Mask {
    /// Nothing is covered.
    pub(super) fn new() -> Self {
        Self { cells: vec![false; SIDE * SIDE] }
    }

    /// Covers what lies in the box `low`..`high` and where `inside` holds.
    pub(super) fn fill(&mut self, low: [f64; 2], high: [f64; 2], inside: impl Fn(f64, f64) -> bool) {
        let (left, right) = (cell(low[0]), cell(high[0]));
        for y in cell(low[1]).max(0)..=cell(high[1]).min(SIDE as i64 - 1) {
            for x in left..=right {
                if inside(middle(x), middle(y)) {
                    self.cells[index(y) * SIDE + index(x.rem_euclid(SIDE as i64))] = true;
                }
            }
        }
    }

    /// Covers a stroke from `a` to `b` whose half width goes from `ra` to `rb`.
    pub(super) fn stroke(&mut self, a: [f64; 2], b: [f64; 2], ra: f64, rb: f64) {
        let wide = ra.max(rb);
        let low = [a[0].min(b[0]) - wide, a[1].min(b[1]) - wide];
        let high = [a[0].max(b[0]) + wide, a[1].max(b[1]) + wide];
        let along = [b[0] - a[0], b[1] - a[1]];
        let square = (along[0] * along[0] + along[1] * along[1]).max(1e-18);
        self.fill(low, high, |x, y| {
            let from = [x - a[0], y - a[1]];
            let t = ((from[0] * along[0] + from[1] * along[1]) / square).clamp(0.0, 1.0);
            let [dx, dy] = [from[0] - along[0] * t, from[1] - along[1] * t];
            let radius = ra + (rb - ra) * t;
            dx * dx + dy * dy <= radius * radius
        });
    }

    /// Covers a polygon (even-odd rule).
    pub(super) fn polygon(&mut self, points: &[[f64; 2]]) {
        let bound = |axis: usize, pick: fn(f64, f64) -> f64, start: f64| {
            points.iter().fold(start, |found, point| pick(found, point[axis]))
        };
        let low = [bound(0, f64::min, 9.0), bound(1, f64::min, 9.0)];
        let high = [bound(0, f64::max, -9.0), bound(1, f64::max, -9.0)];
        self.fill(low, high, |x, y| {
            let pairs = points.iter().zip(points.iter().cycle().skip(1));
            let crossed = pairs.filter(|(a, b)| {
                (a[1] > y) != (b[1] > y) && x < a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0])
            });
            crossed.count() % 2 == 1
        });
    }

    /// The covered part of the texel whose middle is (u, v).
    pub(super) fn cover(&self, u: f64, v: f64) -> f64 {
        let corner = |place: f64| index(cell(place) - FINE as i64 / 2);
        let (left, top) = (corner(u), corner(v));
        let rows = (top..top + FINE).map(|y| &self.cells[y * SIDE + left..y * SIDE + left + FINE]);
        rows.flatten().filter(|&&covered| covered).count() as f64 / (FINE * FINE) as f64
    }
}

#[expect(clippy::cast_possible_truncation, reason = "places are near 0..1")]
fn cell(place: f64) -> i64 {
    (place * SIDE as f64).floor() as i64
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a cell inside the mask")]
fn index(cell: i64) -> usize {
    cell as usize
}

fn middle(cell: i64) -> f64 {
    (cell as f64 + 0.5) / SIDE as f64
}
