//! The stiffness matrix of the springs, which is never built: what it does to displacements.
//!
//! A spring of stiffness k, length l and rest length l0 in direction n resists the displacement δ
//! of one end against the other with `k (n nᵀ + (1 - l0 / l)(I - n nᵀ)) δ`. Where it is shorter than
//! at rest the second part is left out, so that the matrix has no negative eigenvalue (Choi and Ko
//! 2002); Newton's method then still ends at the same point.

use std::ops::Range;

use super::blocks::Blocks;
use crate::cloth::accumulate::Accumulator;
use crate::cloth::springs::{Family, Springs};
use crate::cloth::{Points, filled};
use crate::error::Result;
use crate::lanes::level::dispatch_plain;

/// The springs of one family where they are now, an entry a point.
#[derive(Clone, Debug)]
struct Tangents {
    /// `sqrt(k - b) n`: what resists along the spring is `along (along · δ)`.
    along: Points,
    /// b, what resists in every direction, in N/m: `k (1 - l0 / l)`, or 0 where that is negative.
    all: Vec<f64>,
}

/// The stiffness of the springs of a cloth where they are now.
#[derive(Clone, Debug)]
pub(super) struct Stiffness {
    accumulator: Accumulator<f64>,
    families: Vec<Tangents>,
    /// What joins the components of one point.
    blocks: Blocks,
}

impl Stiffness {
    /// Room for the stiffness of `springs`.
    ///
    /// # Errors
    /// [`crate::error::Kind::Scene`] when it does not fit in memory.
    pub(super) fn new(springs: &Springs) -> Result<Self> {
        let points = springs.grid.len();
        let tangents = || Ok(Tangents { along: Points::zeros(points)?, all: filled(points, 0.0)? });
        let families = springs.families.iter().map(|_| tangents()).collect::<Result<_>>()?;
        Ok(Self { accumulator: Accumulator::new(springs)?, families, blocks: Blocks::zeros(points)? })
    }

    /// The blocks on the diagonal of the matrix, in N/m.
    pub(super) fn blocks(&self) -> &Blocks {
        &self.blocks
    }

    /// Takes the stiffness of `springs` with the points at `x`.
    pub(super) fn update(&mut self, x: &Points, springs: &Springs) {
        self.blocks.clear();
        for (family, tangents) in springs.families.iter().zip(&mut self.families) {
            dispatch_plain!(tangents.update(x, family, springs.grid.width, &mut self.blocks));
        }
    }

    /// What the springs do, in N, when the points move by `moves`: minus the matrix times `moves`.
    pub(super) fn resist(&mut self, moves: &Points, springs: &Springs) -> &Points {
        let families = &self.families;
        self.accumulator.accumulate(
            springs,
            [0.0; 3],
            #[inline(always)]
            |index, family, points, out| families[index].resist(moves, family.offset, points, out),
        );
        &self.accumulator.sum
    }
}

impl Tangents {
    /// Takes the stiffness of the springs of `family`, row by row, and adds it to the blocks of both ends.
    #[inline(always)]
    fn update(&mut self, x: &Points, family: &Family, width: usize, blocks: &mut Blocks) {
        for j in family.rows.clone() {
            let points = j * width + family.columns.start..j * width + family.columns.end;
            self.set(x, family, points.clone());
            let along = self.along.components().map(|along| &along[points.clone()]);
            let all = &self.all[points.clone()];
            blocks.add(points.clone(), along, all);
            blocks.add(points.start - family.offset..points.end - family.offset, along, all);
        }
    }

    /// Takes the stiffness of the springs of `family` that `points` own.
    #[inline(always)]
    fn set(&mut self, x: &Points, family: &Family, points: Range<usize>) {
        let n = points.len();
        let b = points.start - family.offset..points.end - family.offset;
        let [ax, ay, az] = x.components().map(|x| &x[points.clone()][..n]);
        let [bx, by, bz] = x.components().map(|x| &x[b.clone()][..n]);
        let rest = &family.rest[points.clone()][..n];
        let [nx, ny, nz] = self.along.components_mut().map(|along| &mut along[points.clone()][..n]);
        let all = &mut self.all[points][..n];
        for i in 0..n {
            let (ex, ey, ez) = (bx[i] - ax[i], by[i] - ay[i], bz[i] - az[i]);
            let l = (ex * ex + ey * ey + ez * ez).sqrt();
            // A spring without length has no direction, and resists nothing.
            let k = if l == 0.0 { 0.0 } else { family.stiffness };
            let l = if l == 0.0 { 1.0 } else { l };
            let slack = k * (1.0 - rest[i] / l);
            all[i] = if slack > 0.0 { slack } else { 0.0 };
            let scale = (k - all[i]).sqrt() / l;
            (nx[i], ny[i], nz[i]) = (ex * scale, ey * scale, ez * scale);
        }
    }

    /// What the springs that `points` own add to their owners.
    #[inline(always)]
    fn resist(&self, moves: &Points, offset: usize, points: Range<usize>, out: [&mut [f64]; 3]) {
        let n = points.len();
        let b = points.start - offset..points.end - offset;
        let [out_x, out_y, out_z] = out.map(|out| &mut out[..n]);
        let [ax, ay, az] = moves.components().map(|moves| &moves[points.clone()][..n]);
        let [bx, by, bz] = moves.components().map(|moves| &moves[b.clone()][..n]);
        let [nx, ny, nz] = self.along.components().map(|along| &along[points.clone()][..n]);
        let all = &self.all[points][..n];
        for i in 0..n {
            let (dx, dy, dz) = (bx[i] - ax[i], by[i] - ay[i], bz[i] - az[i]);
            let along = nx[i] * dx + ny[i] * dy + nz[i] * dz;
            out_x[i] = nx[i] * along + all[i] * dx;
            out_y[i] = ny[i] * along + all[i] * dy;
            out_z[i] = nz[i] * along + all[i] * dz;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cloth::grid::{self, Grid};
    use crate::math::splitmix64;
    use crate::scene::{Vec3, load_text};

    /// A block is what the springs at a point resist with when it alone moves, by one metre along each axis.
    #[test]
    fn blocks_are_those_of_the_matrix() {
        let scene = load_text("a.json", include_str!("../../scenes/pinned2.json"), &Default::default())
            .unwrap()
            .scene;
        let mut cloth = scene.cloth.unwrap();
        (cloth.num_width_points, cloth.num_height_points) = (5, 4);
        let grid = Grid::new(&cloth).unwrap();
        let mut x = grid::start(&cloth, grid).unwrap();
        let springs = Springs::new(&cloth, grid, &x).unwrap();
        let random = |seed: usize| (splitmix64(seed as u64) >> 11) as f64 / 9_007_199_254_740_992.0;
        (0..x.len()).for_each(|p| x.set(p, x.get(p) + Vec3::from([0, 1, 2].map(|i| random(3 * p + i)))));
        let mut stiffness = Stiffness::new(&springs).unwrap();
        stiffness.update(&x, &springs);
        for p in 0..x.len() {
            let (diagonal, mixed) = (stiffness.blocks.diagonal.get(p), stiffness.blocks.mixed.get(p));
            let rows = [
                Vec3::new(diagonal.x, mixed.x, mixed.y),
                Vec3::new(mixed.x, diagonal.y, mixed.z),
                Vec3::new(mixed.y, mixed.z, diagonal.z),
            ];
            for (axis, row) in rows.into_iter().enumerate() {
                let mut unit = Points::zeros(x.len()).unwrap();
                unit.components_mut()[axis][p] = 1.0;
                let resisted = -stiffness.resist(&unit, &springs).get(p);
                assert!((resisted - row).norm() < 1e-12 * row.norm(), "point {p}: {row:?}, not {resisted:?}");
            }
        }
    }
}
