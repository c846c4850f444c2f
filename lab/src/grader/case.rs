//! The states of two programs that are compared.

use std::ops::Range;

use super::precision::Precision;
use super::states::State;
use drape::cloth::{Counters, Points};
use drape::error::Result;
use drape::scene::{Cloth, Scene};
use drape::simulation::Simulation;

/// Largest difference that another order of operations makes at first, in metres.
pub(super) const ROUNDING: f64 = 1e-11;

/// The states of two programs at the same frames.
pub struct Case<'a> {
    /// The scene of both.
    pub scene: &'a Scene,
    /// Its cloth.
    pub cloth: &'a Cloth,
    /// The frame of the first states.
    pub first_frame: u64,
    /// The last frame of ours that may be one of their states under another number.
    pub last_frame: u64,
    /// The start of the cloth, if it is not that of the method.
    pub start: Option<Points>,
    /// The states of the method.
    pub ours: &'a [Ours],
    /// The states of the other program, as many.
    pub theirs: &'a [State],
}

/// A state of the method.
pub struct Ours {
    /// The points.
    pub positions: Points,
    /// The work up to this state.
    pub counters: Counters,
}

impl Ours {
    /// The states of `count` frames from `first` on; `each` is called after every frame.
    ///
    /// # Errors
    /// Those of the simulation and of `each`.
    pub fn simulate(
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

impl Case<'_> {
    /// The largest distance of two points in each of the states `window`, if ours are `ours`, beyond what rounding
    /// theirs to the digits of the file makes.
    pub(super) fn distances(&self, window: Range<usize>, ours: &[Ours], precision: &Precision) -> Vec<f64> {
        let theirs = &self.theirs[window];
        ours.iter()
            .zip(theirs)
            .map(|(ours, theirs)| largest_beyond(&ours.positions, theirs, precision))
            .collect()
    }

    /// The frame of state `k`.
    pub(super) fn frame(&self, k: usize) -> u64 {
        self.first_frame + k as u64
    }
}

/// The distance of two points, in metres.
pub(super) fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    let [x, y, z] = [0, 1, 2].map(|axis| a[axis] - b[axis]);
    (x * x + y * y + z * z).sqrt()
}

/// As [`largest`], where each coordinate counts only beyond the rounding of `precision`.
pub(super) fn largest_beyond(ours: &Points, theirs: &[[f64; 3]], precision: &Precision) -> f64 {
    let beyond = |ours: f64, theirs: f64| {
        let off = (ours - theirs).abs();
        // A comparison with NaN is false.
        if off <= precision.slack(theirs) { 0.0 } else { off - precision.slack(theirs) }
    };
    let distances = theirs.iter().enumerate().map(|(p, theirs)| {
        let ours: [f64; 3] = ours.get(p).into();
        distance([0, 1, 2].map(|axis| beyond(ours[axis], theirs[axis])), [0.0; 3])
    });
    distances.map(|d| if d.is_finite() { d } else { f64::INFINITY }).fold(0.0, f64::max)
}

/// The largest distance of two points; infinite if one is not a number.
pub(super) fn largest(ours: &Points, theirs: &[[f64; 3]]) -> f64 {
    let distances = theirs.iter().enumerate().map(|(p, &theirs)| distance(ours.get(p).into(), theirs));
    distances.map(|d| if d.is_finite() { d } else { f64::INFINITY }).fold(0.0, f64::max)
}
