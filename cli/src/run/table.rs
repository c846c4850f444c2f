//! The table of `simulate --csv`: a row for each frame.

use drape::diagnostics::energy::Energy;
use drape::diagnostics::extremes::Extremes;
use drape::diagnostics::ledger::Ledger;
use drape::simulation::Simulation;
use drape_lab::csv::Csv;

/// The columns: the time (s), energies (J), the energy that each phase added since the last row (J), and
/// extremes (m, m/s).
fn columns() -> Vec<String> {
    let energies = ["time", "kinetic", "spring", "gravitational", "total"].map(str::to_owned);
    let added = Ledger::default().entries().map(|(name, _)| format!("by_{name}"));
    let extremes = ["largest_stretch", "smallest_distance", "largest_speed"].map(str::to_owned);
    energies.into_iter().chain(added).chain(extremes).collect()
}

/// The rows so far.
pub(crate) struct Table {
    csv: Csv,
    /// The ledger at the last row.
    before: Ledger,
}

impl Table {
    /// A table without rows.
    pub(crate) fn new() -> Self {
        let columns = columns();
        let names: Vec<&str> = columns.iter().map(String::as_str).collect();
        Self { csv: Csv::new(&names), before: Ledger::default() }
    }

    /// Adds the state of `simulation`, which records its ledger.
    pub(crate) fn row(&mut self, simulation: &Simulation) {
        let energy = simulation.energy();
        let Energy { kinetic, spring, gravitational } = energy;
        let ledger = simulation.ledger().unwrap_or_default();
        let pairs = ledger.entries().zip(self.before.entries());
        let added = pairs.map(|((_, now), (_, before))| now - before);
        let Extremes { stretch, distance, speed } = simulation.extremes();
        let energies = [simulation.time(), kinetic, spring, gravitational, energy.total()];
        self.csv.row(energies.into_iter().chain(added).chain([stretch, distance, speed]));
        self.before = ledger;
    }

    /// The whole table.
    pub(crate) fn text(&self) -> &str {
        self.csv.text()
    }
}
