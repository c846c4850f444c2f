//! The cells of the matrix, each run alone and timed, and held against the reference.

use serde::{Deserialize, Serialize};

use super::matrix::{Cell, Extent, Panel, Source};
use super::reference::{Difference, Reference, differences, key};
use super::store::Store;
use super::trajectory::{self, Limits, Moment, Trajectory};
use crate::error::Result;

/// The part of the energy released by the fall that a cloth may gain before it counts as unstable.
/// Nothing in the model puts energy in, so all of a gain is error.
const ENERGY_BOUND: f64 = 0.01;

/// How a run ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Outcome {
    /// Every position is a number and the energy within its bound.
    Ok,
    /// Every position is a number, but the cloth gained energy out of nothing.
    EnergyAboveBound,
    /// A position or an energy is no longer a number.
    Lost,
    /// It visited too many springs and was given up.
    TooDear,
}

impl Outcome {
    /// The outcome in words.
    pub fn text(self) -> &'static str {
        match self {
            Self::Ok => "ok",
            Self::EnergyAboveBound => "energy above bound",
            Self::Lost => "lost",
            Self::TooDear => "too dear",
        }
    }
}

/// What was measured of a cell.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Measured {
    /// Number of the method.
    pub method: usize,
    /// Steps per second.
    pub rate: u32,
    /// How it ended.
    pub outcome: Outcome,
    /// Distance from the reference at each moment that was reached.
    pub errors: Vec<Difference>,
    /// Energy above the reference's at the last moment over the energy that the fall released;
    /// positive means gained. Absent when the run was not whole or nothing fell.
    pub drift: Option<f64>,
    /// Largest length of a spring over its rest length at the moments.
    pub stretch: f64,
    /// Springs visited per simulated second: the same on every machine.
    pub springs: f64,
    /// Wall time per simulated second of each repetition, in seconds.
    pub walls: Vec<f64>,
}

impl Measured {
    fn new(cell: &Cell, run: &Trajectory, reference: &Reference) -> Self {
        let released = reference.moments.iter().map(|moment| moment.height.abs()).fold(0.0, f64::max);
        let last = run.moments.len().checked_sub(1).filter(|_| released > 0.0);
        let drift = last.map(|i| (run.moments[i].energy - reference.moments[i].energy) / released);
        let whole = run.moments.len() == reference.moments.len();
        let gained = |moment: &Moment| moment.energy > ENERGY_BOUND * released;
        let outcome = match whole {
            false if run.given_up => Outcome::TooDear,
            false => Outcome::Lost,
            true if run.moments.iter().any(gained) => Outcome::EnergyAboveBound,
            true => Outcome::Ok,
        };
        Self {
            method: cell.method,
            rate: cell.rate,
            outcome,
            errors: differences(&run.moments, &reference.moments),
            drift: drift.filter(|_| whole),
            stretch: run.moments.iter().map(|moment| moment.stretch).fold(0.0, f64::max),
            springs: run.springs,
            walls: vec![run.wall],
        }
    }

    /// The median wall time per simulated second, in seconds.
    pub fn wall(&self) -> f64 {
        median(&self.walls)
    }
}

/// The middle of `values`, or the mean of both in the middle; 0 for none.
pub(super) fn median(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    match (sorted.get(sorted.len() / 2), sorted.len() % 2) {
        (None, _) => 0.0,
        (Some(middle), 1) => *middle,
        (Some(upper), _) => 0.5 * (upper + sorted[sorted.len() / 2 - 1]),
    }
}

/// Measures the cells of all panels, one run at a time. The repetitions of a cell are interleaved with
/// the other cells, so that a machine that is slow for a while is not slow for one cell alone.
///
/// # Errors
/// Those of [`trajectory::run`].
pub fn measure(
    source: &Source,
    panels: &[(Panel, Reference)],
    extent: &Extent,
    store: &Store,
    watch: &(dyn Fn(u32) -> Result<()> + Sync),
) -> Result<Vec<Vec<Measured>>> {
    let mut all: Vec<Vec<Option<Measured>>> = Vec::new();
    let mut keys = Vec::new();
    for (panel, reference) in panels {
        let model = source.scene(&panel.sets)?;
        let of = |cell: &Cell| {
            key("cell", &(&cell.scene, &extent.tenths, extent.most_springs, &model, reference.rates))
        };
        keys.push(panel.cells.iter().map(of).collect::<Vec<_>>());
        let kept = keys.last().into_iter().flatten().map(|key| store.get::<Measured>(*key));
        let kept: Vec<_> = kept.collect();
        kept.iter().flatten().flat_map(|kept| &kept.walls).for_each(|_| store.note_found());
        all.push(kept);
    }
    for round in 0..extent.repeats {
        for ((panel, reference), (measured, keys)) in panels.iter().zip(all.iter_mut().zip(&keys)) {
            for (cell, (measured, key)) in panel.cells.iter().zip(measured.iter_mut().zip(keys)) {
                if measured.as_ref().is_some_and(|kept| kept.is_done(round, extent)) {
                    watch(cell.rate / 10 * extent.last())?;
                    continue;
                }
                let limits = Limits { tenths: &extent.tenths, most_springs: extent.most_springs };
                let run = trajectory::run(&cell.scene, cell.rate, limits, watch)?;
                match measured {
                    Some(measured) => measured.walls.push(run.wall),
                    None => *measured = Some(Measured::new(cell, &run, reference)),
                }
                store.put(*key, &measured)?;
            }
        }
    }
    Ok(all.into_iter().map(|panel| panel.into_iter().flatten().collect()).collect())
}

impl Measured {
    /// Whether the repetition number `round` was made, would take too long, or tells nothing.
    fn is_done(&self, round: usize, extent: &Extent) -> bool {
        let spent = self.walls.iter().sum::<f64>() * 0.1 * f64::from(extent.last());
        let whole = matches!(self.outcome, Outcome::Ok | Outcome::EnergyAboveBound);
        !whole || self.walls.len() > round || spent > extent.patience
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_median_is_the_middle_or_the_mean_of_two() {
        assert_eq!(median(&[]), 0.0);
        assert_eq!(median(&[9.0, 1.0, 2.0]), 2.0);
        assert_eq!(median(&[4.0, 1.0, 9.0, 2.0]), 3.0);
    }
}
