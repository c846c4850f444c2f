//! How much work the phases of a step did.

use std::ops::AddAssign;

/// What was done, counted, in one step or several. The counts depend on the scene alone, not on the
/// machine or the number of threads.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub struct Counters {
    /// Steps made.
    pub steps: u64,
    /// Springs whose force, or whose part of a product with the stiffness matrix, was computed. What
    /// makes the matrix, once for some tens of products, is not counted.
    pub springs_evaluated: u64,
    /// Steps of an implicit integrator that left more than `sim.tolerance` of the forces unbalanced.
    pub unsolved_steps: u64,
    /// Points that the integrator moved on.
    pub points_advanced: u64,
    /// Cells of two or more points that self-collision searched.
    pub boxes_searched: u64,
    /// Pairs of points that shared a cell or lay in neighbouring ones, once a step.
    pub pairs_tested: u64,
    /// Points that self-collision moved.
    pub self_collision_moves: u64,
    /// Points tested against an object, once for each object.
    pub object_tests: u64,
    /// Times that an object moved a point.
    pub object_moves: u64,
    /// Springs that the stretch limit looked at, once a pass.
    pub springs_checked: u64,
    /// Springs that the stretch limit shortened.
    pub springs_limited: u64,
}

impl AddAssign for Counters {
    fn add_assign(&mut self, work: Self) {
        self.steps += work.steps;
        self.springs_evaluated += work.springs_evaluated;
        self.unsolved_steps += work.unsolved_steps;
        self.points_advanced += work.points_advanced;
        self.boxes_searched += work.boxes_searched;
        self.pairs_tested += work.pairs_tested;
        self.self_collision_moves += work.self_collision_moves;
        self.object_tests += work.object_tests;
        self.object_moves += work.object_moves;
        self.springs_checked += work.springs_checked;
        self.springs_limited += work.springs_limited;
    }
}
