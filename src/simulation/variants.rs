//! What other programs do in place of the method, where no scene can say it: for finding out
//! whether such a difference explains another program's positions.

use super::Simulation;
use crate::cloth::springs::SpringKind;

impl Simulation {
    /// Gives all springs of `kind` the stiffness `k`, in N/m, from the next step on.
    pub fn set_stiffness(&mut self, kind: SpringKind, k: f64) {
        let families = self.cloth.iter_mut().flat_map(|cloth| &mut cloth.springs.families);
        families.filter(|family| family.kind == kind).for_each(|family| family.stiffness = k);
    }

    /// Puts points that hit a plane so many metres above it, on the side from which they came.
    pub fn set_plane_offset(&mut self, offset: f64) {
        self.cloth.iter_mut().for_each(|cloth| cloth.colliders.set_plane_offset(offset));
    }

    /// Makes cells of self-collision one if `hash` of their three numbers is the same.
    pub fn set_cell_hash(&mut self, hash: fn([i64; 3]) -> i64) {
        if let Some(cloth) = &mut self.cloth
            && let Some(self_collision) = &mut cloth.self_collision
        {
            self_collision.set_cell_hash(hash, &cloth.x);
        }
    }
}
