//! The divergence: where the states of another program first differ from ours, and by how much.

use serde::Serialize;

use super::case::{Case, ROUNDING, distance, largest};
use super::states::State;
use drape::cloth::Points;
use drape::scene::{Cloth, Orientation};

/// Largest depth of a point of a vertical cloth at its start, in metres.
const JITTER: f64 = 1e-3;

/// The first difference.
#[derive(Serialize)]
pub struct Difference {
    /// The frame.
    pub frame: u64,
    /// Column and row of the first point that differs.
    pub point: [usize; 2],
    /// Our position of the point, in metres.
    pub ours: [f64; 3],
    /// Theirs; absent where it is not a finite number.
    pub theirs: [Option<f64>; 3],
    /// Distance of the two, in metres.
    pub distance: Option<f64>,
    /// Largest distance in this frame, in metres.
    pub largest: Option<f64>,
    /// Largest distance in the last frame, in metres.
    pub largest_at_the_end: Option<f64>,
}

impl Difference {
    /// The first point that is farther from ours than `tolerance`, or that has other bits if `tolerance` is 0.
    pub fn first(case: &Case<'_>, tolerance: f64) -> Option<Self> {
        let mut states = case.ours.iter().zip(case.theirs).enumerate();
        let (k, point) =
            states.find_map(|(k, (ours, theirs))| Some((k, first(&ours.positions, theirs, tolerance)?)))?;
        let (here, there) = (case.ours[k].positions.get(point).into(), case.theirs[k][point]);
        let finite = |value: f64| value.is_finite().then_some(value);
        let largest = |k: usize| finite(largest(&case.ours[k].positions, &case.theirs[k]));
        let width = case.cloth.num_width_points;
        Some(Self {
            frame: case.frame(k),
            point: [point % width, point / width],
            ours: here,
            theirs: there.map(finite),
            distance: finite(distance(here, there)),
            largest: largest(k),
            largest_at_the_end: largest(case.theirs.len() - 1),
        })
    }
}

/// The start of a vertical cloth whose points have other random depths than ours: the points of `theirs`, if
/// they differ from `ours` in nothing else.
pub fn start_of(theirs: &State, ours: &Points, cloth: &Cloth) -> Option<Points> {
    let mut start = ours.clone();
    for (p, &at) in theirs.iter().enumerate() {
        let [x, y, z] = [0, 1, 2].map(|axis| (at[axis] - ours.get(p)[axis]).abs());
        // Every comparison with NaN is false.
        let near = x <= ROUNDING && y <= ROUNDING && z <= 2.0 * JITTER;
        if !near {
            return None;
        }
        start.z[p] = at[2];
    }
    (cloth.orientation == Orientation::Vertical && start.z != ours.z).then_some(start)
}

/// The first point of a state that differs.
fn first(ours: &Points, theirs: &State, tolerance: f64) -> Option<usize> {
    let differs = |p: usize, theirs: [f64; 3]| {
        let ours: [f64; 3] = ours.get(p).into();
        // A distance that is NaN is not within the tolerance.
        let within = tolerance > 0.0 && distance(ours, theirs) <= tolerance;
        ours.map(f64::to_bits) != theirs.map(f64::to_bits) && !within
    };
    theirs.iter().enumerate().position(|(p, &theirs)| differs(p, theirs))
}
