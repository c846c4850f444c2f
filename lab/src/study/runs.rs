//! The cells of the matrix, each run alone and timed, and held against the reference.

use serde::{Deserialize, Serialize};

use super::matrix::{Cell, Extent, Panel, Source};
use super::reference::{Difference, Reference, differences, key};
use super::store::Store;
use super::trajectory::{self, Limits, Moment, Trajectory};
use drape::error::Result;

/// The part of the energy released by the fall by which a cloth may hold more than the reference. A
/// cloth that holds so much more is as high as one that fell a hundredth less far, which shows in a plot of
/// its errors; and the reference knows its own energy a thousand times better (halving its step changes
/// it by less than 1e-5 of what was released on the stock cloth at every stiffness).
const ENERGY_BOUND: f64 = 0.01;

/// How a run fared up to the last moment that it reached, from good to worst.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Outcome {
    /// Every position is a number and the energy within its bounds.
    Ok,
    /// The cloth holds more energy than the reference does at that time: it gained it, or was not
    /// rid of it as the model is.
    EnergyAboveReference,
    /// The cloth holds more energy than it started with: nothing in the model puts any in.
    EnergyAboveBound,
    /// A position or an energy is no longer a number.
    Lost,
    /// It visited too many springs and was given up before the first moment.
    TooDear,
}

impl Outcome {
    /// The outcome in words.
    pub fn text(self) -> &'static str {
        match self {
            Self::Ok => "ok",
            Self::EnergyAboveReference => "energy above the reference's",
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
    /// Energy above the reference's over the energy that the fall released, at the last moment that was
    /// reached; positive means gained. Absent when the cloth was lost or nothing fell.
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
        let (mut released, mut drift, mut worst) = (0.0_f64, None, Outcome::Ok);
        for (now, right) in run.moments.iter().zip(&reference.moments) {
            released = released.max(right.height.abs());
            drift = Some((now.energy - right.energy) / released).filter(|_| released > 0.0);
            worst = worst.max(judge(now, right, ENERGY_BOUND * released));
        }
        let whole = run.moments.len() == reference.moments.len();
        let outcome = match whole || run.given_up {
            false => Outcome::Lost,
            true if run.moments.is_empty() => Outcome::TooDear,
            true => worst,
        };
        Self {
            method: cell.method,
            rate: cell.rate,
            outcome,
            errors: differences(&run.moments, &reference.moments),
            drift: drift.filter(|_| outcome != Outcome::Lost),
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

/// How a cloth fares that may hold `bound` J more than it started with or than the reference, which is
/// `right`.
fn judge(now: &Moment, right: &Moment, bound: f64) -> Outcome {
    if now.energy > bound {
        Outcome::EnergyAboveBound
    } else if now.energy - right.energy > bound {
        Outcome::EnergyAboveReference
    } else {
        Outcome::Ok
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
            key("run", &(&cell.scene, &extent.tenths, extent.most_springs, &model, reference.rates))
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
        let whole = self.errors.len() == extent.tenths.len();
        !whole || self.walls.len() > round || spent > extent.patience
    }

    /// How it fared, in words: with the time at which it was given up, if it was after a moment.
    pub fn fate(&self, moments: usize) -> String {
        let reached = self.errors.last().filter(|_| self.errors.len() < moments);
        match (self.outcome, reached) {
            (Outcome::Lost, _) | (_, None) => self.outcome.text().to_owned(),
            (_, Some(last)) => format!("{}, given up after {} s", self.outcome.text(), last.time),
        }
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

    /// A reference that falls by 1000 J in two moments and loses 100 J and 400 J of them to damping.
    fn reference() -> Reference {
        let moments = vec![moment(0.1, -100.0, -200.0), moment(0.2, -400.0, -1000.0)];
        Reference { rates: [10, 20], floor: Vec::new(), moments }
    }

    fn moment(time: f64, energy: f64, height: f64) -> Moment {
        Moment { time, x: [vec![0.0], vec![0.0], vec![0.0]], energy, height, stretch: 1.0 }
    }

    /// A run that has these energies at the moments that it reaches.
    fn measured(energies: &[f64], given_up: bool) -> Measured {
        let moments = energies.iter().zip([0.1, 0.2]).map(|(&energy, time)| moment(time, energy, 0.0));
        let run = Trajectory { moments: moments.collect(), springs: 1.0, wall: 1.0, given_up };
        let scene = drape::scene::load_text("no.json", "{}", &drape::scene::Overrides::default());
        let cell = Cell { method: 0, rate: 10, scene: scene.unwrap().scene };
        Measured::new(&cell, &run, &reference())
    }

    #[test]
    fn energy_is_held_against_the_reference_and_the_start_at_every_moment() {
        let found = |energies: &[f64]| (measured(energies, false).outcome, measured(energies, false).drift);
        assert_eq!(found(&[-101.0, -500.0]), (Outcome::Ok, Some(-0.1)), "a loss is an error, not a gain");
        assert_eq!(found(&[-98.0, -390.0]), (Outcome::Ok, Some(0.01)), "at both bounds");
        assert_eq!(found(&[-98.0, -389.0]), (Outcome::EnergyAboveReference, Some(0.011)));
        assert_eq!(found(&[-97.0, -400.0]), (Outcome::EnergyAboveReference, Some(0.0)), "for a while");
        assert_eq!(found(&[2.0, -400.0]), (Outcome::EnergyAboveReference, Some(0.0)));
        assert_eq!(found(&[3.0, -400.0]), (Outcome::EnergyAboveBound, Some(0.0)));
        assert_eq!(found(&[-100.0]), (Outcome::Lost, None));
    }

    #[test]
    fn a_run_that_is_given_up_is_judged_by_what_it_reached() {
        let [none, one] = [&[][..], &[-98.0]].map(|energies| measured(energies, true));
        assert_eq!((none.outcome, none.drift), (Outcome::TooDear, None));
        assert_eq!((one.outcome, one.drift), (Outcome::Ok, Some(0.01)));
        assert_eq!([none.fate(2), one.fate(2), one.fate(1)], ["too dear", "ok, given up after 0.1 s", "ok"]);
    }
}
