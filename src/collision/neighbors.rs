//! The cure for pairs that self-collision never sees across the border of a cell
//! (`sim.self_collision` = `neighbors`): every point is compared with those in its own cell and in
//! the 26 around it.
//!
//! A cell is so large that two points which come closer than twice the thickness during the
//! phase lie in neighbouring cells when it begins: a point moves at most `2 thickness / T` in it. So
//! the phase does what comparing each point with every other does, to the last bit. Points move
//! one after the other in index order, by the published method's rule. Measured on the stock
//! selfCollision scene over 110 frames: no two points come closer than 11.6 mm (19 mm are asked for),
//! where the search in one cell lets them come to 1.1 mm; it takes five times as long.

use std::array;
use std::ops::Range;

use super::cell_list::CellKey;
use super::pairs::Pairs;
use super::separation::{Pushes, Separation};
use super::uniform_grid::UniformGrid;
use crate::cloth::grid::Pins;
use crate::cloth::{Counters, Points, dot, filled};
use crate::error::Result;
use crate::scene::{Cloth, Sim, Vec3};

/// Just above 1: covers the rounding of a cell number too; see [`Separation::new`].
const MARGIN: f64 = 1.0 + 1e-6;

/// The points around a cell: for each of its nine columns of three cells, a range of the order.
type Around = [Range<usize>; 9];

/// Self-collision with all points that are near.
#[derive(Clone, Debug)]
pub(crate) struct Neighbors {
    rule: Separation,
    /// The points by cell.
    grid: UniformGrid,
    /// Of each occupied cell, the points around it.
    around: Vec<Around>,
    /// Of each point, the number of its cell in `around`.
    cell_of: Vec<usize>,
    /// The points close to the one at its turn.
    close: Vec<usize>,
}

impl Neighbors {
    /// Self-collision of `cloth`, whose points start at `x`.
    ///
    /// # Errors
    /// [`crate::error::Kind::Scene`] when it does not fit in memory.
    pub(super) fn new(cloth: &Cloth, sim: &Sim, x: &Points) -> Result<Self> {
        let rule = Separation::new(cloth, sim, MARGIN);
        let size = rule.distance * (1.0 + 2.0 / f64::from(sim.steps_per_frame)) * MARGIN;
        Ok(Self {
            rule,
            grid: UniformGrid::new([size; 3], x)?,
            around: filled(x.len(), Around::default())?,
            cell_of: filled(x.len(), 0)?,
            close: filled(x.len(), 0)?,
        })
    }

    /// Moves apart all close points; pinned points stay.
    pub(super) fn apply(&mut self, x: &mut Points, pins: &Pins, counters: &mut Counters) {
        self.grid.update(x);
        self.find_around();
        counters.boxes_searched += self.around.len() as u64;
        for p in pins.free.iter().cloned().flatten() {
            counters.pairs_tested += self.find_close(p, x);
            if let Some(position) = self.corrected(p, x) {
                x.set(p, position);
                counters.self_collision_moves += 1;
            }
        }
    }

    /// Finds the pairs that are too close at `x`.
    pub(super) fn find_pairs(&mut self, x: &Points, pins: &Pins, pairs: &mut Pairs, counters: &mut Counters) {
        self.grid.update(x);
        self.find_around();
        counters.boxes_searched += self.around.len() as u64;
        for p in 0..x.len() {
            counters.pairs_tested += self.find_close(p, x);
            self.close.iter().filter(|&&q| p < q).for_each(|&q| pairs.add(p, q, x, pins));
        }
    }

    /// Finds the points around every cell. Cells come in the order of their numbers, so the
    /// ranges around them only ever move forward.
    fn find_around(&mut self) {
        let (order, grid) = (self.grid.order(), &self.grid);
        let mut ends = [(0, 0); 9];
        self.around.clear();
        for members in order.chunk_by(|&p, &q| grid.key(p) == grid.key(q)) {
            let (kx, ky, kz) = grid.key(members[0]);
            let column = |n: i64| (kx.saturating_add(n / 3 - 1), ky.saturating_add(n % 3 - 1));
            self.around.push(array::from_fn(|n| {
                let (x, y) = column(n as i64);
                let (first, last) = ((x, y, kz.saturating_sub(1)), (x, y, kz.saturating_add(1)));
                let (start, end) = &mut ends[n];
                let before = |at: usize, limit: &dyn Fn(CellKey) -> bool| {
                    order.get(at).is_some_and(|&p| limit(grid.key(p)))
                };
                while before(*start, &|key| key < first) {
                    *start += 1;
                }
                *end = (*end).max(*start);
                while before(*end, &|key| key <= last) {
                    *end += 1;
                }
                *start..*end
            }));
            members.iter().for_each(|&p| self.cell_of[p as usize] = self.around.len() - 1);
        }
    }

    /// Finds the points that may be too close to point `p`; how many were compared with it.
    fn find_close(&mut self, p: usize, x: &Points) -> u64 {
        let order = self.grid.order();
        let position = x.get(p);
        let mut compared = 0;
        self.close.clear();
        for run in &self.around[self.cell_of[p]] {
            for q in order[run.clone()].iter().map(|&q| q as usize) {
                let e = position - x.get(q);
                if dot(e, e) <= self.rule.reach && q != p {
                    self.close.push(q);
                }
            }
            compared += run.len() as u64;
        }
        self.close.sort_unstable();
        compared
    }

    /// Where point `p` belongs; `None` when it may stay.
    fn corrected(&self, p: usize, x: &Points) -> Option<Vec3> {
        let position = x.get(p);
        let mut pushes = Pushes::default();
        self.close.iter().for_each(|&q| pushes.add(position - x.get(q), &self.rule));
        self.rule.corrected(position, &pushes)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::splitmix64;

    /// The phase by comparing each point with every other.
    fn brute_force(x: &mut Points, pins: &Pins, distance: f64, steps_per_frame: f64) -> Vec<[usize; 2]> {
        let mut pairs = Vec::new();
        for p in (0..x.len()).filter(|&p| !pins.pinned[p]) {
            let (mut sum, mut count) = (Vec3::zeros(), 0.0);
            for q in (0..x.len()).filter(|&q| q != p) {
                let e = x.get(p) - x.get(q);
                let l = dot(e, e).sqrt();
                if 0.0 < l && l < distance {
                    sum += e * ((distance - l) / l);
                    count += 1.0;
                    pairs.push([p, q]);
                }
            }
            if count > 0.0 {
                x.set(p, x.get(p) + sum * (1.0 / count / steps_per_frame));
            }
        }
        pairs
    }

    fn any_cloth(points: usize, seed: u64, spread: f64) -> Points {
        let mut x = Points::zeros(points).unwrap();
        for p in 0..points {
            let number = |c| (splitmix64(seed + 3 * p as u64 + c) >> 11) as f64 / (1_u64 << 52) as f64 - 1.0;
            x.set(p, Vec3::new(number(0), number(1), number(2)) * spread);
        }
        x
    }

    #[test]
    fn the_pairs_and_the_moves_are_those_of_all_against_all() {
        let text = r#"{"cloth": {"width": 1, "height": 1, "num_width_points": 15, "num_height_points": 20,
            "thickness": 0.05, "orientation": 0, "damping": 0.2, "density": 150, "ks": 5000,
            "enable_structural": true, "enable_shearing": true, "enable_bending": true,
            "pinned": [[3, 3], [4, 7]]}, "sim": {"self_collision": "neighbors"}}"#;
        let scene = crate::scene::load_text("a.json", text, &Default::default()).unwrap().scene;
        let cloth = scene.cloth.unwrap();
        let pins = Pins::new(&cloth, crate::cloth::grid::Grid { width: 15, height: 20 }).unwrap();
        for (seed, spread) in [(1, 0.1), (1000, 0.3), (5000, 1.0)] {
            for steps in [1, 2, 30] {
                let sim = Sim { steps_per_frame: steps, ..scene.sim.clone() };
                let mut x = any_cloth(300, seed, spread);
                let mut expected = x.clone();
                let mut neighbors = Neighbors::new(&cloth, &sim, &x).unwrap();
                for round in 0..20 {
                    let mut moved = x.clone();
                    neighbors.grid.update(&moved);
                    neighbors.find_around();
                    let mut pairs = Vec::new();
                    for p in (0..300).filter(|&p| !pins.pinned[p]) {
                        neighbors.find_close(p, &moved);
                        let near =
                            |&&q: &&usize| (moved.get(p) - moved.get(q)).norm() < neighbors.rule.distance;
                        pairs.extend(neighbors.close.iter().filter(near).map(|&q| [p, q]));
                        if let Some(position) = neighbors.corrected(p, &moved) {
                            moved.set(p, position);
                        }
                    }
                    let all = brute_force(&mut expected, &pins, 0.1, f64::from(steps));
                    neighbors.apply(&mut x, &pins, &mut Counters::default());
                    assert_eq!(pairs, all, "spread {spread}, {steps} steps, round {round}");
                    assert_eq!(x, expected, "spread {spread}, {steps} steps, round {round}");
                    assert!(round > 0 || !all.is_empty(), "some are close");
                }
            }
        }
    }
}
