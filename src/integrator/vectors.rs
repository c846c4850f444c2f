//! Sums and products of vectors that have an entry for each component of each point. Every sum has a
//! fixed order, so the bits are the same wherever it runs.

use crate::cloth::Points;
use crate::lanes::level::dispatch_plain;

/// Partial sums of a dot product.
const LANES: usize = 8;

/// `a · b` over all points: entry p of a component goes to partial sum p mod [`LANES`], and these are added up in order,
/// one component after the other.
pub(super) fn dot(a: &Points, b: &Points) -> f64 {
    a.components().into_iter().zip(b.components()).map(|(a, b)| dot_numbers(a, b)).sum()
}

fn dot_numbers(a: &[f64], b: &[f64]) -> f64 {
    let ((a, a_rest), (b, b_rest)) = (a.as_chunks(), b.as_chunks());
    let mut partial = dispatch_plain!(partial_sums(a, b));
    for ((partial, a), b) in partial.iter_mut().zip(a_rest).zip(b_rest) {
        *partial += a * b;
    }
    partial.iter().sum()
}

/// The length of `a`, all points together.
pub(super) fn length(a: &Points) -> f64 {
    dot(a, a).sqrt()
}

/// `a += factor b`
pub(super) fn add(a: &mut Points, factor: f64, b: &Points) {
    dispatch_plain!(for_each(a, b, |a, b| *a += factor * b));
}

/// `a = b + factor a`
pub(super) fn scale_and_add(a: &mut Points, factor: f64, b: &Points) {
    dispatch_plain!(for_each(a, b, |a, b| *a = b + factor * *a));
}

/// Does `change` to each entry of `a` with that of `b`.
#[inline(always)]
fn for_each(a: &mut Points, b: &Points, change: impl Fn(&mut f64, f64)) {
    for (a, b) in a.components_mut().into_iter().zip(b.components()) {
        for (a, b) in a.iter_mut().zip(b) {
            change(a, *b);
        }
    }
}

/// The partial sums of whole groups of entries.
#[inline(always)]
fn partial_sums(a: &[[f64; LANES]], b: &[[f64; LANES]]) -> [f64; LANES] {
    let mut partial = [0.0; LANES];
    for (a, b) in a.iter().zip(b) {
        for lane in 0..LANES {
            partial[lane] += a[lane] * b[lane];
        }
    }
    partial
}
