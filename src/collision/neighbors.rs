//! The cure for pairs that self-collision never sees across the border of a cell
//! (`sim.self_collision` = `neighbors`): every point is compared with those in its own cell and in
//! the 26 around it.
//!
//! A cell is so large that two points which come closer than twice the thickness during the
//! phase lie in neighbouring cells when it begins: a point moves at most `2 thickness / T` in it. So
//! the phase does what comparing each point with every other does, to the last bit. Points move
//! one after the other in index order, by the published method's rule. Measured on the stock
//! selfCollision scene over 110 frames: no two points come closer than 11.6 mm (19 mm are asked for),
//! where the search in one cell lets them come to 1.1 mm.
//!
//! Few pairs come close, so all are first compared where they are when the phase begins. A point that has its turn has
//! not moved yet, and another one once at most, by up to `2 thickness / T`. So a pair that is closer at a turn than twice
//! the thickness is at most that much further apart when the phase begins. Only such pairs are looked at again, at the turn
//! of each point: in index order, where the points are then, and by the exact rule. Others would add nothing to its pushes.

use rayon::prelude::*;

use super::candidates::Candidates;
use super::pairs::Pairs;
use super::partners::Partners;
use super::separation::{Pushes, Separation};
use super::sorted::Sorted;
use super::uniform_grid::UniformGrid;
use crate::cloth::grid::Pins;
use crate::cloth::{Counters, Points, chunks, filled};
use crate::error::Result;
use crate::lanes::level::{Narrow, dispatch_narrow};
use crate::scene::{Cloth, Sim, Vec3};

/// Points of a part of a large cloth.
const POINTS: usize = 2048;

/// Just above 1: covers the rounding of positions, of squared lengths and of cell numbers.
const MARGIN: f64 = 1.0 + 1e-6;

/// More than what some operations round a coordinate by, relative to it: 2⁻⁴⁶, where one rounds by 2⁻⁵³.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// Self-collision with all points that are near.
#[derive(Clone, Debug)]
pub(crate) struct Neighbors {
    rule: Separation,
    /// Size of a cell, in metres.
    size: f64,
    /// The distance of two points when the phase begins that those exceed which do not come close, in metres.
    reach: f64,
    /// The points by cell.
    grid: UniformGrid,
    sorted: Sorted,
    /// As many cells each, in order.
    parts: Vec<Candidates>,
    partners: Partners,
    /// Whether so many pairs may come close that they are not kept: then each point is compared with all others.
    is_crowded: bool,
}

impl Neighbors {
    /// Self-collision of `cloth`, whose points start at `x`.
    ///
    /// # Errors
    /// [`crate::error::Kind::Scene`] when it does not fit in memory.
    pub(super) fn new(cloth: &Cloth, sim: &Sim, x: &Points) -> Result<Self> {
        let rule = Separation::new(cloth, sim);
        let size = rule.distance * (1.0 + 2.0 / f64::from(sim.steps_per_frame)) * MARGIN;
        Ok(Self {
            rule,
            size,
            reach: rule.distance * (1.0 + 1.0 / f64::from(sim.steps_per_frame)) * MARGIN,
            grid: UniformGrid::new([size; 3], x)?,
            sorted: Sorted::new(x.len())?,
            parts: filled((x.len() / POINTS).max(1), Candidates::default())?,
            partners: Partners::new(x.len())?,
            is_crowded: false,
        })
    }

    /// Moves apart all close points; pinned points stay.
    pub(super) fn apply(&mut self, x: &mut Points, pins: &Pins, counters: &mut Counters) {
        self.search(x, |p| !pins.pinned[p], counters);
        for p in pins.free.iter().cloned().flatten() {
            if let Some(position) = self.corrected(p, x) {
                x.set(p, position);
                counters.self_collision_moves += 1;
            }
        }
    }

    /// Finds the pairs that are too close at `x`.
    pub(super) fn find_pairs(&mut self, x: &Points, pins: &Pins, pairs: &mut Pairs, counters: &mut Counters) {
        self.search(x, |_| true, counters);
        for p in 0..x.len() {
            self.for_each_partner(p, x.len(), |q| {
                if p < q {
                    pairs.add(p, q, x, pins);
                }
            });
        }
    }

    /// Finds the points that may come close to each that `is_searched`; they are at `x`.
    fn search(&mut self, x: &Points, is_searched: impl Fn(usize) -> bool, counters: &mut Counters) {
        self.grid.update(x);
        self.sorted.take(&self.grid, x, is_searched);
        let reach = self.squared_reach();
        let Self { sorted, parts, partners, .. } = self;
        let (cells, count) = (sorted.cells(), parts.len());
        parts.par_iter_mut().with_min_len(chunks::at_once(x.len())).enumerate().for_each(|(index, part)| {
            let cells = index * cells / count..(index + 1) * cells / count;
            dispatch_narrow!(Narrow::widest(), simd => part.find(simd, sorted, cells, reach));
        });
        counters.boxes_searched += cells as u64;
        counters.pairs_tested += parts.iter().map(|part| part.around).sum::<u64>();
        self.is_crowded = parts.iter().any(|part| part.is_full);
        if !self.is_crowded {
            partners.take(parts.iter().map(|part| &*part.pairs));
        }
    }

    /// Visits those of `points` points that may come close to point `p`, in index order.
    fn for_each_partner(&self, p: usize, points: usize, visit: impl FnMut(usize)) {
        if self.is_crowded {
            (0..points).filter(|&q| q != p).for_each(visit);
        } else {
            self.partners.of(p).iter().map(|&q| q as usize).for_each(visit);
        }
    }

    /// The squared distance that pairs exceed which do not come close, in m².
    fn squared_reach(&self) -> f64 {
        // A coordinate is at most that of the farther border of the farthest cell.
        let reach = self.reach + (self.grid.largest() as f64 + 1.0) * self.size * ROUNDING;
        // The least normal number covers squares that are too small to be rounded like others.
        reach * reach + f64::MIN_POSITIVE
    }

    /// Where point `p` belongs; `None` when it may stay.
    fn corrected(&self, p: usize, x: &Points) -> Option<Vec3> {
        let position = x.get(p);
        let mut pushes = Pushes::default();
        self.for_each_partner(p, x.len(), |q| pushes.add(position - x.get(q), &self.rule));
        self.rule.corrected(position, &pushes)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lanes::level::Level;
    use crate::math::dot;
    use crate::math::splitmix64;
    use crate::scene::{Overrides, Scene, load_text};

    /// A cloth of `width` points a row, with pins, that keeps a distance of 10 cm.
    fn scene(width: usize, height: usize, steps: u32) -> Scene {
        let text = format!(
            r#"{{"cloth": {{"width": 1, "height": 1, "num_width_points": {width}, "num_height_points": {height},
            "thickness": 0.05, "orientation": 0, "damping": 0.2, "density": 150, "ks": 5000,
            "enable_structural": true, "enable_shearing": true, "enable_bending": true,
            "pinned": [[3, 3], [4, 7]]}}, "sim": {{"self_collision": "neighbors", "steps_per_frame": {steps}}}}}"#
        );
        load_text("a.json", &text, &Overrides::default()).unwrap().scene
    }

    /// The phase by comparing each point with every other; how many points moved.
    fn brute_force(x: &mut Points, pins: &Pins, distance: f64, steps_per_frame: f64) -> u64 {
        let mut moves = 0;
        for p in (0..x.len()).filter(|&p| !pins.pinned[p]) {
            let (mut sum, mut count) = (Vec3::zeros(), 0.0);
            for q in (0..x.len()).filter(|&q| q != p) {
                let e = x.get(p) - x.get(q);
                let l = dot(e, e).sqrt();
                if 0.0 < l && l < distance {
                    sum += e * ((distance - l) / l);
                    count += 1.0;
                }
            }
            if count > 0.0 {
                x.set(p, x.get(p) + sum * (1.0 / count / steps_per_frame));
                moves += 1;
            }
        }
        moves
    }

    /// The cells of points at `x`, and how many points are in those around each that `is_searched`, straight from the definition.
    fn around(x: &Points, size: f64, is_searched: impl Fn(usize) -> bool) -> (u64, u64) {
        let cell = |p: usize| x.get(p).map(|x| (x / size).floor());
        let cells: std::collections::BTreeSet<_> =
            (0..x.len()).map(|p| cell(p).map(f64::to_bits)).map(<[u64; 3]>::from).collect();
        let pairs = (0..x.len()).filter(|&p| is_searched(p)).flat_map(|p| (0..x.len()).map(move |q| (p, q)));
        let near = pairs.filter(|&(p, q)| (cell(p) - cell(q)).amax() <= 1.0);
        (cells.len() as u64, near.count() as u64)
    }

    /// Points anywhere in five cubes whose centres are up to `apart` from the origin.
    fn any_cloth(points: usize, seed: u64, spread: f64, apart: f64) -> Points {
        let number = |i: u64| (splitmix64(seed + i) >> 11) as f64 / (1_u64 << 52) as f64 - 1.0;
        let vector = |i: u64| Vec3::new(number(i), number(i + 1), number(i + 2));
        let mut x = Points::zeros(points).unwrap();
        for p in 0..points {
            x.set(p, vector(3 * p as u64) * spread + vector(100_000 + 3 * (p as u64 % 5)) * apart);
        }
        x
    }

    #[test]
    fn the_moves_and_the_counts_are_those_of_all_against_all() {
        for (seed, spread, apart) in [
            (2, 0.02, 0.0),
            (1, 0.1, 0.0),
            (1000, 0.3, 0.0),
            (5000, 1.0, 0.0),
            (9, 0.2, 3e4),
            (7, 0.2, 3e6),
            (8, 1e6, 1e25),
        ] {
            for steps in [1, 2, 30] {
                let scene = scene(15, 20, steps);
                let (cloth, sim) = (scene.cloth.as_ref().unwrap(), &scene.sim);
                let pins = Pins::new(cloth, crate::cloth::grid::Grid { width: 15, height: 20 }).unwrap();
                let start = any_cloth(300, seed, spread, apart);
                Level::for_each(|level| {
                    let (mut x, mut expected) = (start.clone(), start.clone());
                    let mut neighbors = Neighbors::new(cloth, sim, &x).unwrap();
                    for round in 0..8 {
                        let place =
                            format!("{spread} m, {apart} m apart, {steps} steps, {level:?}, round {round}");
                        let mut counters = Counters::default();
                        let size = 0.1 * (1.0 + 2.0 / f64::from(steps)) * MARGIN;
                        let (cells, pairs) = around(&x, size, |p| !pins.pinned[p]);
                        let moves = brute_force(&mut expected, &pins, 0.1, f64::from(steps));
                        neighbors.apply(&mut x, &pins, &mut counters);
                        assert_eq!(x, expected, "{place}");
                        if round == 0 && spread != 0.1 {
                            assert_eq!(neighbors.is_crowded, spread < 0.1, "{place}");
                        }
                        assert_eq!(counters.self_collision_moves, moves, "{place}");
                        assert!(round > 0 || moves > 0 || spread > 1.0, "{place}: some are close");
                        if apart < 1e5 {
                            assert_eq!(
                                (counters.boxes_searched, counters.pairs_tested),
                                (cells, pairs),
                                "{place}"
                            );
                        }
                    }
                });
            }
        }
    }

    #[test]
    fn a_cloth_in_several_parts_moves_as_all_against_all() {
        let scene = scene(70, 71, 30);
        let (cloth, sim) = (scene.cloth.as_ref().unwrap(), &scene.sim);
        let pins = Pins::new(cloth, crate::cloth::grid::Grid { width: 70, height: 71 }).unwrap();
        let mut x = any_cloth(4970, 3, 0.8, 0.2);
        let (mut expected, mut counters) = (x.clone(), Counters::default());
        let mut neighbors = Neighbors::new(cloth, sim, &x).unwrap();
        assert_eq!(neighbors.parts.len(), 2);
        neighbors.apply(&mut x, &pins, &mut counters);
        assert_eq!(counters.self_collision_moves, brute_force(&mut expected, &pins, 0.1, 30.0));
        assert!(x == expected && counters.self_collision_moves > 1000);
    }

    #[test]
    fn the_pairs_are_those_of_all_against_all_in_order() {
        let mut scene = scene(15, 20, 30);
        scene.sim.contact = crate::scene::Contact::Coulomb;
        let (cloth, sim) = (scene.cloth.as_ref().unwrap(), &scene.sim);
        let pins = Pins::new(cloth, crate::cloth::grid::Grid { width: 15, height: 20 }).unwrap();
        let start = any_cloth(300, 1, 10.0, 0.0);
        for spread in [0.1, 0.4, 1.0] {
            let x = any_cloth(300, 77, spread, 0.0);
            let [mut found, mut expected] = [(); 2].map(|()| Pairs::new(cloth, sim, &start).unwrap());
            let (mut neighbors, mut counters) =
                (Neighbors::new(cloth, sim, &x).unwrap(), Counters::default());
            neighbors.find_pairs(&x, &pins, &mut found, &mut counters);
            (0..300)
                .flat_map(|p| (p + 1..300).map(move |q| (p, q)))
                .for_each(|(p, q)| expected.add(p, q, &x, &pins));
            assert!(found.close == expected.close && !found.close.is_empty(), "{spread} m");
            let size = 0.1 * (1.0 + 2.0 / 30.0) * MARGIN;
            assert_eq!(
                (counters.boxes_searched, counters.pairs_tested),
                around(&x, size, |_| true),
                "{spread} m"
            );
        }
    }
}
