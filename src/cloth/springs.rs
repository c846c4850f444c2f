//! The springs of a grid, as stencils: the six families, which of a point's neighbours each one
//! joins it to, and the rest length of every spring.
//!
//! A point makes the springs to its left, above (smaller j), upper left, upper right, two to the
//! left and two above, in this order; points make theirs in row-major order. That order is part
//! of the method. The other end always has the smaller index.

use std::ops::Range;

use super::grid::Grid;
use super::{Points, filled, len};
use crate::error::Result;
use crate::scene::Cloth;

/// What a spring resists.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SpringKind {
    /// Stretch along the grid: neighbours.
    Structural,
    /// Shear: diagonal neighbours.
    Shearing,
    /// Bending: every other point of a row or column, with 0.2 of the stiffness.
    Bending,
}

impl SpringKind {
    /// What scenes and messages call springs of this kind.
    pub fn name(self) -> &'static str {
        match self {
            Self::Structural => "structural",
            Self::Shearing => "shearing",
            Self::Bending => "bending",
        }
    }
}

/// How many families of springs there are.
pub const FAMILIES: usize = 6;

/// The families in creation order: kind, columns to the left of the other end, rows up to it.
const STENCILS: [(SpringKind, isize, usize); FAMILIES] = [
    (SpringKind::Structural, 1, 0),
    (SpringKind::Structural, 0, 1),
    (SpringKind::Shearing, 1, 1),
    (SpringKind::Shearing, -1, 1),
    (SpringKind::Bending, 2, 0),
    (SpringKind::Bending, 0, 2),
];

/// The springs that join every point to one neighbour.
#[derive(Clone, Debug)]
pub struct Family {
    /// What the springs resist.
    pub kind: SpringKind,
    /// Place in the order of creation, 0..6.
    pub slot: usize,
    /// Columns of the points that have such a spring.
    pub columns: Range<usize>,
    /// Rows of the points that have such a spring.
    pub rows: Range<usize>,
    /// Index of a point minus index of the other end.
    pub offset: usize,
    /// Stiffness, in N/m.
    pub stiffness: f64,
    /// Rest length of each point's spring, in metres; 0 for points without one.
    pub rest: Vec<f64>,
}

impl Family {
    /// Family `slot` of `cloth` whose points start at `start`.
    fn new(slot: usize, cloth: &Cloth, grid: Grid, start: &Points) -> Result<Self> {
        let (kind, left, up) = STENCILS[slot];
        let columns =
            left.max(0).unsigned_abs().min(grid.width)..grid.width.saturating_sub(left.min(0).unsigned_abs());
        let rows = up.min(grid.height)..grid.height;
        let offset = (up * grid.width).wrapping_add_signed(left);
        let stiffness = if kind == SpringKind::Bending { cloth.ks * 0.2 } else { cloth.ks };
        let mut family = Self { kind, slot, columns, rows, offset, stiffness, rest: Vec::new() };
        family.rest = filled(grid.len(), 0.0)?;
        for a in family.points(grid) {
            family.rest[a] = len(start.get(a) - start.get(a - offset));
        }
        Ok(family)
    }

    /// The points that have a spring of this family, in index order.
    /// The other end of point `a`'s spring is `a - offset`.
    pub fn points(&self, grid: Grid) -> impl Iterator<Item = usize> + use<> {
        let columns = self.columns.clone();
        self.rows.clone().flat_map(move |j| columns.clone().map(move |i| j * grid.width + i))
    }

    /// How many springs the family has.
    pub fn len(&self) -> usize {
        self.columns.len() * self.rows.len()
    }

    /// Whether the family has no spring.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

/// Every spring of a cloth.
#[derive(Clone, Debug, Default)]
pub struct Springs {
    /// The grid that the springs join.
    pub grid: Grid,
    /// The families of the kinds that are switched on, in creation order.
    pub families: Vec<Family>,
}

impl Springs {
    /// The springs of `cloth` whose points start at `start`.
    ///
    /// # Errors
    /// [`crate::error::Kind::Scene`] when they do not fit in memory.
    pub fn new(cloth: &Cloth, grid: Grid, start: &Points) -> Result<Self> {
        let enabled = |&slot: &usize| match STENCILS[slot].0 {
            SpringKind::Structural => cloth.enable_structural,
            SpringKind::Shearing => cloth.enable_shearing,
            SpringKind::Bending => cloth.enable_bending,
        };
        let family = |slot| Family::new(slot, cloth, grid, start);
        let families = (0..FAMILIES).filter(enabled).map(family).collect::<Result<_>>()?;
        Ok(Self { grid, families })
    }

    /// How many springs there are.
    pub fn len(&self) -> usize {
        self.families.iter().map(Family::len).sum()
    }

    /// Whether there is no spring.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Whether springs of `kind` exist.
    pub fn has(&self, kind: SpringKind) -> bool {
        self.families.iter().any(|family| family.kind == kind)
    }
}
