//! The members of cells in numbers half as wide as those of the method, which `cell.rs` compares first.

use super::separation::Separation;
use crate::cloth::{Points, filled};
use crate::error::Result;

/// Members that are compared at once.
pub(super) const LANES: usize = 8;

/// A coordinate that is close to no other.
const FAR_AWAY: f32 = f32::INFINITY;

/// Members that have a bit in one word.
pub(super) const WORD: usize = 64;

/// Which members of a cell may be close to another: a squared distance, in m², that no close pair exceeds after its
/// positions were rounded to binary32.
#[derive(Clone, Copy, Debug)]
pub(super) struct Screen(pub(super) f32);

impl Screen {
    /// The screen that every pair passes.
    pub(super) const ALL: Self = Self(f32::INFINITY);

    /// The screen for `rule` in cells that are nowhere longer than `size`, in metres.
    ///
    /// Relative to the first member, a coordinate is at most `size`, and once a member has moved at most the distance that
    /// points keep more. Rounding changes it by less than 2⁻²³ of that, the difference of two by less than twice as
    /// much, and the squared length of a close pair by less than 2⁻²¹ of it. Squares must be in the range of binary32.
    pub(super) fn new(size: f64, rule: &Separation) -> Self {
        let in_range = 1e-12 < rule.distance && size + rule.distance < 1e12;
        if !in_range || size > 65_536.0 * rule.distance {
            return Self::ALL;
        }
        let reach = rule.distance + (size + rule.distance) * (1.0 / 1_048_576.0);
        Self(rounded(reach * reach))
    }
}

/// The members of some cells, one cell after the other, and room for the work on one.
#[derive(Clone, Debug)]
pub(super) struct Slots {
    /// Where they are relative to the first member of their cell, by component, in metres; after each cell [`LANES`]
    /// times [`FAR_AWAY`], so that its last members are compared in the same way as the others.
    pub(super) rounded: [Vec<f32>; 3],
    /// Where the members of one cell are, by component, in metres.
    pub(super) exact: [Vec<f64>; 3],
    /// Of each member of a cell of at most [`WORD`], a bit for each later one that may be close to it,
    pub(super) later: Box<[u64; WORD]>,
    /// and for each earlier one.
    pub(super) earlier: Box<[u64; WORD]>,
}

impl Slots {
    /// Room for `slots` slots of all cells, and for `of_one` members of one cell; more is made where it is needed.
    ///
    /// # Errors
    /// [`crate::error::Kind::Scene`] when it does not fit in memory.
    pub(super) fn new(slots: usize, of_one: usize) -> Result<Self> {
        let rounded = || filled(slots, 0.0);
        let exact = || filled(of_one, 0.0);
        Ok(Self {
            rounded: [rounded()?, rounded()?, rounded()?],
            exact: [exact()?, exact()?, exact()?],
            later: Box::new([0; WORD]),
            earlier: Box::new([0; WORD]),
        })
    }

    /// How many slots a cell of so many members takes.
    #[inline(always)]
    pub(super) fn needed(members: usize) -> usize {
        members + LANES
    }

    /// Makes room for cells with so many members each.
    pub(super) fn make_room(&mut self, cells: impl Iterator<Item = usize>) {
        let (slots, most) = cells.fold((0, 0), |(slots, most), n| (slots + Self::needed(n), most.max(n)));
        if slots > self.rounded[0].len() {
            self.rounded.iter_mut().for_each(|rounded| rounded.resize(slots, 0.0));
        }
        if most > self.exact[0].len() {
            self.exact.iter_mut().for_each(|exact| exact.resize(most, 0.0));
        }
    }

    /// Takes the positions of `members`, a cell, from `x`, to the slots from `start` on.
    #[inline(always)]
    pub(super) fn load(&mut self, start: usize, members: &[u32], x: &Points) {
        for (x, slots) in x.components().into_iter().zip(&mut self.rounded) {
            let origin = x[members[0] as usize];
            let (slots, after) = slots[start..][..Self::needed(members.len())].split_at_mut(members.len());
            for (slot, &p) in slots.iter_mut().zip(members) {
                *slot = rounded(x[p as usize] - origin);
            }
            after.fill(FAR_AWAY);
        }
    }
}

/// The nearest number of binary32.
#[expect(clippy::cast_possible_truncation, reason = "rounding is what is asked for")]
#[inline(always)]
pub(super) fn rounded(value: f64) -> f32 {
    value as f32
}
