//! Phase 3: points of one box that are closer than twice the thickness are moved apart.
//!
//! The boxes do not influence one another: a point is moved by the members of its own box only.
//! So going box by box, and in index order within each, gives what index order over the whole
//! cloth gives; and a box in which no two points are close at its turn is left as it is.

use std::ops::Range;

use super::boxes::Boxes;
use super::grid::{Grid, Pins};
use super::{Counters, Points};
use crate::dispatch::{Work, dispatch};
use crate::error::Result;
use crate::scene::{Cloth, Sim, Vec3};

/// Just above 1: covers the rounding of a squared length, so that no close pair is overlooked.
const MARGIN: f64 = 1.0 + 1e-12;

/// Self-collision of a cloth.
#[derive(Clone, Debug)]
pub(crate) struct SelfCollision {
    /// Distance that two points keep, in metres: 2 · thickness.
    distance: f64,
    /// A squared distance that no closer pair exceeds, in m².
    reach: f64,
    /// Steps per frame.
    steps_per_frame: f64,
    /// The points by box.
    pub(crate) boxes: Boxes,
    /// The positions of one box's members.
    positions: Points,
}

impl SelfCollision {
    /// Self-collision of `cloth`, whose points start at `x`.
    ///
    /// # Errors
    /// [`crate::error::Kind::Scene`] when it does not fit in memory.
    pub(crate) fn new(cloth: &Cloth, sim: &Sim, grid: Grid, x: &Points) -> Result<Self> {
        let distance = 2.0 * cloth.thickness;
        let bx = 3.0 * cloth.width / grid.width as f64;
        let by = 3.0 * cloth.height / grid.height as f64;
        Ok(Self {
            distance,
            reach: distance * distance * MARGIN,
            steps_per_frame: f64::from(sim.steps_per_frame),
            boxes: Boxes::new([bx, by, bx.max(by)], x)?,
            positions: Points::zeros(grid.len())?,
        })
    }

    /// Moves apart the close points of every box; pinned points stay.
    pub(crate) fn apply(&mut self, x: &mut Points, pins: &Pins, counters: &mut Counters) {
        self.boxes.update(x);
        dispatch(EachBox { collision: self, x, pins, counters });
    }

    /// Copies the positions of the members of box `index`.
    #[inline(always)]
    fn gather(&mut self, index: usize, x: &Points) {
        for (to, &p) in self.boxes.members(index).iter().enumerate() {
            self.positions.x[to] = x.x[p];
            self.positions.y[to] = x.y[p];
            self.positions.z[to] = x.z[p];
        }
    }

    /// Whether two of the first `size` gathered positions may be too close.
    #[inline(always)]
    fn any_close(&self, size: usize) -> bool {
        for at in 0..size {
            if self.close_to_any(at, at + 1..size) {
                return true;
            }
        }
        false
    }

    /// Whether the gathered position `at` may be too close to one of `others`.
    ///
    /// A pair that is too close never exceeds `reach`: its squared length is below (2 ·
    /// thickness)² but for the rounding of two squares and a root, far less than [`MARGIN`].
    #[inline(always)]
    fn close_to_any(&self, at: usize, others: Range<usize>) -> bool {
        let mut any = false;
        self.squares_from(at, others).for_each(|square| any |= square <= self.reach);
        any
    }

    /// The squared distances from the gathered position `at` to `others`, in m².
    #[inline(always)]
    fn squares_from(&self, at: usize, others: Range<usize>) -> impl Iterator<Item = f64> {
        let Points { x, y, z } = &self.positions;
        let (px, py, pz) = (x[at], y[at], z[at]);
        x[others.clone()].iter().zip(&y[others.clone()]).zip(&z[others]).map(move |((x, y), z)| {
            let (ex, ey, ez) = (px - x, py - y, pz - z);
            ex * ex + ey * ey + ez * ez
        })
    }

    /// Moves the unpinned members of box `index` one after the other; how many moved.
    #[inline(always)]
    fn move_apart(&mut self, index: usize, x: &mut Points, pins: &Pins) -> u64 {
        let members = self.boxes.members(index);
        let mut moved = 0;
        for (at, &p) in members.iter().enumerate().filter(|&(_, &p)| !pins.pinned[p]) {
            if let Some(position) = self.corrected(at, members.len()) {
                self.positions.set(at, position);
                x.set(p, position);
                moved += 1;
            }
        }
        moved
    }

    /// Where the gathered point `at` belongs among the first `size`; nothing when it may stay.
    #[inline(always)]
    fn corrected(&self, at: usize, size: usize) -> Option<Vec3> {
        if !self.close_to_any(at, 0..at) && !self.close_to_any(at, at + 1..size) {
            return None;
        }
        let position = self.positions.get(at);
        let (mut sum, mut count) = (Vec3::zeros(), 0.0);
        for (other, square) in self.squares_from(at, 0..size).enumerate() {
            if square <= self.reach {
                let l = square.sqrt();
                if 0.0 < l && l < self.distance {
                    sum += (position - self.positions.get(other)) * ((self.distance - l) / l);
                    count += 1.0;
                }
            }
        }
        (count > 0.0).then(|| position + sum * (1.0 / count / self.steps_per_frame))
    }
}

/// The phase, box by box.
struct EachBox<'a> {
    collision: &'a mut SelfCollision,
    x: &'a mut Points,
    pins: &'a Pins,
    counters: &'a mut Counters,
}

impl Work for EachBox<'_> {
    #[inline(always)]
    fn run(self) {
        let Self { collision, x, pins, counters } = self;
        for index in 0..collision.boxes.count() {
            let size = collision.boxes.members(index).len();
            collision.gather(index, x);
            counters.boxes_searched += 1;
            counters.pairs_tested += (size * (size - 1) / 2) as u64;
            if collision.any_close(size) {
                counters.self_collision_moves += collision.move_apart(index, x, pins);
            }
        }
    }
}
