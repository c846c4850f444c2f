//! What conjugate gradients are preconditioned with: block Jacobi, or multigrid where the springs are stiff for the step.

use super::block_jacobi::BlockJacobi;
use super::matrix::Matrix;
use super::multigrid::{Multigrid, System};
use crate::cloth::{Model, Params, Points};
use crate::error::Result;
use crate::scene::{Cloth, Sim};

/// The least stiffness of a spring, as a part of the inertia of a point `m / dt²`, for which multigrid takes less time.
const STIFF: f64 = 20.0;

/// The preconditioner of a cloth.
#[derive(Clone, Debug)]
pub(super) struct Preconditioner {
    blocks: BlockJacobi,
    multigrid: Option<Multigrid>,
}

impl Preconditioner {
    /// The preconditioner of `cloth`, moved as `sim` says.
    ///
    /// # Errors
    /// [`crate::error::Kind::Scene`] when it does not fit in memory.
    pub(super) fn new(cloth: &Cloth, sim: &Sim, points: usize) -> Result<Self> {
        let Params { mass, dt, .. } = Params::new(cloth, sim);
        let is_stiff = cloth.ks * dt * dt > STIFF * mass;
        let multigrid = is_stiff.then(|| Multigrid::new(cloth)).transpose()?;
        Ok(Self { blocks: BlockJacobi::new(points)?, multigrid })
    }

    /// Takes the matrix, with the points at `x`.
    pub(super) fn update(&mut self, x: &Points, matrix: &mut Matrix, model: Model<'_>) {
        self.blocks.update(&matrix.inertia, matrix.stiffness.blocks());
        if let Some(multigrid) = &mut self.multigrid {
            multigrid.update(x, &mut system(matrix, &self.blocks, model));
        }
    }

    /// Makes `out` the preconditioner's inverse times `r`; how many springs that visited.
    pub(super) fn apply(
        &mut self,
        r: &Points,
        out: &mut Points,
        matrix: &mut Matrix,
        model: Model<'_>,
    ) -> u64 {
        match &mut self.multigrid {
            Some(multigrid) => multigrid.apply(r, out, system(matrix, &self.blocks, model)),
            None => {
                self.blocks.apply(r, 1.0, out);
                0
            }
        }
    }
}

/// The system on the grid of the cloth.
fn system<'a>(matrix: &'a mut Matrix, smoother: &'a BlockJacobi, model: Model<'a>) -> System<'a> {
    System { springs: model.springs, pins: model.pins, matrix, smoother }
}

#[cfg(test)]
mod tests {
    use super::super::blocks::Blocks;
    use super::super::conjugate_gradients::ConjugateGradients;
    use super::super::vectors::{add, dot, length};
    use super::*;
    use crate::cloth::grid::{self, Grid, Pins};
    use crate::cloth::springs::Springs;
    use crate::lanes::level::Level;
    use crate::math::splitmix64;
    use crate::scene::{Vec3, load_text};

    /// A wrinkled cloth that is pulled at, with springs so many times as stiff as the inertia of a point.
    struct Pulled {
        cloth: Cloth,
        springs: Springs,
        pins: Pins,
        params: Params,
        x: Points,
        matrix: Matrix,
        right: Points,
    }

    /// Numbers from -1 to 1, 0 for pinned points.
    fn random(seed: usize, pins: &Pins) -> Points {
        let number = |i: usize| (splitmix64((seed + i) as u64) >> 11) as f64 / 4_503_599_627_370_496.0 - 1.0;
        let mut points = Points::zeros(pins.pinned.len()).unwrap();
        for p in pins.free.iter().cloned().flatten() {
            points.set(p, Vec3::new(number(3 * p), number(3 * p + 1), number(3 * p + 2)));
        }
        points
    }

    impl Pulled {
        fn new([width, height]: [usize; 2], pinned: &[[usize; 2]], stiffness: f64) -> Self {
            let loaded = load_text("a.json", include_str!("../../scenes/pinned2.json"), &Default::default());
            let scene = loaded.unwrap().scene;
            let mut cloth = scene.cloth.unwrap();
            (cloth.num_width_points, cloth.num_height_points, cloth.ks) = (width, height, stiffness);
            cloth.pinned = pinned.to_vec();
            let (grid, params) = (Grid::new(&cloth).unwrap(), Params::new(&cloth, &scene.sim));
            let mut x = grid::start(&cloth, grid).unwrap();
            let springs = Springs::new(&cloth, grid, &x).unwrap();
            let pins = Pins::new(&cloth, grid).unwrap();
            add(&mut x, 0.1 / width.max(height) as f64, &random(1, &pins));
            let mut matrix = Matrix::new(&springs).unwrap();
            matrix.stiffness.update(&x, &springs);
            let right = random(100_000, &pins);
            Self { cloth, springs, pins, params, x, matrix, right }
        }

        /// Block Jacobi, or multigrid.
        fn preconditioner(&mut self, is_multigrid: bool) -> Preconditioner {
            let multigrid = is_multigrid.then(|| Multigrid::new(&self.cloth).unwrap());
            let blocks = BlockJacobi::new(self.x.len()).unwrap();
            let mut preconditioner = Preconditioner { blocks, multigrid };
            let Self { springs, pins, params, x, matrix, .. } = self;
            preconditioner.update(x, matrix, Model { springs, pins, params });
            preconditioner
        }

        /// `P⁻¹ r`
        fn apply(&mut self, preconditioner: &mut Preconditioner, r: &Points) -> Points {
            let mut out = Points::zeros(r.len()).unwrap();
            let Self { springs, pins, params, matrix, .. } = self;
            preconditioner.apply(r, &mut out, matrix, Model { springs, pins, params });
            out
        }

        /// The solution, and how many times all springs were visited.
        fn solve(&mut self, preconditioner: &mut Preconditioner) -> (Points, f64) {
            let Self { springs, pins, params, matrix, right, .. } = self;
            let model = Model { springs, pins, params };
            let mut method = ConjugateGradients::new(right.len()).unwrap();
            let visited = method.solve(right, 1e-9 * length(right), matrix, preconditioner, model);
            (method.solution, visited as f64 / springs.len() as f64)
        }
    }

    /// The solution is the same whatever the preconditioner. Blocks take fewer visits of the springs than the diagonal
    /// alone (Jacobi), the diagonal fewer than nothing. Multigrid takes fewest, even here, where points are displaced at
    /// random, so that the springs of coarser grids are least like the fine ones.
    #[test]
    fn each_preconditioner_saves_what_it_should() {
        for (stiffness, of_diagonal, of_blocks) in [(1e2, 1.0, 1.0), (1e4, 1.0, 0.7), (1e6, 1.0, 0.9)] {
            let mut cloth = Pulled::new([33, 20], &[[0, 0], [32, 0]], stiffness);
            let (solution, blocks) = {
                let mut blocks = cloth.preconditioner(false);
                cloth.solve(&mut blocks)
            };
            let mut visits = vec![blocks];
            for name in ["multigrid", "diagonal", "nothing"] {
                let mut other = cloth.preconditioner(name == "multigrid");
                let own = cloth.matrix.stiffness.blocks().clone();
                let zeros = Blocks::zeros(solution.len()).unwrap();
                match name {
                    "diagonal" => {
                        other.blocks.update(&cloth.matrix.inertia, &Blocks { mixed: zeros.mixed, ..own })
                    }
                    "nothing" => other.blocks.update(&cloth.matrix.inertia, &zeros),
                    _ => (),
                }
                let (mut found, visited) = cloth.solve(&mut other);
                add(&mut found, -1.0, &solution);
                let away = length(&found) / length(&solution);
                assert!(away < 1e-5, "{name}, stiffness {stiffness:e}: {away:e} of the solution");
                visits.push(visited);
            }
            let [blocks, multigrid, diagonal, nothing] = visits[..] else { unreachable!() };
            assert!(blocks < of_diagonal * diagonal, "{stiffness:e}: {visits:?}");
            assert!(diagonal < nothing, "{stiffness:e}: {visits:?}");
            assert!(multigrid < of_blocks * blocks, "{stiffness:e}: {visits:?}");
        }
    }

    /// Both preconditioners are symmetric and positive definite, on grids of every shape, with pins between the
    /// points of coarser grids and without any.
    #[test]
    fn they_are_symmetric_and_positive_definite() {
        for (grid, pinned) in [
            ([2, 2], vec![]),
            ([2, 9], vec![[0, 0]]),
            ([3, 2], vec![[1, 1]]),
            ([17, 12], vec![[0, 0], [7, 5], [16, 11]]),
            ([12, 16], vec![]),
        ] {
            for stiffness in [1e-3, 1e2, 1e8] {
                let mut cloth = Pulled::new(grid, &pinned, stiffness);
                for is_multigrid in [false, true] {
                    let mut p = cloth.preconditioner(is_multigrid);
                    for seed in 0..20 {
                        let [a, b] = [seed, seed + 1000].map(|seed| random(seed * 10_000, &cloth.pins));
                        let [pa, pb] = [&a, &b].map(|r| cloth.apply(&mut p, r));
                        let (one, other) = (dot(&b, &pa), dot(&a, &pb));
                        let size = (dot(&a, &pa) * dot(&b, &pb)).sqrt();
                        let name = format!("{grid:?} {pinned:?} {stiffness:e} {is_multigrid}");
                        assert!(dot(&a, &pa) > 0.0 && dot(&b, &pb) > 0.0, "{name}");
                        assert!(
                            (one - other).abs() < 1e-9 * size,
                            "{name}: {one:e} and {other:e} of {size:e}"
                        );
                        assert!(cloth.pins.held().all(|p| pa.get(p) == Vec3::zeros()), "{name}: pins");
                    }
                }
            }
        }
    }

    /// Copies of the loops for wider vectors do the same operations.
    #[test]
    fn every_level_gives_the_same_bits() {
        let mut first = None;
        Level::for_each(|level| {
            let mut cloth = Pulled::new([19, 14], &[[0, 0], [5, 5]], 1e4);
            let [blocks, multigrid] = [false, true].map(|is_multigrid| {
                let mut preconditioner = cloth.preconditioner(is_multigrid);
                cloth.solve(&mut preconditioner).0
            });
            let found = [blocks, multigrid];
            assert!(*first.get_or_insert_with(|| found.clone()) == found, "{level:?}");
        });
    }

    /// On a grid of 2 x 2 points a cycle is the solution.
    #[test]
    fn the_coarsest_grid_is_solved_exactly() {
        for pinned in [vec![], vec![[1, 0]], vec![[0, 0], [0, 1], [1, 0], [1, 1]]] {
            let mut cloth = Pulled::new([2, 2], &pinned, 100.0);
            let mut p = cloth.preconditioner(true);
            let right = cloth.right.clone();
            let solution = cloth.apply(&mut p, &right);
            let mut rest = Points::zeros(4).unwrap();
            cloth.matrix.subtract(&solution, &right, &mut rest, (&cloth.springs, &cloth.pins));
            assert!(length(&rest) < 1e-12, "{pinned:?}: {:e} N left", length(&rest));
        }
    }
}
