//! A V-cycle of geometric multigrid as preconditioner (Briggs, Henson and McCormick 2000, *A Multigrid
//! Tutorial*; as preconditioner of conjugate gradients, Tatebe 1993).
//!
//! Block Jacobi sees one point at a time, so a pull at one end of the cloth needs as many iterations as there are
//! points to the other end. Each coarser grid has half as many points a side, springs of its own, of the same stiffness,
//! between points that are points of the cloth, and the inertia of the points that move with each of
//! them; it is pinned where any of these is. On every grid a step of damped block Jacobi takes away what differs from point to point; the rest is
//! solved on the coarser grid; a second step makes the whole symmetric. The last grid has 2 × 2 points.
//!
//! Of all springs `(a - b)ᵀ K (a - b) <= 2 (aᵀ K a + bᵀ K b)`. So no eigenvalue of `P⁻¹ A` is above 2, and damped by 2/3
//! the smoother neither overshoots on any grid nor needs an estimate. With that the cycle is symmetric and positive definite
//! whatever the coarser grids do; that their springs are not the fine ones costs iterations, not the solution.

use super::block_jacobi::BlockJacobi;
use super::dense::Dense;
use super::matrix::Matrix;
use super::transfer::Transfer;
use crate::cloth::grid::{self, Grid, Pins};
use crate::cloth::springs::Springs;
use crate::cloth::{Points, filled};
use crate::error::Result;
use crate::scene::Cloth;

/// The part of a step of block Jacobi that smooths.
const DAMPING: f64 = 2.0 / 3.0;

/// The grids, and the solution on the coarsest.
#[derive(Clone, Debug)]
pub(super) struct Multigrid {
    /// Room on the finest grid for what is left of the right side.
    rest: Points,
    /// The coarser grids, finest first.
    coarser: Vec<Coarse>,
    exact: Dense,
}

/// A coarser grid.
#[derive(Clone, Debug)]
struct Coarse {
    /// From the grid before it.
    transfer: Transfer,
    springs: Springs,
    pins: Pins,
    x: Points,
    matrix: Matrix,
    smoother: BlockJacobi,
    right: Points,
    solution: Points,
    rest: Points,
}

/// A system on a grid.
pub(super) struct System<'a> {
    pub(super) springs: &'a Springs,
    pub(super) pins: &'a Pins,
    pub(super) matrix: &'a mut Matrix,
    pub(super) smoother: &'a BlockJacobi,
}

impl Multigrid {
    /// The grids of `cloth`.
    ///
    /// # Errors
    /// [`crate::error::Kind::Scene`] when they do not fit in memory.
    pub(super) fn new(cloth: &Cloth) -> Result<Self> {
        let mut grid = Grid::new(cloth)?;
        let mut start = grid::start(cloth, grid)?;
        let mut pins = Pins::new(cloth, grid)?;
        let rest = Points::zeros(grid.len())?;
        let mut coarser = Vec::new();
        while grid.width > 2 || grid.height > 2 {
            let coarse = Coarse::new(cloth, grid, &mut start, &pins)?;
            (grid, pins) = (coarse.transfer.coarse, coarse.pins.clone());
            coarser.push(coarse);
        }
        Ok(Self { rest, coarser, exact: Dense::new()? })
    }

    /// Takes the matrix of the finest grid, with the points at `x`, to the coarser ones.
    pub(super) fn update(&mut self, x: &Points, finest: &mut System<'_>) {
        let (mut x, mut inertia) = (x, finest.matrix.inertia.as_slice());
        for coarse in &mut self.coarser {
            coarse.update(x, inertia);
            (x, inertia) = (&coarse.x, &coarse.matrix.inertia);
        }
        match self.coarser.last_mut() {
            Some(Coarse { springs, pins, matrix, .. }) => self.exact.update(matrix, springs, pins),
            None => self.exact.update(finest.matrix, finest.springs, finest.pins),
        }
    }

    /// Makes `solution` the result of a cycle for `right`; how many springs it visited.
    pub(super) fn apply(&mut self, right: &Points, solution: &mut Points, finest: System<'_>) -> u64 {
        cycle(finest, right, solution, &mut self.rest, &mut self.coarser, &self.exact)
    }
}

/// A cycle from one grid down and back; how many springs it visited.
fn cycle(
    system: System<'_>,
    right: &Points,
    solution: &mut Points,
    rest: &mut Points,
    coarser: &mut [Coarse],
    exact: &Dense,
) -> u64 {
    let System { springs, pins, matrix, smoother } = system;
    let Some((next, coarser)) = coarser.split_first_mut() else {
        exact.solve(right, solution);
        return 0;
    };
    smoother.apply(right, DAMPING, solution);
    matrix.subtract(solution, right, rest, (springs, pins));
    let visited = next.correct(rest, solution, coarser, exact);
    clear(solution, pins);
    matrix.subtract(solution, right, rest, (springs, pins));
    smoother.add(rest, DAMPING, solution);
    visited + 2 * springs.len() as u64
}

impl Coarse {
    /// The grid after `fine`; makes `start`, where the points of that start, where those of this one do.
    fn new(cloth: &Cloth, fine: Grid, start: &mut Points, pins: &Pins) -> Result<Self> {
        let transfer = Transfer::new(fine)?;
        let grid = transfer.coarse;
        let zeros = || Points::zeros(grid.len());
        let mut coarse_start = zeros()?;
        (0..grid.len()).for_each(|p| coarse_start.set(p, start.get(transfer.fine_point(p))));
        *start = coarse_start;
        let springs = Springs::new(cloth, grid, start)?;
        let mut pinned = filled(grid.len(), false)?;
        pins.held().flat_map(|p| transfer.coarse_points(p)).for_each(|p| pinned[p] = true);
        Ok(Self {
            pins: Pins::of(pinned),
            x: zeros()?,
            matrix: Matrix::new(&springs)?,
            smoother: BlockJacobi::new(grid.len())?,
            right: zeros()?,
            solution: zeros()?,
            rest: zeros()?,
            springs,
            transfer,
        })
    }

    /// Takes the matrix of the grid before it, whose points are at `x`.
    fn update(&mut self, x: &Points, inertia: &[f64]) {
        (0..self.x.len()).for_each(|p| self.x.set(p, x.get(self.transfer.fine_point(p))));
        self.transfer.restrict_numbers(inertia, &mut self.matrix.inertia);
        self.matrix.stiffness.update(&self.x, &self.springs);
        self.smoother.update(&self.matrix.inertia, self.matrix.stiffness.blocks());
    }

    /// Adds to `solution`, on the grid before it, what this and the coarser ones make of what is left there; how many springs
    /// that visited.
    fn correct(&mut self, left: &Points, solution: &mut Points, coarser: &mut [Self], exact: &Dense) -> u64 {
        self.transfer.restrict(left, &mut self.right);
        clear(&mut self.right, &self.pins);
        let Self { springs, pins, matrix, smoother, .. } = self;
        let system = System { springs, pins, matrix, smoother };
        let visited = cycle(system, &self.right, &mut self.solution, &mut self.rest, coarser, exact);
        self.transfer.prolong(&self.solution, solution);
        visited
    }
}

/// Makes the vectors of pinned points 0.
fn clear(vectors: &mut Points, pins: &Pins) {
    for p in pins.held() {
        vectors.components_mut().into_iter().for_each(|numbers| numbers[p] = 0.0);
    }
}
