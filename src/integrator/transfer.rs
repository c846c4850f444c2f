//! From a grid to one with about half as many rows and columns, and back: bilinear interpolation and its
//! transpose.
//!
//! The coarse grid has every second point of the fine one in each direction, and the last one too. A fine
//! point in between moves by the mean of its two coarse neighbours.

use crate::cloth::grid::Grid;
use crate::cloth::{Points, filled};
use crate::error::Result;
use crate::lanes::level::dispatch_plain;

/// The way between two grids.
#[derive(Clone, Debug)]
pub(super) struct Transfer {
    fine: Grid,
    pub(super) coarse: Grid,
    /// A row of the fine grid.
    row: Vec<f64>,
}

impl Transfer {
    /// From `fine` to its coarse grid; a side of two points stays as it is.
    ///
    /// # Errors
    /// [`crate::error::Kind::Scene`] when it does not fit in memory.
    pub(super) fn new(fine: Grid) -> Result<Self> {
        let coarse = Grid { width: fine.width / 2 + 1, height: fine.height / 2 + 1 };
        Ok(Self { fine, coarse, row: filled(fine.width, 0.0)? })
    }

    /// The fine point that coarse point `index` is.
    pub(super) fn fine_point(&self, index: usize) -> usize {
        let (i, j) = self.coarse.column_row(index);
        place(j, self.fine.height) * self.fine.width + place(i, self.fine.width)
    }

    /// The coarse points with which fine point `index` moves.
    pub(super) fn coarse_points(&self, index: usize) -> impl Iterator<Item = usize> + use<> {
        let (i, j) = self.fine.column_row(index);
        let width = self.coarse.width;
        let (columns, rows) = (parents(i, self.fine.width), parents(j, self.fine.height));
        rows.flat_map(move |row| columns.clone().map(move |column| row * width + column))
    }

    /// Gives each coarse point what moves with it: the transpose of [`Self::prolong`].
    pub(super) fn restrict(&mut self, fine: &Points, coarse: &mut Points) {
        for (fine, coarse) in fine.components().into_iter().zip(coarse.components_mut()) {
            self.restrict_numbers(fine, coarse);
        }
    }

    /// [`Self::restrict`] of a number a point.
    pub(super) fn restrict_numbers(&mut self, fine: &[f64], coarse: &mut [f64]) {
        let coarse_width = self.coarse.width;
        dispatch_plain!(restrict(fine, coarse, self.fine, coarse_width, &mut self.row));
    }

    /// Adds to the fine points the interpolation of what the coarse ones have.
    pub(super) fn prolong(&mut self, coarse: &Points, fine: &mut Points) {
        let coarse_width = self.coarse.width;
        for (coarse, fine) in coarse.components().into_iter().zip(fine.components_mut()) {
            dispatch_plain!(prolong(coarse, fine, self.fine, coarse_width, &mut self.row));
        }
    }
}

/// The place on a fine side of `n` points of place `coarse`.
fn place(coarse: usize, n: usize) -> usize {
    (2 * coarse).min(n - 1)
}

/// The places on the coarse side with which place `at` of a fine side of `n` points moves.
fn parents(at: usize, n: usize) -> std::ops::Range<usize> {
    if at + 1 == n { n / 2..n / 2 + 1 } else { at / 2..at / 2 + 1 + at % 2 }
}

/// The places on a fine side of `n` points that take a half from the coarse point at `at`.
fn between(at: usize, n: usize) -> impl Iterator<Item = usize> {
    let is_even = at.is_multiple_of(2);
    let before = at.checked_sub(1).filter(|_| is_even);
    let after = Some(at + 1).filter(|after| is_even && after + 1 < n);
    before.into_iter().chain(after)
}

#[inline(always)]
fn restrict(
    fine: &[f64],
    coarse: &mut [f64],
    Grid { width, height }: Grid,
    coarse_width: usize,
    row: &mut [f64],
) {
    for (j, coarse) in coarse.chunks_exact_mut(coarse_width).enumerate() {
        let at = place(j, height);
        row.copy_from_slice(&fine[at * width..][..width]);
        for j in between(at, height) {
            add(row, 0.5, &fine[j * width..][..width]);
        }
        gather(row, coarse);
    }
}

#[inline(always)]
fn prolong(
    coarse: &[f64],
    fine: &mut [f64],
    Grid { width, height }: Grid,
    coarse_width: usize,
    row: &mut [f64],
) {
    for (j, coarse) in coarse.chunks_exact(coarse_width).enumerate() {
        spread(coarse, row);
        let at = place(j, height);
        add(&mut fine[at * width..][..width], 1.0, row);
        for j in between(at, height) {
            add(&mut fine[j * width..][..width], 0.5, row);
        }
    }
}

/// `a += part b`
#[inline(always)]
fn add(a: &mut [f64], part: f64, b: &[f64]) {
    for (a, b) in a.iter_mut().zip(b) {
        *a += part * b;
    }
}

/// [`restrict`] along a row.
#[inline(always)]
fn gather(fine: &[f64], coarse: &mut [f64]) {
    for (i, coarse) in coarse.iter_mut().enumerate() {
        let at = place(i, fine.len());
        *coarse = fine[at];
        for i in between(at, fine.len()) {
            *coarse += 0.5 * fine[i];
        }
    }
}

/// [`prolong`] along a row.
#[inline(always)]
fn spread(coarse: &[f64], fine: &mut [f64]) {
    let [.., last] = coarse else { return };
    for (pair, fine) in coarse.windows(2).zip(fine.chunks_mut(2)) {
        fine[0] = pair[0];
        if let Some(middle) = fine.get_mut(1) {
            *middle = 0.5 * (pair[0] + pair[1]);
        }
    }
    if let Some(end) = fine.last_mut() {
        *end = *last;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::splitmix64;

    const GRIDS: [[usize; 2]; 6] = [[2, 2], [3, 2], [5, 4], [50, 50], [9, 6], [2, 7]];

    fn random(seed: usize, len: usize) -> Vec<f64> {
        (seed..seed + len).map(|i| (splitmix64(i as u64) >> 11) as f64 / 9_007_199_254_740_992.0).collect()
    }

    /// What is linear over the grid stays so, and coarse points are fine points.
    #[test]
    fn linear_functions_are_interpolated_exactly() {
        for [width, height] in GRIDS {
            let fine = Grid { width, height };
            let mut transfer = Transfer::new(fine).unwrap();
            let value = |p: usize| {
                let (i, j) = fine.column_row(p);
                3.0 * i as f64 - 2.0 * j as f64 + 1.0
            };
            let mut coarse = Points::zeros(transfer.coarse.len()).unwrap();
            (0..coarse.len()).for_each(|p| coarse.y[p] = value(transfer.fine_point(p)));
            let mut found = Points::zeros(fine.len()).unwrap();
            transfer.prolong(&coarse, &mut found);
            let expected: Vec<f64> = (0..fine.len()).map(value).collect();
            assert_eq!(found.y, expected, "{width} x {height}");
            assert!(found.x.iter().all(|x| *x == 0.0));
        }
    }

    /// `fine · prolong(coarse) = restrict(fine) · coarse`; a coarse point without the parts that move with it would break it.
    #[test]
    fn restriction_is_the_transpose() {
        for [width, height] in GRIDS {
            let fine = Grid { width, height };
            let mut transfer = Transfer::new(fine).unwrap();
            let coarse = transfer.coarse.len();
            let (down, up) = (random(7, fine.len()), random(1000, coarse));
            let mut restricted = vec![0.0; coarse];
            transfer.restrict_numbers(&down, &mut restricted);
            let mut prolonged = Points::zeros(fine.len()).unwrap();
            let z = Points { z: up.clone(), ..Points::zeros(coarse).unwrap() };
            transfer.prolong(&z, &mut prolonged);
            let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
            let (one, other) = (dot(&down, &prolonged.z), dot(&restricted, &up));
            assert!((one - other).abs() < 1e-12 * one, "{width} x {height}: {one} and {other}");
        }
    }

    /// A fine point moves with exactly the coarse points that are named.
    #[test]
    fn a_point_moves_with_the_points_that_are_named() {
        let fine = Grid { width: 8, height: 5 };
        let mut transfer = Transfer::new(fine).unwrap();
        for p in 0..transfer.coarse.len() {
            let mut unit = Points::zeros(transfer.coarse.len()).unwrap();
            unit.x[p] = 1.0;
            let mut moved = Points::zeros(fine.len()).unwrap();
            transfer.prolong(&unit, &mut moved);
            for q in 0..fine.len() {
                let is_named = transfer.coarse_points(q).any(|named| named == p);
                assert_eq!(moved.x[q] > 0.0, is_named, "coarse point {p}, fine point {q}");
            }
        }
    }
}
