//! Copies of a simulation that differ by rounding.

use rayon::prelude::*;

use super::{Parting, Spread, distance};
use drape::cloth::Points;
use drape::error::Result;
use drape::math::splitmix64;
use drape::scene::Scene;
use drape::simulation::Simulation;

/// Copies beside the simulation itself.
pub const COPIES: usize = 3;

/// A simulation, and copies of it.
pub(super) struct Copies {
    /// The simulation itself is the first.
    simulations: Vec<Simulation>,
    /// In metres.
    pub(super) rounding: f64,
}

impl Copies {
    /// The simulation of `scene`, and copies whose free points start a rounding error away in each coordinate, up or
    /// down at random but the same in every run; their speeds are the same.
    pub(super) fn new(scene: &Scene) -> Result<Self> {
        let first = Simulation::new(scene)?;
        let x = first.positions();
        let farthest = (0..x.len()).map(|p| x.get(p).amax()).fold(0.0, f64::max);
        let rounding = 0.5 * f64::EPSILON * farthest;
        let mut simulations = vec![first];
        for copy in 0..COPIES as u64 {
            let mut simulation = Simulation::new(scene)?;
            let [mut x, mut last] = [simulation.positions().clone(), simulation.last_positions().clone()];
            let pinned = pinned(scene);
            for p in (0..x.len()).filter(|p| !pinned.contains(p)) {
                let bits = splitmix64(copy * x.len() as u64 + p as u64);
                let sign = |bit: u32| if bits >> bit & 1 == 1 { rounding } else { -rounding };
                let moved = drape::scene::Vec3::new(sign(0), sign(1), sign(2));
                x.set(p, x.get(p) + moved);
                last.set(p, last.get(p) + moved);
            }
            simulation.set_state(x, last)?;
            simulations.push(simulation);
        }
        Ok(Self { simulations, rounding })
    }

    /// Advances all by a frame.
    pub(super) fn advance(&mut self) -> Result<()> {
        self.simulations.par_iter_mut().try_for_each(Simulation::advance_frame)
    }

    fn others(&self) -> impl Iterator<Item = &Points> {
        self.simulations[1..].iter().map(Simulation::positions)
    }

    /// How far they have parted.
    pub(super) fn parting(&self) -> Parting {
        let first = self.simulations[0].positions();
        let distances = self.others().flat_map(|x| (0..x.len()).map(|p| distance(x.get(p), first.get(p))));
        let (mut sum, mut max, mut count) = (0.0, 0.0_f64, 0.0_f64);
        for distance in distances {
            sum += distance * distance;
            max = max.max(distance);
            count += 1.0;
        }
        Parting { time: self.simulations[0].time(), rms: (sum / count.max(1.0)).sqrt(), max }
    }

    /// Of each point, the largest distance of a copy.
    pub(super) fn map(&self) -> Vec<f64> {
        let first = self.simulations[0].positions();
        let of = |p: usize| self.others().map(|x| distance(x.get(p), first.get(p))).fold(0.0, f64::max);
        (0..first.len()).map(of).collect()
    }

    /// What they agree on.
    pub(super) fn spread(&self) -> Spread {
        let range = |of: &dyn Fn(&Simulation) -> f64| {
            let values = self.simulations.iter().map(of);
            [values.clone().fold(f64::INFINITY, f64::min), values.fold(f64::NEG_INFINITY, f64::max)]
        };
        let heights = |s: &Simulation| s.positions().y.clone();
        Spread {
            energy: range(&|s| s.energy().total()),
            lowest: range(&|s| heights(s).into_iter().fold(f64::INFINITY, f64::min)),
            mean: range(&|s| heights(s).iter().sum::<f64>() / s.positions().len().max(1) as f64),
            highest: range(&|s| heights(s).into_iter().fold(f64::NEG_INFINITY, f64::max)),
        }
    }
}

/// The numbers of the pinned points.
fn pinned(scene: &Scene) -> Vec<usize> {
    let cloth = scene.cloth.iter();
    cloth.flat_map(|c| c.pinned.iter().map(|&[i, j]| j * c.num_width_points + i)).collect()
}
