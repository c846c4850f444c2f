//! The phases of a step.

use crate::scene::ColliderKind;

/// A phase of a step, in the order in which they come.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Phase {
    /// 1: the weight of every point and the pull of its springs.
    Forces,
    /// 2: the integrator moves every free point on.
    Integration,
    /// 3: close points of the cloth move apart.
    SelfCollision,
    /// 4: the contacts with the objects of one kind are resolved.
    Collision(ColliderKind),
    /// 5: springs that are too long are shortened.
    StretchLimit,
    /// After the step: points that are still inside an object of one kind are put outside.
    Depenetration(ColliderKind),
    /// After the step, under `sim.contact` = `coulomb`: contact ends approach and brakes slides.
    Contact,
}
