//! Self-collision within one cell: its members, moved apart one after the other.
//!
//! Few pairs of a cell are close. So all are first compared in numbers half as wide as those of the method, of which
//! a vector holds twice as many, and what may be close is noted as a bit. Only these pairs are then computed as the
//! method says. That keeps every bit: the comparison leaves out no close pair, and a pair that is not close does
//! nothing.
//!
//! At the turn of a member those after it are where they were, and each one before it noted, where it went, which of
//! the later ones may be close to it there.

use fearless_simd::prelude::*;
use fearless_simd::{f32x8, mask32x8};

use super::separation::{Pushes, Separation};
use super::slots::{LANES, Screen, Slots, WORD, rounded};
use crate::cloth::Points;
use crate::scene::Vec3;

/// Up to so many members, it is first asked whether two may be close at all: mostly none are.
const FEW: usize = 12;

/// A cell whose members are in index order, and where they are.
pub(super) struct Cell<'a> {
    pub(super) members: &'a [u32],
    pub(super) x: &'a Points,
    pub(super) screen: Screen,
    /// The first of its slots.
    pub(super) start: usize,
    pub(super) slots: &'a mut Slots,
}

impl Cell<'_> {
    /// Moves the unpinned members that are too close to others, one after the other, by `rule`; `moved` gets each of them
    /// with its new position.
    #[inline(always)]
    pub(super) fn separate<S: Simd>(
        &mut self,
        simd: S,
        rule: &Separation,
        pinned: &[bool],
        moved: &mut Vec<(u32, Vec3)>,
    ) {
        let n = self.members.len();
        if n > WORD {
            self.separate_many(simd, rule, pinned, moved);
        } else if self.compare(simd) {
            self.load_exact();
            for at in 0..n {
                let near = self.slots.earlier[at] | self.slots.later[at];
                if near != 0 {
                    let mut pushes = Pushes::default();
                    self.push(at, 0, near, rule, &mut pushes);
                    if self.correct(at, rule, pinned, &pushes, moved) {
                        self.slots.later[at] = self.later(simd, at);
                    }
                    let mut later = self.slots.later[at];
                    while later != 0 {
                        self.slots.earlier[later.trailing_zeros() as usize] |= 1 << at;
                        later &= later - 1;
                    }
                }
            }
        }
    }

    /// The same where there are more members than bits in a word.
    #[inline(always)]
    fn separate_many<S: Simd>(
        &mut self,
        simd: S,
        rule: &Separation,
        pinned: &[bool],
        moved: &mut Vec<(u32, Vec3)>,
    ) {
        self.load_exact();
        for at in 0..self.members.len() {
            let mut pushes = Pushes::default();
            for first in (0..self.members.len()).step_by(WORD) {
                let own = if (first..first + WORD).contains(&at) { 1 << (at - first) } else { 0 };
                let near = self.near(simd, at, first) & !own;
                self.push(at, first, near, rule, &mut pushes);
            }
            self.correct(at, rule, pinned, &pushes, moved);
        }
    }

    /// Compares each member with those after it; whether two may be close.
    #[inline(always)]
    fn compare<S: Simd>(&mut self, simd: S) -> bool {
        let n = self.members.len();
        if n <= FEW && !self.any_near(simd) {
            return false;
        }
        let mut any = 0;
        for at in 0..n {
            let later = self.later(simd, at);
            (self.slots.later[at], self.slots.earlier[at]) = (later, 0);
            any |= later;
        }
        any != 0
    }

    /// Whether two members may be close.
    #[inline(always)]
    fn any_near<S: Simd>(&self, simd: S) -> bool {
        let n = self.members.len();
        let [x, y, z] = &self.slots.rounded;
        let cell = self.start..self.start + n + LANES;
        let (x, y, z) = (&x[cell.clone()], &y[cell.clone()], &z[cell]);
        let reach = f32x8::splat(simd, self.screen.0);
        let mut far = mask32x8::splat(simd, true);
        for at in 0..n - 1 {
            for first in (at + 1..n).step_by(LANES) {
                let group = first..first + LANES;
                let ex = f32x8::from_slice(simd, &x[group.clone()]) - f32x8::splat(simd, x[at]);
                let ey = f32x8::from_slice(simd, &y[group.clone()]) - f32x8::splat(simd, y[at]);
                let ez = f32x8::from_slice(simd, &z[group]) - f32x8::splat(simd, z[at]);
                far &= (ex * ex + ey * ey + ez * ez).simd_gt(reach);
            }
        }
        !far.all_true()
    }

    /// A bit for each of at most [`WORD`] members: whether it is after the member `at` and may be close to it.
    #[inline(always)]
    fn later<S: Simd>(&self, simd: S, at: usize) -> u64 {
        // Two shifts, because one by all bits of a word is none.
        self.near(simd, at, at + 1) << at << 1
    }

    /// A bit for each of up to [`WORD`] members from `first` on: whether it may be close to the member `at`.
    #[inline(always)]
    fn near<S: Simd>(&self, simd: S, at: usize, first: usize) -> u64 {
        let count = (self.members.len() - first).min(WORD);
        let [x, y, z] = &self.slots.rounded;
        let others = self.start + first..self.start + first + count.next_multiple_of(LANES);
        let (px, py, pz) = (x[self.start + at], y[self.start + at], z[self.start + at]);
        let (px, py, pz) = (f32x8::splat(simd, px), f32x8::splat(simd, py), f32x8::splat(simd, pz));
        let x = x[others.clone()].as_chunks::<LANES>().0;
        let y = &y[others.clone()].as_chunks::<LANES>().0[..x.len()];
        let z = &z[others].as_chunks::<LANES>().0[..x.len()];
        let reach = f32x8::splat(simd, self.screen.0);
        let mut near = 0;
        for i in 0..x.len() {
            let ex = f32x8::simd_from(simd, x[i]) - px;
            let ey = f32x8::simd_from(simd, y[i]) - py;
            let ez = f32x8::simd_from(simd, z[i]) - pz;
            let far = (ex * ex + ey * ey + ez * ez).simd_gt(reach).to_bitmask();
            // Not far, rather than near: what is no number is looked at.
            near |= (far ^ ((1 << LANES) - 1)) << (LANES * i);
        }
        if count < WORD { near & !(u64::MAX << count) } else { near }
    }

    /// Takes the positions of the members.
    #[inline(always)]
    fn load_exact(&mut self) {
        for (x, exact) in self.x.components().into_iter().zip(&mut self.slots.exact) {
            for (exact, &p) in exact.iter_mut().zip(self.members) {
                *exact = x[p as usize];
            }
        }
    }

    /// Adds the pushes of members on the member `at`: those from `first` on that have a bit in `near`.
    #[inline(always)]
    fn push(&self, at: usize, first: usize, near: u64, rule: &Separation, pushes: &mut Pushes) {
        let (position, mut near) = (self.position(at), near);
        while near != 0 {
            pushes.add(position - self.position(first + near.trailing_zeros() as usize), rule);
            near &= near - 1;
        }
    }

    /// Moves the member `at` by its `pushes`, unless it is pinned; whether it moved.
    #[inline(always)]
    fn correct(
        &mut self,
        at: usize,
        rule: &Separation,
        pinned: &[bool],
        pushes: &Pushes,
        moved: &mut Vec<(u32, Vec3)>,
    ) -> bool {
        let p = self.members[at];
        let Some(position) = rule.corrected(self.position(at), pushes) else { return false };
        if pinned[p as usize] {
            return false;
        }
        let relative = position - self.x.get(self.members[0] as usize);
        for c in 0..3 {
            self.slots.exact[c][at] = position[c];
            self.slots.rounded[c][self.start + at] = rounded(relative[c]);
        }
        moved.push((p, position));
        true
    }

    /// Where the member `at` is.
    #[inline(always)]
    fn position(&self, at: usize) -> Vec3 {
        let [x, y, z] = &self.slots.exact;
        Vec3::new(x[at], y[at], z[at])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lanes::level::{Level, Narrow, dispatch_narrow};
    use crate::math::splitmix64;

    /// What the method does with a cell: where its points end, and which moved, in order.
    fn by_the_method(x: &Points, rule: &Separation, pinned: &[bool]) -> Vec<(u32, Vec3)> {
        let (mut x, mut moved) = (x.clone(), Vec::new());
        for (p, &pinned) in pinned.iter().enumerate() {
            let mut pushes = Pushes::default();
            (0..x.len()).filter(|&o| o != p).for_each(|o| pushes.add(x.get(p) - x.get(o), rule));
            if let Some(position) = rule.corrected(x.get(p), &pushes).filter(|_| !pinned) {
                x.set(p, position);
                moved.push((u32::try_from(p).unwrap(), position));
            }
        }
        moved
    }

    #[test]
    fn a_cell_of_any_size_moves_as_the_method_says() {
        let mut moves = 0;
        for (members, size, distance) in [
            (2, 0.06, 0.05),
            (9, 0.06, 0.02),
            (63, 0.06, 0.01),
            (64, 0.1, 0.01),
            (200, 4e3, 0.1),
            (65, 3e13, 1e12),
        ] {
            let rule = Separation::of(distance, 1.0);
            let screen = Screen::new(size, &rule);
            let mut x = Points::zeros(members).unwrap();
            for (p, seed) in (0..members).zip((0_u64..).step_by(6)) {
                let number = |c| (splitmix64(seed + c) >> 11) as f64 / (1_u64 << 53) as f64;
                // Anywhere in the cell, or about as far as the distance from the point before.
                let place = Vec3::new(number(0), number(1), number(2)) * size;
                let away = Vec3::new(number(3), number(4), number(5)).normalize() * distance;
                x.set(
                    p,
                    if p % 3 == 0 { place } else { x.get(p - 1) + away * (0.999_999 + 1e-6 * number(1)) },
                );
            }
            let pinned: Vec<bool> = (0..members).map(|p| p % 7 == 1).collect();
            let expected = by_the_method(&x, &rule, &pinned);
            moves += expected.len();
            let all: Vec<u32> = (0..).take(members).collect();
            Level::for_each(|level| {
                let (mut slots, mut moved) =
                    (Slots::new(Slots::needed(members), members).unwrap(), Vec::new());
                slots.load(0, &all, &x);
                let mut cell = Cell { members: &all, x: &x, screen, start: 0, slots: &mut slots };
                dispatch_narrow!(Narrow::widest(), simd => cell.separate(simd, &rule, &pinned, &mut moved));
                assert_eq!(moved, expected, "{members} points, {level:?}");
            });
        }
        assert!(moves > 100, "many are close: {moves}");
    }
}
