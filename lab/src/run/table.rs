//! The table of `simulate --csv`: a row for each frame.

use crate::csv::Csv;
use drape::diagnostics::energy::Energy;
use drape::diagnostics::extremes::Extremes;
use drape::diagnostics::ledger::Ledger;
use drape::simulation::Simulation;

/// The columns: the time (s), energies (J), the energy that each phase added since the last row (J), and
/// extremes (m, m/s).
pub fn columns() -> Vec<String> {
    let energies = ["time", "kinetic", "spring", "gravitational", "total"].map(str::to_owned);
    let added = Ledger::default().entries().map(|(name, _)| format!("by_{name}"));
    let extremes = ["largest_stretch", "smallest_distance", "largest_speed"].map(str::to_owned);
    energies.into_iter().chain(added).chain(extremes).collect()
}

/// The rows so far.
#[derive(Debug)]
pub struct Table {
    csv: Csv,
    rows: Rows,
}

/// What makes the rows.
#[derive(Debug, Default)]
pub struct Rows {
    /// The ledger at the last row, if there is one.
    before: Option<Ledger>,
}

impl Rows {
    /// The numbers of the next row, the state of `simulation`, in the order of [`columns`]. What each phase added is 0
    /// where no ledger is recorded.
    pub fn next(&mut self, simulation: &Simulation) -> Vec<f64> {
        let energy = simulation.energy();
        let Energy { kinetic, spring, gravitational } = energy;
        let ledger = simulation.ledger().unwrap_or_default();
        let pairs = ledger.entries().zip(self.before.unwrap_or(ledger).entries());
        let added = pairs.map(|((_, now), (_, before))| now - before);
        let Extremes { stretch, distance, speed } = simulation.extremes();
        self.before = Some(ledger);
        let energies = [simulation.time(), kinetic, spring, gravitational, energy.total()];
        energies.into_iter().chain(added).chain([stretch, distance, speed]).collect()
    }
}

impl Default for Table {
    fn default() -> Self {
        Self::new()
    }
}

impl Table {
    /// A table without rows.
    pub fn new() -> Self {
        let columns = columns();
        let names: Vec<&str> = columns.iter().map(String::as_str).collect();
        Self { csv: Csv::new(&names), rows: Rows::default() }
    }

    /// Adds the state of `simulation`, which records its ledger.
    pub fn row(&mut self, simulation: &Simulation) {
        self.csv.row(self.rows.next(simulation));
    }

    /// The whole table.
    pub fn text(&self) -> &str {
        self.csv.text()
    }
}
