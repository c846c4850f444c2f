//! The springs between consecutive points and their neighbours, some at once, and the sums over them.
//!
//! One loop computes all six families and adds them up. It runs over the points of a band without regard to rows, so that
//! the CPU goes on dividing at the end of a row. A vector of pulls is of the springs whose left end consecutive points are, or
//! whose owner, if the other end is right above. Where a sum needs the springs whose right end the points are, their vector
//! is joined from this one and the one before.

use fearless_simd::prelude::*;
use fearless_simd::{f64x4, f64x8};

/// Points at once at the widest level; so many entries, and some for the width of a spring, are read beyond the last point.
pub(super) const MOST: usize = 8;

/// A vector of numbers of consecutive points.
pub(super) trait Lanes<S: Simd, const N: usize>:
    SimdFloat<S, Element = f64> + SimdBase<S, Array = [f64; N]>
{
    /// The numbers one place to the left, the first from the vector `before`.
    fn shifted_by_one(self, before: Self) -> Self;

    /// The numbers two places to the left, the first two from the vector `before`.
    fn shifted_by_two(self, before: Self) -> Self;
}

impl<S: Simd> Lanes<S, 4> for f64x4<S> {
    #[inline(always)]
    fn shifted_by_one(self, before: Self) -> Self {
        before.slide::<3>(self)
    }

    #[inline(always)]
    fn shifted_by_two(self, before: Self) -> Self {
        before.slide::<2>(self)
    }
}

impl<S: Simd> Lanes<S, 8> for f64x8<S> {
    #[inline(always)]
    fn shifted_by_one(self, before: Self) -> Self {
        before.slide::<7>(self)
    }

    #[inline(always)]
    fn shifted_by_two(self, before: Self) -> Self {
        before.slide::<6>(self)
    }
}

/// What of the springs of a family does not change.
#[derive(Clone, Copy)]
pub(super) struct Fixed<'a> {
    /// Stiffness, in N/m.
    pub(super) k: f64,
    /// Rest lengths in metres, below 0 for a point without a spring; nothing where the family is switched off.
    pub(super) rest: &'a [f64],
}

/// What the springs of points pull their owners with, in N, by family and component.
type Pulls<V> = [[V; 3]; 6];

/// Consecutive points of which the springs are computed.
#[derive(Clone, Copy)]
pub(super) struct Run {
    /// Index of the first in the cloth.
    pub(super) first: usize,
    /// Vectors of points.
    pub(super) vectors: usize,
    /// Points of a row.
    pub(super) width: usize,
}

/// Computes `e · (k · (l - l0) / l)` for the springs of `run`, which begins with a row, starts the sums on its points with
/// `weight`, goes on with those a row above, and ends those two rows above. In `x` and `sums` two rows are before those of the run.
#[inline(always)]
pub(super) fn sweep<S: Simd, V: Lanes<S, N>, const N: usize>(
    simd: S,
    run: Run,
    x: [&[f64]; 3],
    families: &[Fixed<'_>; 6],
    weight: [f64; 3],
    sums: &mut [Vec<f64>; 3],
) {
    let Run { first, vectors: n, width } = run;
    let rest = [first + 1, first, first + 1, first, first + 2, first];
    let [l, u, ul, ur, l2, u2] = families;
    let [l, u, ul] = [springs(l, rest[0], n), springs(u, rest[1], n), springs(ul, rest[2], n)];
    let [ur, l2, u2] = [springs(ur, rest[3], n), springs(l2, rest[4], n), springs(u2, rest[5], n)];
    let (row, above, above2) = (2 * width, width, 0);
    let (here, right, right2) = (three(x, row, n), three(x, row + 1, n), three(x, row + 2, n));
    let (up, up_right, up2) = (three(x, above, n), three(x, above + 1, n), three(x, above2, n));
    let [sx, sy, sz] = sums;
    let len = row + n * N;
    let sums = [&mut sx[..len], &mut sy[..len], &mut sz[..len]];
    // At the left end of a row no spring leads to the left.
    let mut last = [[V::splat(simd, 0.0); 3]; 6];
    for i in 0..n {
        let (a, b, c) = (load(simd, here, i), load(simd, up, i), load(simd, up_right, i));
        let (a1, a2, d) = (load(simd, right, i), load(simd, right2, i), load(simd, up2, i));
        let pulls = [
            pull(simd, l, i, a1, a),
            pull(simd, u, i, a, b),
            pull(simd, ul, i, a1, b),
            pull(simd, ur, i, a, c),
            pull(simd, l2, i, a2, a),
            pull(simd, u2, i, a, d),
        ];
        for c in 0..3 {
            let (pulls, before) = (component(&pulls, c), component(&last, c));
            add_up(simd, i, width, weight[c], pulls, before, sums[c]);
        }
        last = pulls;
    }
}

/// Adds one component of the pulls of vector `i` of a run to `sums`, which begin two rows above it.
#[inline(always)]
fn add_up<S: Simd, V: Lanes<S, N>, const N: usize>(
    simd: S,
    i: usize,
    width: usize,
    weight: f64,
    [left, above, upper_left, upper_right, left2, above2]: [V; 6],
    before: [V; 6],
    sums: &mut [f64],
) {
    let [left_before, _, upper_left_before, upper_right_before, left2_before, _] = before;
    let own = V::splat(simd, weight) + left.shifted_by_one(left_before) + above;
    let own = own + upper_left.shifted_by_one(upper_left_before) + upper_right;
    let own = own + left2.shifted_by_two(left2_before) + above2;
    (own - left - left2).store_slice(&mut sums[2 * width + i * N..][..N]);
    let row_above = &mut sums[width + i * N..][..N];
    let sum = V::from_slice(simd, row_above) - upper_right.shifted_by_one(upper_right_before) - above;
    (sum - upper_left).store_slice(row_above);
    let second_row_above = &mut sums[i * N..][..N];
    (V::from_slice(simd, second_row_above) - above2).store_slice(second_row_above);
}

/// The pulls on the points at `a` of springs to those at `b`, zero where there are no rest lengths.
#[inline(always)]
fn pull<S: Simd, V: Lanes<S, N>, const N: usize>(
    simd: S,
    (k, rest): (f64, &[[f64; N]]),
    i: usize,
    a: [V; 3],
    b: [V; 3],
) -> [V; 3] {
    let zero = V::splat(simd, 0.0);
    let Some(rest) = rest.get(i) else { return [zero; 3] };
    let (ex, ey, ez) = (b[0] - a[0], b[1] - a[1], b[2] - a[2]);
    let l = (ex * ex + ey * ey + ez * ez).sqrt();
    let rest = V::load_array_ref(simd, rest);
    let scale = V::splat(simd, k) * (l - rest) / l;
    let scale = (l.simd_le(zero) | rest.simd_lt(zero)).select(zero, scale);
    [ex * scale, ey * scale, ez * scale]
}

/// Component `c` of the pulls of each family.
#[inline(always)]
fn component<V: Copy>(pulls: &Pulls<V>, c: usize) -> [V; 6] {
    let [l, u, ul, ur, l2, u2] = pulls;
    [l[c], u[c], ul[c], ur[c], l2[c], u2[c]]
}

/// The springs of a family from the point `first` on; none if it is switched off.
#[inline(always)]
fn springs<'a, const N: usize>(family: &Fixed<'a>, first: usize, n: usize) -> (f64, &'a [[f64; N]]) {
    let rest = if family.rest.is_empty() { &[] } else { vectors(family.rest, first, n) };
    (family.k, rest)
}

/// Some vectors of each component.
#[inline(always)]
fn three<const N: usize>(x: [&[f64]; 3], place: usize, n: usize) -> [&[[f64; N]]; 3] {
    [vectors(x[0], place, n), vectors(x[1], place, n), vectors(x[2], place, n)]
}

/// `n` vectors from `place` on.
#[inline(always)]
fn vectors<const N: usize>(numbers: &[f64], place: usize, n: usize) -> &[[f64; N]] {
    &numbers[place..][..n * N].as_chunks().0[..n]
}

/// Vector `i` of each component.
#[inline(always)]
fn load<S: Simd, V: Lanes<S, N>, const N: usize>(simd: S, x: [&[[f64; N]]; 3], i: usize) -> [V; 3] {
    [V::load_array_ref(simd, &x[0][i]), V::load_array_ref(simd, &x[1][i]), V::load_array_ref(simd, &x[2][i])]
}
