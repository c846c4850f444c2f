//! What a study found.

use super::extent::Extent;
use super::matrix::Panel;
use super::method::run_name;
use super::pareto::{Advice, advice, front};
use super::pictures::Pictures;
use super::reference::{COMPARED, DRAWN, Reference};
use super::runs::{Measured, Outcome};

/// Everything that a study found.
pub struct Study {
    /// What was run.
    pub extent: Extent,
    /// The stiffnesses.
    pub panels: Vec<PanelStudy>,
    /// Stiffnesses over mass, in 1/s², whose reference would take too long.
    pub left_out: Vec<f64>,
    /// The ways to draw the scene, if it has a converged picture.
    pub pictures: Option<Pictures>,
}

/// What was found at one stiffness.
pub struct PanelStudy {
    /// The cells that were run.
    pub panel: Panel,
    /// What they are compared with.
    pub reference: Reference,
    /// The measurements of each cell.
    pub cells: Vec<Measured>,
}

/// A measure of cost.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cost {
    /// Wall time per simulated second, in seconds, on this machine.
    Wall,
    /// Springs visited per simulated second, on every machine.
    Springs,
}

impl PanelStudy {
    /// The index of the last moment at which most cells can be distinguished from the reference.
    pub fn moment(&self) -> usize {
        let told = |moment: &usize| {
            let sound: Vec<_> = self.cells.iter().filter(|cell| cell.outcome == Outcome::Ok).collect();
            let above = sound.iter().filter(|cell| self.is_above(cell, *moment, COMPARED)).count();
            2 * above >= sound.len()
        };
        (0..self.reference.floor.len()).rev().find(told).unwrap_or(0)
    }

    /// Whether the error of a cell at a moment can be distinguished from that of the reference.
    pub fn is_compared(&self, cell: &Measured, moment: usize) -> bool {
        self.is_above(cell, moment, DRAWN)
    }

    /// [`PanelStudy::is_compared`] for cell number `cell` at the panel's moment.
    pub(super) fn is_distinct(&self, cell: usize) -> bool {
        self.cells.get(cell).is_some_and(|cell| self.is_compared(cell, self.moment()))
    }

    fn is_above(&self, cell: &Measured, moment: usize, part: f64) -> bool {
        let pair = cell.errors.get(moment).zip(self.reference.floor.get(moment));
        pair.is_some_and(|(error, floor)| error.is_above(floor, part))
    }

    /// Cost and error of each cell at the panel's moment. The error is NaN for a cell that did not reach it, or
    /// whose outcome is not [`Outcome::Ok`]; for a cell that cannot be distinguished from the reference it is
    /// the smallest that can, which bounds it from above.
    pub fn points(&self, cost: Cost) -> Vec<[f64; 2]> {
        let moment = self.moment();
        let point = |cell: &Measured| {
            let pair = cell.errors.get(moment).zip(self.reference.floor.get(moment));
            let sound = pair.filter(|_| cell.outcome == Outcome::Ok);
            let error = sound.map_or(f64::NAN, |(error, floor)| error.rms.max(floor.rms / DRAWN));
            [self.cost(cell, cost), error]
        };
        self.cells.iter().map(point).collect()
    }

    /// The cost of a cell.
    pub fn cost(&self, cell: &Measured, cost: Cost) -> f64 {
        match cost {
            Cost::Wall => cell.wall(),
            Cost::Springs => cell.springs,
        }
    }

    /// The cells on the Pareto front, in order of their cost.
    pub fn front(&self, cost: Cost) -> Vec<usize> {
        front(&self.rivals(cost))
    }

    /// The best cell within each budget of wall time.
    pub fn advice(&self) -> Vec<Advice> {
        advice(&self.rivals(Cost::Wall))
    }

    /// The [`PanelStudy::points`], without cells that have the errors of an earlier one: where the addition of a
    /// method has no effect, its times differ only by chance from those of the method without it.
    fn rivals(&self, cost: Cost) -> Vec<[f64; 2]> {
        let mut points = self.points(cost);
        for (i, point) in points.iter_mut().enumerate() {
            let errors = &self.cells[i].errors;
            if self.cells[..i].iter().any(|other| other.errors == *errors) {
                point[1] = f64::NAN;
            }
        }
        points
    }

    /// A cell in words, such as `Verlet, report start at 2700 steps/s`.
    pub fn name(&self, cell: usize) -> String {
        self.cells.get(cell).map_or_else(String::new, |cell| run_name(cell.method, cell.rate))
    }
}
