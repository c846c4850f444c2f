//! Contact of the cloth with itself under `sim.contact` = `coulomb`.
//!
//! Two points keep the distance of twice the thickness, or the distance that they start with if that is less: what
//! overlaps at the start is not driven apart. Of a pair that is closer at the end of a step than it may be:
//!
//! - the approach ends: both points get the mean of their velocities along the line that joins them, and their way in
//!   the step likewise, but for what was left of the distance (an inelastic collision of equal masses);
//! - what it was too close before the step is made good by a part of it, `1 / T` with T steps a frame as in the report.
//!   `last` moves along, so that this gives no speed.

use super::coulomb::Coulomb;
use crate::cloth::grid::Pins;
use crate::cloth::{Counters, Points};
use crate::error::Result;
use crate::math::{dot, length};
use crate::scene::{Cloth, Sim, Vec3};

/// How often the approach of every pair is ended in a step: in a pile each pair brings its neighbours closer again.
const PASSES: usize = 4;

/// The pairs that are too close.
#[derive(Clone, Debug)]
pub(crate) struct Pairs {
    /// Distance that two points keep, in metres.
    distance: f64,
    /// The part of the distance that one step makes good.
    part: f64,
    /// Where the points start.
    start: Points,
    /// The points of each pair, the lower number first.
    pub(super) close: Vec<[usize; 2]>,
}

impl Pairs {
    /// Of a cloth whose points start at `x`.
    pub(super) fn new(cloth: &Cloth, sim: &Sim, x: &Points) -> Result<Self> {
        let mut start = Points::zeros(x.len())?;
        start.copy_from(x);
        let part = 1.0 / f64::from(sim.steps_per_frame);
        Ok(Self { distance: 2.0 * cloth.thickness, part, start, close: Vec::new() })
    }

    /// Adds the pair of `p` and `q`, at `x`, if it is too close and one of both can move.
    pub(super) fn add(&mut self, p: usize, q: usize, x: &Points, pins: &Pins) {
        let e = x.get(p) - x.get(q);
        let square = dot(e, e);
        let near = square < self.distance * self.distance;
        if near && square.sqrt() < self.kept([p, q]) && !(pins.pinned[p] && pins.pinned[q]) {
            self.close.push([p, q]);
        }
    }

    /// The distance that a pair keeps, in metres.
    fn kept(&self, [p, q]: [usize; 2]) -> f64 {
        self.distance.min(length(self.start.get(p) - self.start.get(q)))
    }

    /// Makes good a part of what pairs were too close at `last`, before the step.
    pub(super) fn push_apart(&self, x: &mut Points, last: &mut Points, pins: &Pins, counters: &mut Counters) {
        for &pair in &self.close {
            let [p, q] = pair;
            let e = last.get(p) - last.get(q);
            let (l, kept) = (length(e), self.kept(pair));
            if 0.0 < l && l < kept {
                let push = e * (self.part * (kept - l) / l);
                for (point, share) in shares(pair, pins) {
                    x.set(point, x.get(point) + push * share);
                    last.set(point, last.get(point) + push * share);
                }
                counters.self_collision_moves += 1;
            }
        }
    }

    /// Ends the approach of every pair. `velocity` is how far a point goes in a step, of its number and both
    /// positions.
    pub(crate) fn end_approach(
        &self,
        contact: &mut Coulomb,
        x: &mut Points,
        last: &Points,
        pins: &Pins,
        velocity: impl Fn(usize, Vec3, Vec3) -> Vec3,
    ) {
        for &pair in self.close.iter().cycle().take(PASSES * self.close.len()) {
            let [p, q] = pair;
            let e = last.get(p) - last.get(q);
            let l = length(e);
            let n = e / l;
            // How much nearer they come than they may.
            let excess = dot(x.get(p) - x.get(q), n) - l + (l - self.kept(pair)).max(0.0);
            if l == 0.0 || excess >= 0.0 {
                continue;
            }
            for p in pair.into_iter().filter(|&p| !pins.pinned[p]) {
                contact.touch(p, || velocity(p, x.get(p), last.get(p)));
            }
            approach_less(x, pair, n * excess, pins);
            let speed = dot(contact.velocity.get(p) - contact.velocity.get(q), n);
            if speed < 0.0 {
                let before = contact.square_of(pair);
                approach_less(&mut contact.velocity, pair, n * speed, pins);
                contact.change.self_collision += contact.square_of(pair) - before;
            }
        }
    }
}

/// Takes `approach` from what the first point of a pair has more than the second.
fn approach_less(of: &mut Points, pair: [usize; 2], approach: Vec3, pins: &Pins) {
    shares(pair, pins).for_each(|(p, share)| of.set(p, of.get(p) - approach * share));
}

/// The points of a pair, and which part of a change of the first less the second each has: none if it is pinned.
fn shares([p, q]: [usize; 2], pins: &Pins) -> impl Iterator<Item = (usize, f64)> {
    let parts = match (pins.pinned[p], pins.pinned[q]) {
        (false, false) => [0.5, -0.5],
        (false, true) => [1.0, 0.0],
        (true, false) => [0.0, -1.0],
        (true, true) => [0.0, 0.0],
    };
    [p, q].into_iter().zip(parts).filter(|(_, part)| *part != 0.0)
}
