//! The springs of a grid, as stencils: the six families, which of a point's neighbours each one
//! joins it to, and the rest length of every spring.
//!
//! A point owns the springs to its left, above (smaller j), upper left, upper right, two to the
//! left and two above, which are created in this order; points come in row-major order. That order
//! is part of the method. The other end always has the smaller index.

use std::ops::Range;

use super::grid::Grid;
use super::{Points, filled};
use crate::error::Result;
use crate::math::length;
use crate::scene::Cloth;

/// What a spring resists.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SpringKind {
    /// Stretch along the grid: neighbours.
    Structural,
    /// Shear: diagonal neighbours.
    Shearing,
    /// Bending: every other point of a row or column.
    Bending,
}

impl SpringKind {
    /// Every kind.
    pub const ALL: [Self; 3] = [Self::Structural, Self::Shearing, Self::Bending];

    /// Whether `cloth` has springs of this kind.
    pub fn is_enabled(self, cloth: &Cloth) -> bool {
        match self {
            Self::Structural => cloth.enable_structural,
            Self::Shearing => cloth.enable_shearing,
            Self::Bending => cloth.enable_bending,
        }
    }

    /// Stiffness of its springs, as a part of `cloth.ks`.
    pub fn relative_stiffness(self) -> f64 {
        if self == Self::Bending { 0.2 } else { 1.0 }
    }

    /// How many springs of this kind join the points of `grid`.
    fn count(self, grid: Grid) -> usize {
        let stencils = STENCILS.iter().filter(|stencil| stencil.kind == self);
        stencils.map(|stencil| stencil.columns(grid).len() * stencil.rows(grid).len()).sum()
    }

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

/// In place of the rest length of a point without a spring.
pub(super) const NO_SPRING: f64 = -1.0;

/// Entries after those of the last point, for vectors that begin with one of the last points.
pub(super) const TO_SPARE: usize = 16;

/// Which neighbour the springs of a family join their owners to.
#[derive(Clone, Copy)]
struct Stencil {
    kind: SpringKind,
    /// Columns to the left to the other end.
    left: isize,
    /// Rows up to the other end.
    up: usize,
}

/// The families in creation order.
const STENCILS: [Stencil; FAMILIES] = [
    Stencil { kind: SpringKind::Structural, left: 1, up: 0 },
    Stencil { kind: SpringKind::Structural, left: 0, up: 1 },
    Stencil { kind: SpringKind::Shearing, left: 1, up: 1 },
    Stencil { kind: SpringKind::Shearing, left: -1, up: 1 },
    Stencil { kind: SpringKind::Bending, left: 2, up: 0 },
    Stencil { kind: SpringKind::Bending, left: 0, up: 2 },
];

impl Stencil {
    /// Columns of the owners.
    fn columns(self, grid: Grid) -> Range<usize> {
        let [left, right] = [self.left.max(0), self.left.min(0)].map(isize::unsigned_abs);
        left.min(grid.width)..grid.width.saturating_sub(right)
    }

    /// Rows of the owners.
    fn rows(self, grid: Grid) -> Range<usize> {
        self.up.min(grid.height)..grid.height
    }

    /// Index of the owner minus index of the other end.
    fn offset(self, grid: Grid) -> usize {
        (self.up * grid.width).wrapping_add_signed(self.left)
    }
}

/// How many springs of each kind `cloth` has, in the order of [`SpringKind::ALL`]; 0 for a kind that is off.
pub fn counts(cloth: &Cloth) -> [usize; 3] {
    let grid = Grid { width: cloth.num_width_points, height: cloth.num_height_points };
    SpringKind::ALL.map(|kind| if kind.is_enabled(cloth) { kind.count(grid) } else { 0 })
}

/// The ends of each spring of `kinds` between the points of `grid`, owner first, in creation order.
pub fn ends(grid: Grid, kinds: &[SpringKind]) -> impl Iterator<Item = [usize; 2]> {
    let owned = move |a: usize| {
        let (i, j) = grid.column_row(a);
        let stencils = STENCILS.iter().filter(|stencil| kinds.contains(&stencil.kind));
        let exists =
            move |stencil: &&Stencil| stencil.columns(grid).contains(&i) && stencil.rows(grid).contains(&j);
        stencils.filter(exists).map(move |stencil| [a, a - stencil.offset(grid)])
    };
    (0..grid.len()).flat_map(owned)
}

/// The springs that join every point to one neighbour.
#[derive(Clone, Debug)]
pub struct Family {
    /// What the springs resist.
    pub kind: SpringKind,
    /// Place in the order of creation, 0..6.
    pub slot: usize,
    /// Columns of the owners.
    pub columns: Range<usize>,
    /// Rows of the owners.
    pub rows: Range<usize>,
    /// Columns to the left from the owner to the other end.
    pub left: isize,
    /// Rows up from the owner to the other end.
    pub up: usize,
    /// Index of the owner minus index of the other end.
    pub offset: usize,
    /// Stiffness, in N/m.
    pub stiffness: f64,
    /// Rest length of the spring that each point owns, in metres; below 0 for points without one, and for some entries after
    /// the last point.
    pub rest: Vec<f64>,
}

impl Family {
    /// Family `slot` of `cloth` whose points start at `start`.
    fn new(slot: usize, cloth: &Cloth, grid: Grid, start: &Points) -> Result<Self> {
        let stencil @ Stencil { kind, left, up } = STENCILS[slot];
        let (columns, rows, offset) = (stencil.columns(grid), stencil.rows(grid), stencil.offset(grid));
        let stiffness = cloth.ks * kind.relative_stiffness();
        let mut family = Self { kind, slot, columns, rows, left, up, offset, stiffness, rest: Vec::new() };
        family.rest = filled(grid.len() + TO_SPARE, NO_SPRING)?;
        for a in family.points(grid) {
            family.rest[a] = length(start.get(a) - start.get(a - offset));
        }
        Ok(family)
    }

    /// The points that own a spring of this family, in index order; the other end of the spring of `a` is
    /// `a - offset`.
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
        let enabled = |&slot: &usize| STENCILS[slot].kind.is_enabled(cloth);
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
