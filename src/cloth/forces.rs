//! Phase 1: the weight of every point and the pull of every spring.
//!
//! Each spring's force is computed once, a row of one family at a time, and then summed per point
//! in the order in which the springs were created: first the point's own springs, then those that
//! end at it, in index order of the points that made them. Those are the right neighbour's, the
//! second to the right's, and of the rows below the left, the middle, the right and the second.

use std::array;
use std::ops::Range;

use super::grid::Grid;
use super::springs::{FAMILIES, Family, SpringKind, Springs};
use super::{Counters, Points, filled};
use crate::dispatch::{Work, dispatch};
use crate::error::Result;
use crate::scene::Vec3;

/// Zeros on either side of a row, so that a neighbour outside the grid pulls with nothing.
const PAD: usize = 2;

/// One component of the forces that a row's springs pull with, one array per family.
/// Entry `PAD + i` belongs to column i and is 0 where there is no spring.
type Pulls = [Vec<f64>; FAMILIES];

/// The forces on the points, and room for the springs of three rows.
#[derive(Clone, Debug)]
pub(crate) struct Forces {
    /// The force on every point, in N.
    pub(crate) sum: Points,
    /// The pulls of row j, by component, in entry j mod 3.
    rows: [[Pulls; 3]; 3],
    /// Computes all forces, for the kinds of springs that there are.
    compute: fn(&mut Self, &Points, &Springs, Vec3),
}

impl Forces {
    /// Room for the forces of `springs`.
    ///
    /// # Errors
    /// [`crate::error::Kind::Scene`] when it does not fit in memory.
    pub(crate) fn new(springs: &Springs) -> Result<Self> {
        let mut rows: [[Pulls; 3]; 3] =
            array::from_fn(|_| array::from_fn(|_| array::from_fn(|_| Vec::new())));
        for pulls in rows.iter_mut().flatten() {
            for family in &springs.families {
                pulls[family.slot] = filled(springs.grid.width + 2 * PAD, 0.0)?;
            }
        }
        Ok(Self { sum: Points::zeros(springs.grid.len())?, rows, compute: compute_for(springs) })
    }

    /// Computes the force on every point at `x`: its `weight` and its springs, in N.
    pub(crate) fn compute(&mut self, x: &Points, springs: &Springs, weight: Vec3, counters: &mut Counters) {
        (self.compute)(self, x, springs, weight);
        counters.springs_evaluated += springs.len() as u64;
    }

    /// Computes the pulls of the springs that the points of row `j` made.
    #[inline(always)]
    fn pull_row(&mut self, x: &Points, springs: &Springs, j: usize) {
        let pulls = &mut self.rows[j % 3];
        for family in &springs.families {
            let out = pulls.each_mut().map(|component| component[family.slot].as_mut_slice());
            if family.rows.contains(&j) {
                pull(x, family, j * springs.grid.width, out);
            } else {
                out.into_iter().for_each(|component| component.fill(0.0));
            }
        }
    }

    /// Sums the forces on row `j`, whose points are `points`.
    #[inline(always)]
    fn sum_row<const STRUCTURAL: bool, const SHEARING: bool, const BENDING: bool>(
        &mut self,
        j: usize,
        points: Range<usize>,
        weight: Vec3,
    ) {
        let [own, below, below2] = [&self.rows[j % 3], &self.rows[(j + 1) % 3], &self.rows[(j + 2) % 3]];
        let sum = [&mut self.sum.x, &mut self.sum.y, &mut self.sum.z];
        for (c, sum) in sum.into_iter().enumerate() {
            let sum = &mut sum[points.clone()];
            add_up::<STRUCTURAL, SHEARING, BENDING>(sum, weight[c], &own[c], &below[c], &below2[c]);
        }
    }
}

/// All forces of a step, for the kinds of springs that there are.
struct Compute<'a, const STRUCTURAL: bool, const SHEARING: bool, const BENDING: bool> {
    forces: &'a mut Forces,
    x: &'a Points,
    springs: &'a Springs,
    weight: Vec3,
}

impl<const STRUCTURAL: bool, const SHEARING: bool, const BENDING: bool> Work
    for Compute<'_, STRUCTURAL, SHEARING, BENDING>
{
    #[inline(always)]
    fn run(self) {
        let Self { forces, x, springs, weight } = self;
        let Grid { width, height } = springs.grid;
        for j in 0..height + 2 {
            forces.pull_row(x, springs, j);
            if let Some(done) = j.checked_sub(2) {
                let points = done * width..(done + 1) * width;
                forces.sum_row::<STRUCTURAL, SHEARING, BENDING>(done, points, weight);
            }
        }
    }
}

/// The pulls of one family on the points of the row that starts at index `row`.
#[inline(always)]
fn pull(x: &Points, family: &Family, row: usize, out: [&mut [f64]; 3]) {
    let n = family.columns.len();
    let a = row + family.columns.start;
    let b = a - family.offset;
    let [out_x, out_y, out_z] = out.map(|out| &mut out[PAD + family.columns.start..][..n]);
    let (ax, ay, az) = (&x.x[a..][..n], &x.y[a..][..n], &x.z[a..][..n]);
    let (bx, by, bz) = (&x.x[b..][..n], &x.y[b..][..n], &x.z[b..][..n]);
    let rest = &family.rest[a..][..n];
    pull_each(ax, ay, az, bx, by, bz, rest, family.stiffness, out_x, out_y, out_z);
}

/// `e · (k · (l - l0) / l)` for every pair of points a and b, and zero where they meet.
#[inline(always)]
#[expect(clippy::too_many_arguments, reason = "the compiler trusts separate slices not to overlap")]
fn pull_each(
    ax: &[f64],
    ay: &[f64],
    az: &[f64],
    bx: &[f64],
    by: &[f64],
    bz: &[f64],
    rest: &[f64],
    stiffness: f64,
    out_x: &mut [f64],
    out_y: &mut [f64],
    out_z: &mut [f64],
) {
    let n = rest.len();
    let (ax, ay, az) = (&ax[..n], &ay[..n], &az[..n]);
    let (bx, by, bz) = (&bx[..n], &by[..n], &bz[..n]);
    let (out_x, out_y, out_z) = (&mut out_x[..n], &mut out_y[..n], &mut out_z[..n]);
    for i in 0..n {
        let (ex, ey, ez) = (bx[i] - ax[i], by[i] - ay[i], bz[i] - az[i]);
        let l = (ex * ex + ey * ey + ez * ez).sqrt();
        // Dividing first and choosing after leaves the loop without a branch, so it is vectorised.
        let scale = stiffness * (l - rest[i]) / l;
        let scale = if l == 0.0 { 0.0 } else { scale };
        out_x[i] = ex * scale;
        out_y[i] = ey * scale;
        out_z[i] = ez * scale;
    }
}

/// The computation for the kinds that `springs` has.
fn compute_for(springs: &Springs) -> fn(&mut Forces, &Points, &Springs, Vec3) {
    let has = |kind| springs.has(kind);
    match (has(SpringKind::Structural), has(SpringKind::Shearing), has(SpringKind::Bending)) {
        (false, false, false) => compute::<false, false, false>,
        (false, false, true) => compute::<false, false, true>,
        (false, true, false) => compute::<false, true, false>,
        (false, true, true) => compute::<false, true, true>,
        (true, false, false) => compute::<true, false, false>,
        (true, false, true) => compute::<true, false, true>,
        (true, true, false) => compute::<true, true, false>,
        (true, true, true) => compute::<true, true, true>,
    }
}

fn compute<const STRUCTURAL: bool, const SHEARING: bool, const BENDING: bool>(
    forces: &mut Forces,
    x: &Points,
    springs: &Springs,
    weight: Vec3,
) {
    dispatch(Compute::<STRUCTURAL, SHEARING, BENDING> { forces, x, springs, weight });
}

/// Sums one component of the forces on a row in creation order.
#[inline(always)]
fn add_up<const STRUCTURAL: bool, const SHEARING: bool, const BENDING: bool>(
    out: &mut [f64],
    weight: f64,
    own: &Pulls,
    below: &Pulls,
    below2: &Pulls,
) {
    let n = out.len();
    let (left, above) = (made_by(own, 0, 0, n, STRUCTURAL), made_by(own, 1, 0, n, STRUCTURAL));
    let (upper_left, upper_right) = (made_by(own, 2, 0, n, SHEARING), made_by(own, 3, 0, n, SHEARING));
    let (left2, above2) = (made_by(own, 4, 0, n, BENDING), made_by(own, 5, 0, n, BENDING));
    let from_right = made_by(own, 0, 1, n, STRUCTURAL);
    let from_right2 = made_by(own, 4, 2, n, BENDING);
    let from_lower_left = made_by(below, 3, -1, n, SHEARING);
    let from_below = made_by(below, 1, 0, n, STRUCTURAL);
    let from_lower_right = made_by(below, 2, 1, n, SHEARING);
    let from_below2 = made_by(below2, 5, 0, n, BENDING);
    for (i, out) in out.iter_mut().enumerate() {
        let mut f = weight;
        if STRUCTURAL {
            f = f + left[i] + above[i];
        }
        if SHEARING {
            f = f + upper_left[i] + upper_right[i];
        }
        if BENDING {
            f = f + left2[i] + above2[i];
        }
        if STRUCTURAL {
            f -= from_right[i];
        }
        if BENDING {
            f -= from_right2[i];
        }
        if SHEARING {
            f -= from_lower_left[i];
        }
        if STRUCTURAL {
            f -= from_below[i];
        }
        if SHEARING {
            f -= from_lower_right[i];
        }
        if BENDING {
            f -= from_below2[i];
        }
        *out = f;
    }
}

/// The pulls of family `slot` that a row of `n` points gets from the points `right` columns to
/// its right; nothing when the family does not exist.
#[inline(always)]
fn made_by(pulls: &Pulls, slot: usize, right: isize, n: usize, exists: bool) -> &[f64] {
    if exists { &pulls[slot][PAD.wrapping_add_signed(right)..][..n] } else { &[] }
}
