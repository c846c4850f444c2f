//! Where the states of another program part from ours, and by how much.

use serde::Serialize;

use super::states::State;
use super::{Session, progress::Progress};
use crate::cloth::{Counters, Points};
use crate::error::Result;
use crate::simulation::Simulation;

/// The first difference.
#[derive(Serialize)]
pub(super) struct Difference {
    pub(super) frame: u64,
    /// Column and row of the first point that differs.
    pub(super) point: [usize; 2],
    pub(super) ours: [f64; 3],
    pub(super) theirs: [Option<f64>; 3],
    /// Distance of that point, the largest in its frame, and in the last frame, in metres.
    pub(super) distance: Option<f64>,
    pub(super) largest: Option<f64>,
    pub(super) largest_at_the_end: Option<f64>,
}

/// Our state, and what was done to get there.
pub(super) struct Ours {
    pub(super) positions: Points,
    pub(super) counters: Counters,
}

/// The states of `count` frames from `first` on.
pub(super) fn simulate(
    mut simulation: Simulation,
    first: u64,
    count: usize,
    session: &Session,
) -> Result<Vec<Ours>> {
    let mut progress = Progress::new(&session.ui, "simulating", first + count as u64 - 1);
    let mut states = Vec::new();
    for frame in first..first + count as u64 {
        while simulation.frame() < frame {
            session.signals.check()?;
            simulation.advance_frame()?;
            progress.set(simulation.frame());
        }
        states.push(Ours { positions: simulation.positions().clone(), counters: simulation.counters() });
    }
    Ok(states)
}

/// The first point that differs.
pub(super) fn first(ours: &Ours, theirs: &State, tolerance: f64) -> Option<usize> {
    let differs = |p: usize, theirs: [f64; 3]| {
        let ours: [f64; 3] = ours.positions.get(p).into();
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
pub(super) fn largest(ours: &Points, theirs: &State) -> f64 {
    let distances = theirs.iter().enumerate().map(|(p, &theirs)| between(ours.get(p).into(), theirs));
    distances.map(|d| if d.is_finite() { d } else { f64::INFINITY }).fold(0.0, f64::max)
}

/// What the report says of state `k`, the first that differs.
pub(super) fn difference(
    ours: &[Ours],
    theirs: &[State],
    k: usize,
    first_frame: u64,
    tolerance: f64,
    width: usize,
) -> Option<Difference> {
    let point = first(&ours[k], &theirs[k], tolerance)?;
    let (here, there) = (ours[k].positions.get(point).into(), theirs[k][point]);
    let finite = |value: f64| value.is_finite().then_some(value);
    let at_the_end = ours.last().zip(theirs.last()).map(|(ours, theirs)| largest(&ours.positions, theirs));
    Some(Difference {
        frame: first_frame + k as u64,
        point: [point % width, point / width],
        ours: here,
        theirs: there.map(finite),
        distance: finite(between(here, there)),
        largest: finite(largest(&ours[k].positions, &theirs[k])),
        largest_at_the_end: at_the_end.and_then(finite),
    })
}
