//! The matrix of a linear system, inertia and stiffness, which is never built: its products.

use super::stiffness::Stiffness;
use crate::cloth::grid::Pins;
use crate::cloth::springs::Springs;
use crate::cloth::{Points, filled};
use crate::error::Result;
use crate::lanes::level::dispatch_plain;

/// The matrix of the points that are not pinned.
#[derive(Clone, Debug)]
pub(super) struct Matrix {
    /// Above 0, in N/m, one a point.
    pub(super) inertia: Vec<f64>,
    /// That of the springs.
    pub(super) stiffness: Stiffness,
}

impl Matrix {
    /// Room for the matrix of a cloth with `springs`, and an inertia of 1 N/m.
    ///
    /// # Errors
    /// [`crate::error::Kind::Scene`] when it does not fit in memory.
    pub(super) fn new(springs: &Springs) -> Result<Self> {
        Ok(Self { inertia: filled(springs.grid.len(), 1.0)?, stiffness: Stiffness::new(springs)? })
    }

    /// `out = A moves`; leaves alone what `out` has for pinned points.
    pub(super) fn multiply(&mut self, moves: &Points, out: &mut Points, springs: &Springs, pins: &Pins) {
        let Self { inertia, stiffness } = self;
        let pulled = stiffness.resist(moves, springs);
        dispatch_plain!(combine(inertia, [moves, pulled, pulled], out, pins, |i, moved, pulled, _| {
            i * moved - pulled
        }));
    }

    /// `out = right - A moves`; leaves alone what `out` has for pinned points.
    pub(super) fn subtract(
        &mut self,
        moves: &Points,
        right: &Points,
        out: &mut Points,
        (springs, pins): (&Springs, &Pins),
    ) {
        let Self { inertia, stiffness } = self;
        let pulled = stiffness.resist(moves, springs);
        dispatch_plain!(combine(inertia, [moves, pulled, right], out, pins, |i, moved, pulled, right| {
            right - i * moved + pulled
        }));
    }
}

/// For each free point and component: `out = of(inertia, a, b, c)`.
#[inline(always)]
fn combine(
    inertia: &[f64],
    [a, b, c]: [&Points; 3],
    out: &mut Points,
    pins: &Pins,
    of: impl Fn(f64, f64, f64, f64) -> f64,
) {
    let [a, b, c] = [a, b, c].map(Points::components);
    for (axis, out) in out.components_mut().into_iter().enumerate() {
        for run in &pins.free {
            let out = &mut out[run.clone()];
            let n = out.len();
            let inertia = &inertia[run.clone()][..n];
            let [a, b, c] = [a[axis], b[axis], c[axis]].map(|numbers| &numbers[run.clone()][..n]);
            for p in 0..n {
                out[p] = of(inertia[p], a[p], b[p], c[p]);
            }
        }
    }
}
