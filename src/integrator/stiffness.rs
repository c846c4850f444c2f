//! The stiffness matrix of the springs, which is never built: what it does to displacements.
//!
//! A spring of stiffness k, length l and rest length l0 in direction n resists the displacement δ
//! of one end against the other with `k (n nᵀ + (1 - l0 / l)(I - n nᵀ)) δ`. Where it is shorter than
//! at rest the second part is left out, so that the matrix has no negative eigenvalue (Choi and Ko
//! 2002); Newton's method then still ends at the same point.

use std::ops::Range;

use crate::cloth::accumulate::Accumulator;
use crate::cloth::springs::{Family, Springs};
use crate::cloth::{Points, filled, len};
use crate::error::Result;

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
    /// The diagonal of the matrix, in N/m.
    diagonal: Points,
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
        Ok(Self { accumulator: Accumulator::new(springs)?, families, diagonal: Points::zeros(points)? })
    }

    /// The diagonal of the matrix, in N/m.
    pub(super) fn diagonal(&self) -> &Points {
        &self.diagonal
    }

    /// Takes the stiffness of `springs` with the points at `x`.
    pub(super) fn update(&mut self, x: &Points, springs: &Springs) {
        let [dx, dy, dz] = self.diagonal.components_mut();
        [&mut *dx, &mut *dy, &mut *dz].into_iter().for_each(|d| d.fill(0.0));
        for (family, tangents) in springs.families.iter().zip(&mut self.families) {
            for a in family.points(springs.grid) {
                let b = a - family.offset;
                tangents.set(a, x, family);
                let (n, all) = (tangents.along.get(a), tangents.all[a]);
                for p in [a, b] {
                    dx[p] += n.x * n.x + all;
                    dy[p] += n.y * n.y + all;
                    dz[p] += n.z * n.z + all;
                }
            }
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
    /// Takes the stiffness of the spring of `family` that point `a` owns.
    fn set(&mut self, a: usize, x: &Points, family: &Family) {
        let e = x.get(a - family.offset) - x.get(a);
        let l = len(e);
        let k = if l == 0.0 { 0.0 } else { family.stiffness };
        let all = if l > family.rest[a] { k * (1.0 - family.rest[a] / l) } else { 0.0 };
        self.all[a] = all;
        self.along.set(a, if l == 0.0 { e } else { e * ((k - all).sqrt() / l) });
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
