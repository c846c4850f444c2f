//! A step that is too short for the positions: what gravity adds in it is lost in their rounding.

use super::state::State;
use crate::cloth::Params;
use crate::integrator::Resolution;
use crate::math::length;

/// A position that a step is too short for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unresolved {
    /// Column and row of the point.
    pub point: (usize, usize),
    /// The coordinate: 0, 1 or 2.
    pub axis: usize,
    /// What gravity adds to the displacement in a step, in metres.
    pub fall: f64,
    /// Distance of two neighbouring numbers at the position, in metres.
    pub rounding: f64,
}

/// The part of the result that may be lost.
const PART: f64 = 0.01;

impl State {
    /// The first coordinate of a free point whose rounding loses a hundredth of what gravity does to it in `time`
    /// seconds, where that is more than the rounding of the coordinate, and than a hundredth of the way that velocity
    /// and gravity take the point.
    ///
    /// Where the velocity is the difference of two positions, each step loses up to half of the rounding of what
    /// gravity adds to it. Where the integrator keeps the velocity apart, a point stands still until it moves by half of
    /// the rounding in a step, and then goes on with the right velocity: of a fall that it does not begin for a tenth of
    /// the time, it loses a hundredth.
    pub(super) fn unresolved(&self, time: f64) -> Option<Unresolved> {
        let Params { weight, mass, dt, .. } = self.params;
        let Resolution { unit, keeps_velocity } = self.integrator.resolution();
        let gravity = weight / mass;
        for p in self.pins.free.iter().cloned().flatten() {
            let way =
                length(self.x.get(p) - self.last.get(p)) / dt * time + 0.5 * length(gravity) * time * time;
            for (axis, x) in self.x.get(p).iter().enumerate() {
                let (g, rounding) = (gravity[axis].abs(), unit * x.abs());
                let (fall, all) = (g * dt * dt, 0.5 * g * time * time);
                let least = if keeps_velocity { PART.sqrt() * g * time * dt } else { PART * fall };
                if g > 0.0 && 0.5 * rounding > least && all > rounding && all > PART * way {
                    return Some(Unresolved { point: self.grid.column_row(p), axis, fall, rounding });
                }
            }
        }
        None
    }
}
