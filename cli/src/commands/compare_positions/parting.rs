//! Where the states of another program part from ours, and by how much.

use serde::Serialize;

use super::states::State;
use super::verdict::Case;
use drape::cloth::{Counters, Points};
use drape::error::Result;
use drape::scene::{Cloth, Orientation};
use drape::simulation::Simulation;

/// Largest depth of a point of a vertical cloth at its start, in metres.
const JITTER: f64 = 1e-3;

/// Largest difference that a changed order of operations makes at first, in metres.
pub(crate) const ROUNDING: f64 = 1e-11;

/// The first difference.
#[derive(Serialize)]
pub(crate) struct Difference {
    /// The frame.
    pub(crate) frame: u64,
    /// Column and row of the first point that differs.
    pub(crate) point: [usize; 2],
    pub(crate) ours: [f64; 3],
    pub(crate) theirs: [Option<f64>; 3],
    /// Distance of that point, the largest in its frame, and in the last frame, in metres.
    pub(crate) distance: Option<f64>,
    pub(crate) largest: Option<f64>,
    pub(crate) largest_at_the_end: Option<f64>,
}

/// Our state, and what was done to get there.
pub(crate) struct Ours {
    pub(crate) positions: Points,
    pub(crate) counters: Counters,
}

impl Ours {
    /// The states of `count` frames from `first` on; `each` is called after every frame.
    pub(crate) fn simulate(
        mut simulation: Simulation,
        first: u64,
        count: usize,
        mut each: impl FnMut(&Simulation) -> Result<()>,
    ) -> Result<Vec<Self>> {
        let mut states = Vec::new();
        for frame in first..first + count as u64 {
            while simulation.frame() < frame {
                simulation.advance_frame()?;
                each(&simulation)?;
            }
            states.push(Self { positions: simulation.positions().clone(), counters: simulation.counters() });
        }
        Ok(states)
    }
}

impl Difference {
    /// The first point that is farther from ours than `tolerance`, or has other bits where that is 0.
    pub(crate) fn first(case: &Case<'_>, tolerance: f64) -> Option<Self> {
        let mut states = case.ours.iter().zip(case.theirs).enumerate();
        let (k, point) =
            states.find_map(|(k, (ours, theirs))| Some((k, first(&ours.positions, theirs, tolerance)?)))?;
        let (here, there) = (case.ours[k].positions.get(point).into(), case.theirs[k][point]);
        let finite = |value: f64| value.is_finite().then_some(value);
        let largest = |k: usize| finite(largest(&case.ours[k].positions, &case.theirs[k]));
        let width = case.cloth.num_width_points;
        Some(Self {
            frame: case.first_frame + k as u64,
            point: [point % width, point / width],
            ours: here,
            theirs: there.map(finite),
            distance: finite(between(here, there)),
            largest: largest(k),
            largest_at_the_end: largest(case.theirs.len() - 1),
        })
    }
}

/// Where a vertical cloth starts whose points stand at other random depths than ours: `theirs`, if it
/// differs from `ours` in nothing else.
pub(crate) fn start_of(theirs: &State, ours: &Points, cloth: &Cloth) -> Option<Points> {
    let mut start = ours.clone();
    for (p, &at) in theirs.iter().enumerate() {
        let [x, y, z] = [0, 1, 2].map(|axis| (at[axis] - ours.get(p)[axis]).abs());
        // A NaN is not near either.
        let near = x <= ROUNDING && y <= ROUNDING && z <= 2.0 * JITTER;
        if !near {
            return None;
        }
        start.z[p] = at[2];
    }
    (cloth.orientation == Orientation::Vertical && start.z != ours.z).then_some(start)
}

fn first(ours: &Points, theirs: &State, tolerance: f64) -> Option<usize> {
    let differs = |p: usize, theirs: [f64; 3]| {
        let ours: [f64; 3] = ours.get(p).into();
        // A distance that is no number is not within it.
        let within = tolerance > 0.0 && between(ours, theirs) <= tolerance;
        ours.map(f64::to_bits) != theirs.map(f64::to_bits) && !within
    };
    theirs.iter().enumerate().position(|(p, &theirs)| differs(p, theirs))
}

fn between(a: [f64; 3], b: [f64; 3]) -> f64 {
    let [x, y, z] = [0, 1, 2].map(|axis| a[axis] - b[axis]);
    (x * x + y * y + z * z).sqrt()
}

/// The largest distance of two points; infinite if one is no number.
pub(crate) fn largest(ours: &Points, theirs: &[[f64; 3]]) -> f64 {
    let distances = theirs.iter().enumerate().map(|(p, &theirs)| between(ours.get(p).into(), theirs));
    distances.map(|d| if d.is_finite() { d } else { f64::INFINITY }).fold(0.0, f64::max)
}
