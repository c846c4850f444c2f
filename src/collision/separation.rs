//! How a point that is too close to others is moved: the rule of both searches for close pairs.

use crate::math::dot;
use crate::scene::{Cloth, Sim, Vec3};

/// When and how far points move apart.
#[derive(Clone, Copy, Debug)]
pub(super) struct Separation {
    /// Distance that two points keep, in metres: 2 · thickness.
    pub(super) distance: f64,
    /// Steps per frame, which share one correction.
    steps_per_frame: f64,
}

impl Separation {
    /// The rule for `cloth`.
    pub(super) fn new(cloth: &Cloth, sim: &Sim) -> Self {
        Self { distance: 2.0 * cloth.thickness, steps_per_frame: f64::from(sim.steps_per_frame) }
    }

    /// The rule of a distance, in metres, and so many steps a frame.
    #[cfg(test)]
    pub(super) fn of(distance: f64, steps_per_frame: f64) -> Self {
        Self { distance, steps_per_frame }
    }

    /// Where a point at `position` goes after `pushes`; `None` without any.
    #[inline(always)]
    pub(super) fn corrected(&self, position: Vec3, pushes: &Pushes) -> Option<Vec3> {
        let Pushes { sum, count } = *pushes;
        (count > 0.0).then(|| position + sum * (1.0 / count / self.steps_per_frame))
    }
}

/// What the points around one point do to it.
#[derive(Clone, Copy, Default)]
pub(super) struct Pushes {
    sum: Vec3,
    count: f64,
}

impl Pushes {
    /// Adds the push of a point that is `e` away, if that is too close.
    #[inline(always)]
    pub(super) fn add(&mut self, e: Vec3, rule: &Separation) {
        let l = dot(e, e).sqrt();
        if 0.0 < l && l < rule.distance {
            self.sum += e * ((rule.distance - l) / l);
            self.count += 1.0;
        }
    }
}
