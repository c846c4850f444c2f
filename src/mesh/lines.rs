//! The springs of a cloth as lines.

use super::index;
use crate::cloth::grid::Grid;
use crate::cloth::springs::{self, SpringKind};
use crate::scene::Cloth;

/// Kinds of springs to show as lines.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SpringKinds {
    /// To the next point along a row or column.
    pub structural: bool,
    /// To the next point along a diagonal.
    pub shearing: bool,
    /// To the next but one along a row or column.
    pub bending: bool,
}

impl SpringKinds {
    /// The kinds that a cloth has.
    pub fn of(cloth: &Cloth) -> Self {
        let [structural, shearing, bending] = SpringKind::ALL.map(|kind| kind.is_enabled(cloth));
        Self { structural, shearing, bending }
    }

    /// The kinds as a list.
    fn list(self) -> Vec<SpringKind> {
        let shown = [self.structural, self.shearing, self.bending];
        SpringKind::ALL.into_iter().zip(shown).filter(|(_, shown)| *shown).map(|(kind, _)| kind).collect()
    }
}

/// The springs of a cloth as lines between its points, in the order in which they are created.
pub fn spring_lines(cloth: &Cloth, kinds: SpringKinds) -> Vec<[u32; 2]> {
    let grid = Grid { width: cloth.num_width_points, height: cloth.num_height_points };
    springs::ends(grid, &kinds.list()).map(|ends| ends.map(index)).collect()
}
