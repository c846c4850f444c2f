//! The phases of a step.

/// A phase of a step, in the order in which they come.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Phase {
    /// 1: the weight of every point and the pull of its springs.
    Forces,
    /// 2: the integrator moves every free point on.
    Integration,
    /// 3: close points of the cloth move apart.
    SelfCollision,
    /// 4: points that went through a plane are put back.
    Planes,
    /// 4: points that went into a sphere are put back.
    Spheres,
    /// 5: springs that are too long are shortened.
    StretchLimit,
    /// After the step: points that are still behind a plane leave it.
    LeavePlanes,
    /// After the step: points that are still inside a sphere leave it.
    LeaveSpheres,
}
