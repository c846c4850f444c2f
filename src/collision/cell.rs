//! Self-collision within one cell: its members, moved apart one after the other.

use std::array;
use std::iter;

use super::separation::{Pushes, Separation};
use crate::cloth::Points;
use crate::scene::Vec3;

/// Points whose distances are compared at once.
const LANES: usize = 4;

/// Slots after those of a cell that hold [`FAR_AWAY`], so that its last points are compared in the
/// same way as the others.
pub(super) const PADDING: usize = LANES - 1;

/// A coordinate that is close to no other.
const FAR_AWAY: f64 = f64::INFINITY;

/// The members of a cell, in index order, and where they are.
pub(super) struct Cell<'a> {
    members: &'a [usize],
    rule: Separation,
    x: &'a mut [f64],
    y: &'a mut [f64],
    z: &'a mut [f64],
}

impl<'a> Cell<'a> {
    /// The cell of `members`, whose slots (as many, and [`PADDING`] more) are filled with their
    /// positions from `x`.
    #[inline(always)]
    pub(super) fn load(
        members: &'a [usize],
        rule: Separation,
        x: &Points,
        slots: [&'a mut [f64]; 3],
    ) -> Self {
        // The compiler sees here that all three are equally long.
        let [px, py, pz] = slots;
        let n = px.len();
        let (py, pz) = (&mut py[..n], &mut pz[..n]);
        for (to, &p) in members.iter().enumerate() {
            (px[to], py[to], pz[to]) = (x.x[p], x.y[p], x.z[p]);
        }
        px[members.len()..].fill(FAR_AWAY);
        Self { members, rule, x: px, y: py, z: pz }
    }

    /// Whether two members may be too close. A loop, because `any` is not sure to be inlined, and then
    /// not compiled for the vectors of the CPU.
    #[inline(always)]
    pub(super) fn any_close(&self) -> bool {
        for at in 0..self.members.len() {
            if self.is_close_to_later(at) {
                return true;
            }
        }
        false
    }

    /// Moves the unpinned members apart, one after the other; how many moved.
    #[inline(always)]
    pub(super) fn separate(&mut self, pinned: &[bool]) -> u64 {
        let mut moves = 0;
        for (at, _) in self.members.iter().enumerate().filter(|&(_, &p)| !pinned[p]) {
            if let Some(position) = self.corrected(at) {
                (self.x[at], self.y[at], self.z[at]) = (position.x, position.y, position.z);
                moves += 1;
            }
        }
        moves
    }

    /// Whether the member `at` may be too close to one after it.
    #[inline(always)]
    fn is_close_to_later(&self, at: usize) -> bool {
        for squares in self.squares(at, at + 1) {
            let mut any = false;
            for square in squares {
                any |= square <= self.rule.reach;
            }
            if any {
                return true;
            }
        }
        false
    }

    /// Where the member `at` belongs; `None` when it may stay.
    #[inline(always)]
    fn corrected(&self, at: usize) -> Option<Vec3> {
        let position = self.position(at);
        let mut pushes = Pushes::default();
        for (first, squares) in (0..).step_by(LANES).zip(self.squares(at, 0)) {
            for i in within(&squares, self.rule.reach, at.wrapping_sub(first)) {
                pushes.add(position - self.position(first + i), &self.rule);
            }
        }
        self.rule.corrected(position, &pushes)
    }

    /// Where the member `at` is.
    #[inline(always)]
    fn position(&self, at: usize) -> Vec3 {
        Vec3::new(self.x[at], self.y[at], self.z[at])
    }

    /// The squared distances of the member `at` from the member `from` and those after it, in m².
    #[inline(always)]
    fn squares(&self, at: usize, from: usize) -> impl Iterator<Item = [f64; LANES]> {
        let (px, py, pz) = (self.x[at], self.y[at], self.z[at]);
        let [x, y, z] = [&self.x, &self.y, &self.z].map(|component| component[from..].as_chunks::<LANES>().0);
        x.iter().zip(y).zip(z).map(move |((x, y), z)| {
            array::from_fn(|i| {
                let (ex, ey, ez) = (px - x[i], py - y[i], pz - z[i]);
                ex * ex + ey * ey + ez * ez
            })
        })
    }
}

/// Which of `squares` but that of `own` are at most `reach`.
#[inline(always)]
fn within(squares: &[f64; LANES], reach: f64, own: usize) -> impl Iterator<Item = usize> {
    // A byte for each: all are compared at once, and then only these few are visited.
    let mut bytes = u32::from_le_bytes(squares.map(|square| u8::from(square <= reach)));
    if own < LANES {
        bytes &= !(1 << (8 * own));
    }
    iter::from_fn(move || {
        let i = bytes.trailing_zeros() as usize / 8;
        bytes &= bytes.wrapping_sub(1);
        (i < LANES).then_some(i)
    })
}
