//! The energy ledger: what each part of a step put into the total energy or took out of it.
//!
//! A phase that corrects a position also changes the mean velocity `(x - last) / dt`, and so all
//! three energies; its entry is the change of their sum. Verlet's step moves a point by
//! `d1 = velocity_retention d0 + dt2_over_m f` after it moved by `d0`, and with
//! `d1 - d0 = drag + f dt² / m` its kinetic energy changes by `(d1 - d0) · (d1 + d0) m / (2 dt²)`, which splits without a rest:
//! - damping: `drag · (d0 + d1) m / (2 dt²)`;
//! - gravity: `w · (d0 + d1) / 2` of motion and what the height changed, together
//!   `w · (d0 - d1) / 2`;
//! - springs: `s · (d0 + d1) / 2` of motion and what their own energy changed.
//!
//! So gravity and springs have entries only for what the finite step makes them add: both vanish
//! with the step, and grow without end when the step is too large for the springs.
//!
//! For integrators other than Verlet's scheme f is the force that explains the motion,
//! `(d1 - velocity_retention d0) / dt2_over_m`, and for those that remember velocities `d1 - d0` less the drag,
//! times m / dt². So the energy that an integrator loses by itself is entered
//! for the springs and gravity.

use crate::scene::PerKind;

/// What was put into the total energy (positive) or taken out (negative), in J.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize)]
pub struct Ledger {
    /// By gravity: only what the finite step adds to an exchange that is even without it.
    pub gravity: f64,
    /// By the springs: as for gravity.
    pub springs: f64,
    /// By damping.
    pub damping: f64,
    /// By moving close points of the cloth apart.
    pub self_collision: f64,
    /// By contact with the colliders of each kind.
    #[serde(flatten)]
    pub colliders: PerKind<f64>,
    /// By shortening springs that are too long.
    pub stretch_limit: f64,
}

impl Ledger {
    /// Each entry with its name, in the order of a step.
    pub fn entries(self) -> impl Iterator<Item = (&'static str, f64)> {
        let before = [
            ("gravity", self.gravity),
            ("springs", self.springs),
            ("damping", self.damping),
            ("self_collision", self.self_collision),
        ];
        before.into_iter().chain(self.colliders.entries()).chain([("stretch_limit", self.stretch_limit)])
    }

    /// The ledger with these entries, in the order of [`Ledger::entries`]; nothing if there are more or fewer.
    pub(crate) fn from_entries(entries: &[f64]) -> Option<Self> {
        let mut ledger = Self::default();
        let Self { gravity, springs, damping, self_collision, colliders, stretch_limit } = &mut ledger;
        let before = [gravity, springs, damping, self_collision].into_iter();
        let all: Vec<&mut f64> = before.chain(colliders.values_mut()).chain([stretch_limit]).collect();
        if all.len() != entries.len() {
            return None;
        }
        all.into_iter().zip(entries).for_each(|(entry, &value)| *entry = value);
        Some(ledger)
    }

    /// All entries together: the change of the total energy but for rounding.
    pub fn sum(self) -> f64 {
        self.entries().map(|(_, entry)| entry).sum()
    }
}
