//! Other stiffnesses than a scene can give.

use super::Simulation;
use crate::cloth::springs::SpringKind;

impl Simulation {
    /// Gives all springs of `kind` the stiffness `k`, in N/m, from the next step on.
    pub fn set_stiffness(&mut self, kind: SpringKind, k: f64) {
        let families = self.cloth.iter_mut().flat_map(|cloth| &mut cloth.springs.families);
        families.filter(|family| family.kind == kind).for_each(|family| family.stiffness = k);
    }
}
