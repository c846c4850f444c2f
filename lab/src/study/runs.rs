//! The cells of the matrix: each is run alone, timed, and compared with the reference.

use serde::{Deserialize, Serialize};

use super::extent::Extent;
use super::matrix::{Cell, Panel};
use super::reference::{Difference, Reference, differences};
use super::trajectory::{self, Limits, Moment, Trajectory};
use crate::accuracy::source::Source;
use crate::store::{Address, Store, key};
use drape::error::Result;

/// The energy that a cloth may hold beyond the reference's, as a fraction of the energy that the fall
/// released. A hundredth is the height of a cloth that fell a hundredth less far, which shows in a plot of
/// the errors, and the energy of the reference is known a thousand times better: halving its step changes
/// it by less than 1e-5 of what was released, on the stock cloth at every stiffness.
const ENERGY_BOUND: f64 = 0.01;

/// The outcome of a run up to the last moment that it reached, from good to worst.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Outcome {
    /// Every position is a number and the energy within its bounds.
    Ok,
    /// The cloth holds more energy than the reference at that time: it gained energy, or dissipated less than
    /// the model does.
    EnergyAboveReference,
    /// The cloth holds more energy than it started with, although nothing in the model adds any.
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

/// The measurements of a cell.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Measured {
    /// Index of the method.
    pub method: usize,
    /// Steps per second.
    pub rate: u32,
    /// The outcome.
    pub outcome: Outcome,
    /// Distance from the reference at each moment that was reached.
    pub errors: Vec<Difference>,
    /// Energy beyond the reference's, as a fraction of the energy that the fall released, at the last moment that
    /// was reached; positive means gained. Absent when the cloth was lost or nothing fell.
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

/// The outcome at the moment `now`, when the reference is at `right`; a cloth may hold `bound` J more than it
/// started with and than the reference.
fn judge(now: &Moment, right: &Moment, bound: f64) -> Outcome {
    if now.energy > bound {
        Outcome::EnergyAboveBound
    } else if now.energy - right.energy > bound {
        Outcome::EnergyAboveReference
    } else {
        Outcome::Ok
    }
}

/// The median of `values`; 0 for none.
pub(super) fn median(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    match (sorted.get(sorted.len() / 2), sorted.len() % 2) {
        (None, _) => 0.0,
        (Some(middle), 1) => *middle,
        (Some(upper), _) => 0.5 * (upper + sorted[sorted.len() / 2 - 1]),
    }
}

/// Measures the cells of all panels, one run at a time. The repetitions of a cell alternate with those of the
/// other cells, so that a machine that is slow for a while does not slow one cell alone.
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
    let slots =
        panels.iter().map(|(panel, reference)| Slot::of_panel(source, panel, reference, extent, store));
    let mut slots: Vec<Vec<Slot<'_>>> = slots.collect::<Result<_>>()?;
    for repetition in 0..extent.repeats {
        for slot in slots.iter_mut().flatten() {
            if slot.measured.as_ref().is_some_and(|stored| stored.is_done(repetition, extent)) {
                watch(slot.cell.rate / 10 * extent.last())?;
            } else {
                slot.measure(extent, store, watch)?;
            }
        }
    }
    Ok(slots.into_iter().map(|panel| panel.into_iter().filter_map(|slot| slot.measured).collect()).collect())
}

/// A cell that is being measured.
struct Slot<'a> {
    cell: &'a Cell,
    reference: &'a Reference,
    key: Address,
    measured: Option<Measured>,
}

impl<'a> Slot<'a> {
    /// The slots of a panel's cells, with the results that `store` has.
    fn of_panel(
        source: &Source,
        panel: &'a Panel,
        reference: &'a Reference,
        extent: &Extent,
        store: &Store,
    ) -> Result<Vec<Self>> {
        let model = source.scene(&panel.sets)?;
        let slot = |cell: &'a Cell| {
            let key =
                key("run", &(&cell.scene, &extent.tenths, extent.most_springs, &model, reference.rates));
            let measured: Option<Measured> = store.get(key);
            measured.iter().flat_map(|stored| &stored.walls).for_each(|_| store.count_found());
            Self { cell, reference, key, measured }
        };
        Ok(panel.cells.iter().map(slot).collect())
    }

    /// Runs the cell once more and stores what is known of it.
    fn measure(&mut self, extent: &Extent, store: &Store, watch: &dyn Fn(u32) -> Result<()>) -> Result<()> {
        let limits = Limits { tenths: &extent.tenths, most_springs: extent.most_springs };
        let run = trajectory::run(&self.cell.scene, self.cell.rate, limits, watch)?;
        match &mut self.measured {
            Some(measured) => measured.walls.push(run.wall),
            None => self.measured = Some(Measured::new(self.cell, &run, self.reference)),
        }
        store.put(self.key, &self.measured)
    }
}

impl Measured {
    /// Whether repetition number `repetition` is there, would take too long, or would tell nothing.
    fn is_done(&self, repetition: usize, extent: &Extent) -> bool {
        let spent = self.walls.iter().sum::<f64>() * 0.1 * f64::from(extent.last());
        let whole = self.errors.len() == extent.tenths.len();
        !whole || self.walls.len() > repetition || spent > extent.patience
    }

    /// The outcome in words, with the last of the `moments` reached by a run that was given up later.
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
