//! The energies of a cloth.

use crate::cloth::springs::Springs;
use crate::cloth::{Params, Points};
use crate::math::{dot, length};

/// The energies of a cloth, in J.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize)]
pub struct Energy {
    /// Of motion: `m v² / 2` with `v = (x - last) / dt`, summed over the points. After a step
    /// `last` is the position before it, so v is the mean velocity of that step and holds what
    /// collisions and the stretch limit did to the position.
    pub kinetic: f64,
    /// Of the springs: `k (l - l0)² / 2`, summed.
    pub spring: f64,
    /// Of weight: `-m g · x`, summed; zero at the origin.
    pub gravitational: f64,
}

impl Energy {
    /// The energies of points at `x` that were at `last` one step ago.
    pub fn new(x: &Points, last: &Points, springs: &Springs, params: &Params) -> Self {
        Self { spring: spring_energy(x, springs), ..Self::without_springs(x, last, params) }
    }

    /// The same, but nothing for the springs.
    pub(crate) fn without_springs(x: &Points, last: &Points, params: &Params) -> Self {
        let mut energy = Self::default();
        for p in 0..x.len() {
            let velocity = (x.get(p) - last.get(p)) / params.dt;
            energy.kinetic += 0.5 * params.mass * dot(velocity, velocity);
            energy.gravitational -= dot(params.weight, x.get(p));
        }
        energy
    }

    /// The sum of all three.
    pub fn total(self) -> f64 {
        self.kinetic + self.spring + self.gravitational
    }
}

/// The energy of all springs at `x`.
pub(crate) fn spring_energy(x: &Points, springs: &Springs) -> f64 {
    let mut energy = 0.0;
    for family in &springs.families {
        for a in family.points(springs.grid) {
            let strain = length(x.get(a - family.offset) - x.get(a)) - family.rest[a];
            energy += 0.5 * family.stiffness * strain * strain;
        }
    }
    energy
}
