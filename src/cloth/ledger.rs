//! The energy ledger: what each part of a step put into the total energy or took out of it.
//!
//! A phase that corrects a position also changes the mean velocity `(x - last) / dt`, and so all
//! three energies; its entry is the change of their sum. Verlet's step moves a point by
//! `d1 = keep d0 + f a` after it moved by `d0`, and with `d1 - d0 = drag + f dt² / m`
//! its kinetic energy changes by `(d1 - d0) · (d1 + d0) m / (2 dt²)`, which splits without a rest:
//! - damping: `drag · (d0 + d1) m / (2 dt²)`;
//! - gravity: `w · (d0 + d1) / 2` of motion and what the height changed, together
//!   `w · (d0 - d1) / 2`;
//! - springs: `s · (d0 + d1) / 2` of motion and what their own energy changed.
//!
//! So gravity and springs have entries only for what the finite step makes them add: both vanish
//! with the step, and grow without end when the step is too large for the springs.
//!
//! For the other integrators f is the force that explains the motion, `(d1 - keep d0) / a2`, and for
//! BDF2 what is left of `d1 - d0` beside its drag, times m / dt²; so what they dissipate by
//! themselves is entered for the springs and gravity.

use super::energy::{Energy, spring_energy};
use super::grid::Pins;
use super::springs::Springs;
use super::{Constants, Points, dot};
use crate::error::Result;
use crate::scene::Vec3;

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
    /// By contact with planes.
    pub planes: f64,
    /// By contact with spheres.
    pub spheres: f64,
    /// By shortening springs that are too long.
    pub stretch_limit: f64,
}

impl Ledger {
    /// Each entry with its name, in the order of a step.
    pub fn entries(self) -> [(&'static str, f64); 7] {
        [
            ("gravity", self.gravity),
            ("springs", self.springs),
            ("damping", self.damping),
            ("self_collision", self.self_collision),
            ("planes", self.planes),
            ("spheres", self.spheres),
            ("stretch_limit", self.stretch_limit),
        ]
    }

    /// All entries together: the change of the total energy but for rounding.
    pub fn sum(self) -> f64 {
        self.entries().iter().map(|(_, entry)| entry).sum()
    }
}

/// Keeps the ledger of a cloth while it moves.
#[derive(Clone, Debug)]
pub(crate) struct Recorder {
    /// The entries since the start of the recording.
    pub(crate) ledger: Ledger,
    /// Whether the cloth is judged by the entries; not if it is only searched for a fault.
    pub(crate) judged: bool,
    /// The entries at the start of the frame.
    frame_start: Ledger,
    /// How each point moved in the step before, in metres.
    before: Points,
    /// Energy of the springs before the step, in J.
    spring: f64,
    /// Energy of weight before the step, in J.
    gravitational: f64,
    /// Total energy after the last phase, in J.
    total: f64,
}

impl Recorder {
    /// An empty ledger for a cloth of `points` points, by which it may be `judged`.
    ///
    /// # Errors
    /// [`crate::error::Kind::Scene`] when it does not fit in memory.
    pub(crate) fn new(points: usize, judged: bool) -> Result<Self> {
        let (ledger, before) = (Ledger::default(), Points::zeros(points)?);
        Ok(Self { ledger, judged, frame_start: ledger, before, spring: 0.0, gravitational: 0.0, total: 0.0 })
    }

    /// Notes the entries at the start of a frame.
    pub(crate) fn begin_frame(&mut self) {
        self.frame_start = self.ledger;
    }

    /// Takes the entries back to the start of the frame.
    pub(crate) fn restart_frame(&mut self) {
        self.ledger = self.frame_start;
    }

    /// What each part put in since the frame began, by name.
    pub(crate) fn since_frame_start(&self) -> impl Iterator<Item = (&'static str, f64)> {
        let pairs = self.ledger.entries().into_iter().zip(self.frame_start.entries());
        pairs.map(|((name, now), (_, before))| (name, now - before))
    }

    /// Notes the state before a step.
    pub(crate) fn begin(&mut self, x: &Points, last: &Points, springs: &Springs, constants: &Constants) {
        (0..x.len()).for_each(|p| self.before.set(p, x.get(p) - last.get(p)));
        self.spring = spring_energy(x, springs);
        self.gravitational = -(0..x.len()).map(|p| dot(constants.weight, x.get(p))).sum::<f64>();
    }

    /// Enters what the integrator did. Of a point that moved by d0 and then by d1, `split` gives
    /// what damping changed of the displacement, and the force that changed the rest, in N.
    pub(crate) fn advanced(
        &mut self,
        x: &Points,
        last: &Points,
        springs: &Springs,
        pins: &Pins,
        constants: &Constants,
        split: impl Fn(usize, Vec3, Vec3) -> [Vec3; 2],
    ) {
        let Constants { mass, dt, weight, .. } = *constants;
        let inertia = mass / (2.0 * dt * dt);
        for p in pins.free.iter().cloned().flatten() {
            let (d0, d1) = (self.before.get(p), x.get(p) - last.get(p));
            let [drag, f] = split(p, d0, d1);
            self.ledger.damping += inertia * dot(drag, d0 + d1);
            self.ledger.gravity += 0.5 * dot(weight, d0 + d1);
            self.ledger.springs += 0.5 * dot(f - weight, d0 + d1);
        }
        let energy = Energy::new(x, last, springs, constants);
        self.ledger.gravity += energy.gravitational - self.gravitational;
        self.ledger.springs += energy.spring - self.spring;
        self.total = energy.total();
    }

    /// Enters what a phase after the integrator's did to the entry that `entry` picks.
    pub(crate) fn corrected(
        &mut self,
        x: &Points,
        last: &Points,
        springs: &Springs,
        constants: &Constants,
        entry: impl Fn(&mut Ledger) -> &mut f64,
    ) {
        let total = Energy::new(x, last, springs, constants).total();
        *entry(&mut self.ledger) += total - self.total;
        self.total = total;
    }
}
