//! Speed against accuracy, measured: the matrix method × steps per second × stiffness of a scene's
//! cloth against a self-converged reference, the ways of drawing it against a converged picture, and
//! what follows from both: which to use if so much can be paid.

pub mod hull;
pub mod matrix;
pub mod pictures;
pub mod reference;
mod report;
mod results;
pub mod runs;
pub mod store;
pub mod trajectory;

use rayon::prelude::*;

use drape::error::Result;
use drape::texture_source::TextureSource;
use hull::{Advice, advice, hull};
use matrix::{Extent, Panel, Source, panels, run_name};
use pictures::Pictures;
use reference::{COMPARED, DRAWN, RUNGS, Reference, converge};
use runs::{Measured, Outcome};
use store::Store;

pub use report::page;
pub use results::{Results, csv};

/// Everything that a study found.
pub struct Study {
    /// What was run.
    pub extent: Extent,
    /// The stiffnesses.
    pub panels: Vec<PanelStudy>,
    /// Stiffnesses over mass, in 1/s², that would take too long.
    pub left_out: Vec<f64>,
    /// The ways of drawing, if the scene can be studied so.
    pub pictures: Option<Pictures>,
}

/// What was found at one stiffness.
pub struct PanelStudy {
    /// The cells that were run.
    pub panel: Panel,
    /// What they were held against.
    pub reference: Reference,
    /// What was measured of each cell.
    pub cells: Vec<Measured>,
}

/// How many steps [`run`] tells `watch` of, but for what the references need beyond their first five runs.
///
/// # Errors
/// As [`matrix::panels`].
pub fn steps(source: &Source, extent: &Extent) -> Result<u64> {
    let repeats = extent.repeats as u64;
    let tenths = |rate: u32| u64::from(rate / 10 * extent.last());
    let of = |panel: &Panel| {
        let cells: u64 = panel.cells.iter().map(|cell| tenths(cell.rate)).sum();
        cells * repeats + if panel.cells.is_empty() { 0 } else { u64::from(RUNGS) * tenths(panel.finest) }
    };
    Ok(panels(source, extent)?.iter().map(of).sum())
}

/// Runs what `store` does not have. `watch` is told the steps that were made since it was last called,
/// from several threads, and can end the study.
///
/// # Errors
/// Those of the scene, of the simulations, of the renderer, of the store and of `watch`.
pub fn run(
    source: &Source,
    textures: &TextureSource,
    extent: &Extent,
    store: &Store,
    watch: &(dyn Fn(u32) -> Result<()> + Sync),
) -> Result<Study> {
    // References run side by side: nothing of them is timed.
    let (panels, left_out): (Vec<Panel>, Vec<Panel>) =
        panels(source, extent)?.into_iter().partition(|panel| !panel.cells.is_empty());
    let with_reference = |panel: Panel| {
        let reference = converge(source, &panel, extent, store, watch)?;
        Ok((panel, reference))
    };
    let panels = panels.into_par_iter().map(with_reference).collect::<Result<Vec<_>>>()?;
    let measured = runs::measure(source, &panels, extent, store, watch)?;
    let panels = panels
        .into_iter()
        .zip(measured)
        .map(|((panel, reference), cells)| PanelStudy { panel, reference, cells })
        .collect();
    let pictures = match extent.only.is_empty() {
        true => pictures::measure(&source.scene(&[])?, textures, extent, store, watch)?,
        false => None,
    };
    let left_out = left_out.iter().map(|panel| panel.k_over_m).collect();
    Ok(Study { extent: extent.clone(), panels, left_out, pictures })
}

/// What is paid for accuracy.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cost {
    /// Wall time per simulated second, in seconds, on this machine.
    Wall,
    /// Springs visited per simulated second, on every machine.
    Springs,
}

impl PanelStudy {
    /// The number of the last moment at which most cells can be told from the reference.
    pub fn moment(&self) -> usize {
        let told = |moment: &usize| {
            let sound: Vec<_> = self.cells.iter().filter(|cell| cell.outcome == Outcome::Ok).collect();
            let above = sound.iter().filter(|cell| self.is_above(cell, *moment, COMPARED)).count();
            2 * above >= sound.len()
        };
        (0..self.reference.floor.len()).rev().find(told).unwrap_or(0)
    }

    /// Whether the error of a cell at a moment can be told from that of the reference.
    pub fn is_compared(&self, cell: &Measured, moment: usize) -> bool {
        self.is_above(cell, moment, DRAWN)
    }

    /// The same for cell number `cell` at the panel's moment.
    fn is_told(&self, cell: usize) -> bool {
        self.cells.get(cell).is_some_and(|cell| self.is_compared(cell, self.moment()))
    }

    fn is_above(&self, cell: &Measured, moment: usize, part: f64) -> bool {
        let pair = cell.errors.get(moment).zip(self.reference.floor.get(moment));
        pair.is_some_and(|(error, floor)| error.is_above(floor, part))
    }

    /// Cost and error of each cell at the panel's moment; no number for cells that are not sound or did
    /// not reach it. The error of a cell that is not compared is the most that it can be: the smallest
    /// that is.
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

    /// What a cell costs.
    pub fn cost(&self, cell: &Measured, cost: Cost) -> f64 {
        match cost {
            Cost::Wall => cell.wall(),
            Cost::Springs => cell.springs,
        }
    }

    /// The cells that no other beats, in order of their cost.
    pub fn hull(&self, cost: Cost) -> Vec<usize> {
        hull(&self.rivals(cost))
    }

    /// Which cell to use for which budget of wall time.
    pub fn advice(&self) -> Vec<Advice> {
        advice(&self.rivals(Cost::Wall))
    }

    /// The [`PanelStudy::points`] of cells that differ: where what a method adds does nothing, its times
    /// differ from those of the method without it by chance alone.
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

impl Pictures {
    /// Milliseconds and root of the mean squared difference of each way.
    pub fn points(&self) -> Vec<[f64; 2]> {
        self.drawn.iter().map(|drawn| [drawn.ms(), drawn.rmse]).collect()
    }
}
