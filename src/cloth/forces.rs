//! Phase 1: the weight of every point and the pull of every spring.

use std::ops::Range;

use super::accumulate::Accumulator;
use super::real::Real;
use super::springs::{Family, Springs};
use super::{Counters, Points};
use crate::error::Result;

/// The forces on the points of a cloth.
#[derive(Clone, Debug)]
pub(crate) struct Forces<T = f64> {
    accumulator: Accumulator<T>,
}

impl<T: Real> Forces<T> {
    /// Room for the forces of `springs`.
    ///
    /// # Errors
    /// [`crate::error::Kind::Scene`] when it does not fit in memory.
    pub(crate) fn new(springs: &Springs) -> Result<Self> {
        Ok(Self { accumulator: Accumulator::new(springs)? })
    }

    /// The forces that were computed last, in N.
    pub(crate) fn sum(&self) -> &Points<T> {
        &self.accumulator.sum
    }

    /// Computes the force on every point at `x`: its `weight` and its springs, in N.
    pub(crate) fn compute(
        &mut self,
        x: &Points<T>,
        springs: &Springs,
        weight: [T; 3],
        counters: &mut Counters,
    ) {
        self.accumulator.accumulate(
            springs,
            weight,
            #[inline(always)]
            |_, family, points, out| pull(x, family, points, out),
        );
        counters.springs_evaluated += springs.len() as u64;
    }
}

/// The pulls of one family's springs on their owners, the points `a` in the formula.
#[inline(always)]
fn pull<T: Real>(x: &Points<T>, family: &Family, points: Range<usize>, out: [&mut [T]; 3]) {
    let b = points.start - family.offset..points.end - family.offset;
    let [out_x, out_y, out_z] = out;
    let (ax, ay, az) = (&x.x[points.clone()], &x.y[points.clone()], &x.z[points.clone()]);
    let (bx, by, bz) = (&x.x[b.clone()], &x.y[b.clone()], &x.z[b]);
    let rest = &family.rest[points];
    pull_each(ax, ay, az, bx, by, bz, rest, T::nearest(family.stiffness), out_x, out_y, out_z);
}

/// `e · (k · (l - l0) / l)` for every pair of points a and b, and zero where they meet.
#[expect(clippy::too_many_arguments, reason = "the compiler trusts separate slices not to overlap")]
#[inline(always)]
fn pull_each<T: Real>(
    ax: &[T],
    ay: &[T],
    az: &[T],
    bx: &[T],
    by: &[T],
    bz: &[T],
    rest: &[f64],
    stiffness: T,
    out_x: &mut [T],
    out_y: &mut [T],
    out_z: &mut [T],
) {
    let n = rest.len();
    let (ax, ay, az) = (&ax[..n], &ay[..n], &az[..n]);
    let (bx, by, bz) = (&bx[..n], &by[..n], &bz[..n]);
    let (out_x, out_y, out_z) = (&mut out_x[..n], &mut out_y[..n], &mut out_z[..n]);
    for i in 0..n {
        let (ex, ey, ez) = (bx[i] - ax[i], by[i] - ay[i], bz[i] - az[i]);
        let l = (ex * ex + ey * ey + ez * ez).sqrt();
        // Dividing first and choosing after leaves the loop without a branch, so it is vectorised.
        let scale = stiffness * (l - T::nearest(rest[i])) / l;
        let scale = if l == T::default() { T::default() } else { scale };
        out_x[i] = ex * scale;
        out_y[i] = ey * scale;
        out_z[i] = ez * scale;
    }
}
