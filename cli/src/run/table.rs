//! The table of `simulate --csv`: a row a frame.

use drape::diagnostics::energy::Energy;
use drape::diagnostics::extremes::Extremes;
use drape::diagnostics::ledger::Ledger;
use drape::simulation::Simulation;
use drape_lab::csv::Csv;

/// The columns: seconds, J, J put in since the frame before, then the extremes (m, m/s).
const COLUMNS: [&str; 15] = [
    "time",
    "kinetic",
    "spring",
    "gravitational",
    "total",
    "by_gravity",
    "by_springs",
    "by_damping",
    "by_self_collision",
    "by_planes",
    "by_spheres",
    "by_stretch_limit",
    "largest_stretch",
    "smallest_distance",
    "largest_speed",
];

/// The rows so far.
pub(crate) struct Table {
    csv: Csv,
    /// The ledger at the last row.
    before: Ledger,
}

impl Table {
    /// A table without rows.
    pub(crate) fn new() -> Self {
        Self { csv: Csv::new(&COLUMNS), before: Ledger::default() }
    }

    /// Adds the state of `simulation`, whose ledger is kept.
    pub(crate) fn row(&mut self, simulation: &Simulation) {
        let energy = simulation.energy();
        let Energy { kinetic, spring, gravitational } = energy;
        let ledger = simulation.ledger().unwrap_or_default();
        let pairs = ledger.entries().into_iter().zip(self.before.entries());
        let put_in = pairs.map(|((_, now), (_, before))| now - before);
        let Extremes { stretch, distance, speed } = simulation.extremes();
        let energies = [simulation.time(), kinetic, spring, gravitational, energy.total()];
        self.csv.row(energies.into_iter().chain(put_in).chain([stretch, distance, speed]));
        self.before = ledger;
    }

    /// The whole table.
    pub(crate) fn text(&self) -> &str {
        self.csv.text()
    }
}
