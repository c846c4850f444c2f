//! Self-collision within one box: its members, moved apart one after the other.

use std::array;
use std::iter;

use super::Points;
use crate::scene::Vec3;

/// Just above 1: covers the rounding of a squared length, so that no close pair is overlooked.
const MARGIN: f64 = 1.0 + 1e-12;

/// Points whose distances are compared at once.
const LANES: usize = 4;

/// Places after those of a box that hold [`NOWHERE`], so that its last points are compared in the
/// same way as the others.
pub(crate) const ROOM: usize = LANES - 1;

/// A coordinate that is close to no other.
const NOWHERE: f64 = f64::INFINITY;

/// When and how far points move apart.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rule {
    /// Distance that two points keep, in metres: 2 · thickness.
    distance: f64,
    /// A squared distance that no closer pair exceeds, in m².
    reach: f64,
    /// Steps per frame.
    steps_per_frame: f64,
}

impl Rule {
    /// The rule for points that keep `distance`, in metres, over so many steps per frame.
    pub(crate) fn new(distance: f64, steps_per_frame: f64) -> Self {
        Self { distance, reach: distance * distance * MARGIN, steps_per_frame }
    }
}

/// The members of a box, in index order, and where they are.
pub(crate) struct OneBox<'a> {
    members: &'a [usize],
    rule: Rule,
    x: &'a mut [f64],
    y: &'a mut [f64],
    z: &'a mut [f64],
}

impl<'a> OneBox<'a> {
    /// The box of `members`, whose places (as many, and [`ROOM`] more) are filled with their positions from `x`.
    #[inline(always)]
    pub(crate) fn gather(members: &'a [usize], rule: Rule, x: &Points, places: [&'a mut [f64]; 3]) -> Self {
        // The compiler sees here that all three are equally long.
        let [px, py, pz] = places;
        let n = px.len();
        let (py, pz) = (&mut py[..n], &mut pz[..n]);
        for (to, &p) in members.iter().enumerate() {
            (px[to], py[to], pz[to]) = (x.x[p], x.y[p], x.z[p]);
        }
        px[members.len()..].fill(NOWHERE);
        Self { members, rule, x: px, y: py, z: pz }
    }

    /// Whether two members may be too close.
    #[inline(always)]
    pub(crate) fn any_close(&self) -> bool {
        (0..self.members.len()).any(|at| self.is_close_to_later(at))
    }

    /// Moves the unpinned members apart, one after the other; how many moved.
    #[inline(always)]
    pub(crate) fn move_apart(&mut self, pinned: &[bool]) -> u64 {
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
    ///
    /// A pair that is too close never exceeds `reach`: its squared length is below (2 ·
    /// thickness)² but for the rounding of two squares and a root, far less than [`MARGIN`].
    #[inline(always)]
    fn is_close_to_later(&self, at: usize) -> bool {
        let within =
            |squares: [f64; LANES]| squares.iter().fold(false, |any, &s| any | (s <= self.rule.reach));
        self.squares(at, at + 1).any(within)
    }

    /// Where the member `at` belongs; nothing when it may stay.
    #[inline(always)]
    fn corrected(&self, at: usize) -> Option<Vec3> {
        let Rule { distance, reach, steps_per_frame } = self.rule;
        let position = self.position(at);
        let (mut sum, mut count) = (Vec3::zeros(), 0.0);
        for (first, squares) in (0..).step_by(LANES).zip(self.squares(at, 0)) {
            for i in within(&squares, reach, at.wrapping_sub(first)) {
                let l = squares[i].sqrt();
                if 0.0 < l && l < distance {
                    sum += (position - self.position(first + i)) * ((distance - l) / l);
                    count += 1.0;
                }
            }
        }
        (count > 0.0).then(|| position + sum * (1.0 / count / steps_per_frame))
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
