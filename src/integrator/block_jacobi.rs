//! The block Jacobi preconditioner (Saad 2003, *Iterative Methods for Sparse Linear Systems*, 4.1.1 and
//! 10.2): the matrix P that has, of the matrix of the system, only what joins the three components of one
//! point. Baraff and Witkin 1998 take the diagonal alone (5.3); a spring that lies along no axis resists
//! in all three components at once, which the diagonal does not see.
//!
//! A block is the inertia of its point and what its springs resist with, `A = i I + Σ (k n nᵀ + ...)`. It is
//! kept as `A = L D Lᵀ`, L with ones on its diagonal and D diagonal, so that `P⁻¹ r` is two substitutions and a
//! scaling. No eigenvalue of A is below i, and so no pivot in D is. A pivot that rounding puts below, where the
//! springs are 1e16 times as stiff as the inertia, is raised to i: P stays positive definite.

use super::blocks::Blocks;
use crate::cloth::Points;
use crate::error::Result;
use crate::lanes::level::dispatch_plain;

/// The factors of the block of each point.
#[derive(Clone, Debug)]
pub(super) struct BlockJacobi {
    /// Of L: row 2 column 1, row 3 column 1, row 3 column 2.
    lower: Points,
    /// The diagonal of D⁻¹, in m/N.
    scale: Points,
}

impl BlockJacobi {
    /// Room for so many points.
    ///
    /// # Errors
    /// [`crate::error::Kind::Scene`] when it does not fit in memory.
    pub(super) fn new(points: usize) -> Result<Self> {
        Ok(Self { lower: Points::zeros(points)?, scale: Points::zeros(points)? })
    }

    /// Factors the blocks of the matrix: `inertia`, above 0, and those of the springs, both in N/m.
    pub(super) fn update(&mut self, inertia: &[f64], blocks: &Blocks) {
        dispatch_plain!(self.factor(inertia, blocks));
    }

    #[inline(always)]
    fn factor(&mut self, inertia: &[f64], blocks: &Blocks) {
        let n = inertia.len();
        let [xx, yy, zz] = blocks.diagonal.components().map(|numbers| &numbers[..n]);
        let [xy, xz, yz] = blocks.mixed.components().map(|numbers| &numbers[..n]);
        let [l21, l31, l32] = self.lower.components_mut().map(|numbers| &mut numbers[..n]);
        let [s1, s2, s3] = self.scale.components_mut().map(|numbers| &mut numbers[..n]);
        for p in 0..n {
            let i = inertia[p];
            let d1 = xx[p] + i;
            let (a, b) = (xy[p] / d1, xz[p] / d1);
            let d2 = at_least(yy[p] + i - a * xy[p], i);
            let mixed = yz[p] - a * xz[p];
            let c = mixed / d2;
            let d3 = at_least(zz[p] + i - b * xz[p] - c * mixed, i);
            (l21[p], l31[p], l32[p]) = (a, b, c);
            (s1[p], s2[p], s3[p]) = (1.0 / d1, 1.0 / d2, 1.0 / d3);
        }
    }

    /// `out = part P⁻¹ r`.
    pub(super) fn apply(&self, r: &Points, part: f64, out: &mut Points) {
        dispatch_plain!(self.substitute(r, out, |out, z| *out = part * z));
    }

    /// `out += part P⁻¹ r`.
    pub(super) fn add(&self, r: &Points, part: f64, out: &mut Points) {
        dispatch_plain!(self.substitute(r, out, |out, z| *out += part * z));
    }

    /// Gives `write` each number of `P⁻¹ r`.
    #[inline(always)]
    fn substitute(&self, r: &Points, out: &mut Points, write: impl Fn(&mut f64, f64)) {
        let n = r.len();
        let [rx, ry, rz] = r.components().map(|numbers| &numbers[..n]);
        let [l21, l31, l32] = self.lower.components().map(|numbers| &numbers[..n]);
        let [s1, s2, s3] = self.scale.components().map(|numbers| &numbers[..n]);
        let [out_x, out_y, out_z] = out.components_mut().map(|numbers| &mut numbers[..n]);
        for p in 0..n {
            let y = ry[p] - l21[p] * rx[p];
            let z = (rz[p] - l31[p] * rx[p] - l32[p] * y) * s3[p];
            let y = y * s2[p] - l32[p] * z;
            write(&mut out_x[p], rx[p] * s1[p] - l21[p] * y - l31[p] * z);
            write(&mut out_y[p], y);
            write(&mut out_z[p], z);
        }
    }
}

/// `value`, or `least` where it is below.
#[inline(always)]
pub(super) fn at_least(value: f64, least: f64) -> f64 {
    if value < least { least } else { value }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::scene::Vec3;

    /// Springs at one point: their directions, what they resist with along them and in every direction, as parts of the inertia.
    fn springs() -> impl Strategy<Value = Vec<([f64; 3], f64, f64)>> {
        let direction = [-1.0..1.0, -1.0..1.0, -1.0..1.0_f64];
        prop::collection::vec((direction, -3.0..18.0_f64, 0.0..1.0_f64), 0..13).prop_map(|springs| {
            springs.into_iter().map(|(n, exponent, all)| (n, crate::math::exp(exponent * 2.3), all)).collect()
        })
    }

    /// The preconditioner of one point and its block.
    fn one_point(inertia: f64, springs: &[([f64; 3], f64, f64)]) -> (BlockJacobi, nalgebra::Matrix3<f64>) {
        let mut blocks = Blocks::zeros(1).unwrap();
        let mut block = nalgebra::Matrix3::identity() * inertia;
        for ([x, y, z], stiffness, all) in springs {
            let n = Vec3::new(*x, *y, *z) * (stiffness * inertia).sqrt();
            let all = all * stiffness * inertia;
            blocks.add(0..1, [&[n.x], &[n.y], &[n.z]], &[all]);
            block += n * n.transpose() + nalgebra::Matrix3::identity() * all;
        }
        let mut preconditioner = BlockJacobi::new(1).unwrap();
        preconditioner.update(&[inertia], &blocks);
        (preconditioner, block)
    }

    /// P⁻¹, a column for each unit vector.
    fn inverse(preconditioner: &BlockJacobi) -> nalgebra::Matrix3<f64> {
        let column = |axis: usize| {
            let mut unit = Points::zeros(1).unwrap();
            unit.components_mut()[axis][0] = 1.0;
            let mut out = Points::zeros(1).unwrap();
            preconditioner.apply(&unit, 1.0, &mut out);
            out.get(0)
        };
        nalgebra::Matrix3::from_columns(&[column(0), column(1), column(2)])
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: 2000, failure_persistence: None, ..ProptestConfig::default() })]

        /// `P⁻¹ P = 1`, as far as rounding lets it: the error grows with the condition of the block.
        #[test]
        fn it_is_the_inverse_of_each_block(springs in springs(), inertia in 1e-6..1e9_f64) {
            let (preconditioner, block) = one_point(inertia, &springs);
            let condition = block.norm() / inertia;
            let away = (inverse(&preconditioner) * block - nalgebra::Matrix3::identity()).norm();
            prop_assert!(away <= 1e-14 * (1.0 + condition), "{:e} for the condition {:e}", away, condition);
        }

        /// It is symmetric and positive definite for every stiffness, those that swallow the inertia too.
        #[test]
        fn it_is_symmetric_and_positive_definite(
            springs in springs(),
            inertia in 1e-6..1e9_f64,
            r in [-1.0..1.0, -1.0..1.0, -1.0..1.0_f64],
        ) {
            let (preconditioner, _) = one_point(inertia, &springs);
            let inverse = inverse(&preconditioner);
            let skew = (inverse - inverse.transpose()).norm();
            prop_assert!(skew <= 1e-13 * inverse.norm(), "{:e} of {:e}", skew, inverse.norm());
            prop_assert!(preconditioner.scale.components().into_iter().all(|scale| scale[0] > 0.0));
            let r = Vec3::from(r);
            prop_assume!(r.norm() > 1e-3);
            prop_assert!(r.dot(&(inverse * r)) > 0.0);
        }
    }

    /// Two springs along one line, 1e20 times as stiff as the inertia, leave nothing of it in the rounded block.
    #[test]
    fn a_pivot_that_rounding_swallows_is_the_inertia() {
        let stiff = [([0.3, 0.4, 0.5], 1e20, 0.0), ([0.6, 0.8, 1.0], 1e20, 0.0)];
        let (preconditioner, _) = one_point(1.0, &stiff);
        for scale in preconditioner.scale.components() {
            assert!(scale[0] > 0.0 && scale[0] <= 1.0, "{scale:?}");
        }
    }
}
