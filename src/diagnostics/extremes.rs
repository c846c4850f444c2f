//! How far a cloth is stretched, how close its points are and how fast they move.

use crate::cloth::Points;
use crate::cloth::springs::{SpringKind, Springs};
use crate::math::{dot, length};

/// The extremes of a cloth at one moment; all zero without a cloth.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize)]
pub struct Extremes {
    /// Largest length of a spring over its rest length, which is 1 more than its strain; 0 without springs.
    pub stretch: f64,
    /// Smallest distance between two points, in metres.
    pub distance: f64,
    /// Largest speed `|x - last| / dt`, in m/s.
    pub speed: f64,
}

impl Extremes {
    /// The extremes of points at `x` that were at `last` one step of `dt` seconds ago.
    pub fn new(x: &Points, last: &Points, springs: &Springs, dt: f64) -> Self {
        Self {
            stretch: longest_spring(x, springs).map_or(0.0, |spring| spring.stretch),
            distance: smallest_distance(x),
            speed: fastest_point(x, last).map_or(0.0, |(_, length)| length / dt),
        }
    }
}

/// A spring and how far it is stretched.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Stretched {
    pub(crate) kind: SpringKind,
    /// The points at its ends.
    pub(crate) ends: [usize; 2],
    /// Length over rest length.
    pub(crate) stretch: f64,
}

/// The spring that is longest for its rest length, if any has a length.
pub(crate) fn longest_spring(x: &Points, springs: &Springs) -> Option<Stretched> {
    let mut longest: Option<Stretched> = None;
    for family in &springs.families {
        for a in family.points(springs.grid) {
            let b = a - family.offset;
            let stretch = length(x.get(b) - x.get(a)) / family.rest[a];
            if longest.is_none_or(|longest| stretch > longest.stretch) && stretch.is_finite() {
                longest = Some(Stretched { kind: family.kind, ends: [b, a], stretch });
            }
        }
    }
    longest
}

/// The point that moved farthest in the last step, and how far, in metres.
pub(crate) fn fastest_point(x: &Points, last: &Points) -> Option<(usize, f64)> {
    let moves = (0..x.len()).map(|p| (p, length(x.get(p) - last.get(p))));
    moves.max_by(|(_, a), (_, b)| a.total_cmp(b))
}

/// The smallest distance between two of the points, in metres; infinite for fewer than two.
///
/// The points are swept along the axis on which they lie farthest apart, so a pair whose
/// difference on that axis alone exceeds the smallest distance so far is never looked at.
fn smallest_distance(x: &Points) -> f64 {
    let axis = [&x.x, &x.y, &x.z].into_iter().max_by(|a, b| extent(a).total_cmp(&extent(b))).unwrap_or(&x.x);
    let mut order: Vec<usize> = (0..x.len()).collect();
    order.sort_unstable_by(|&p, &q| axis[p].total_cmp(&axis[q]));
    let mut square = f64::INFINITY;
    for (at, &p) in order.iter().enumerate() {
        for &q in &order[at + 1..] {
            let apart = axis[q] - axis[p];
            if apart * apart > square {
                break;
            }
            let e = x.get(q) - x.get(p);
            square = square.min(dot(e, e));
        }
    }
    square.sqrt()
}

/// How far apart the smallest and the largest of `values` lie.
fn extent(values: &[f64]) -> f64 {
    let largest = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    largest - values.iter().copied().fold(f64::INFINITY, f64::min)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::splitmix64;

    #[test]
    fn the_smallest_distance_is_that_of_all_pairs() {
        for count in [2, 3, 40, 200] {
            let mut x = Points::zeros(count).unwrap();
            for p in 0..count {
                let [a, b, c] =
                    [0, 1, 2].map(|c| (splitmix64((3 * p + c + count) as u64) >> 40) as f64 * 1e-8);
                x.set(p, crate::scene::Vec3::new(a, 3.0 * b, 0.5 * c));
            }
            let pairs = (0..x.len()).flat_map(|p| (0..p).map(move |q| (p, q)));
            let all = pairs.map(|(p, q)| length(x.get(p) - x.get(q))).fold(f64::INFINITY, f64::min);
            assert_eq!(smallest_distance(&x), all, "{count} points");
        }
    }
}
