//! Copies of a simulation that differ by rounding.

use rayon::prelude::*;

use super::{Parting, Spread};
use crate::accuracy::measure::{Measure, Shape, difference};
use crate::accuracy::run::Run;
use drape::error::Result;
use drape::math::splitmix64;
use drape::scene::Scene;
use drape::simulation::Simulation;

/// Copies beside the simulation itself.
pub const COPIES: usize = 3;

/// A simulation, and copies of it.
pub(super) struct Copies<'a> {
    scene: &'a Scene,
    /// The simulation itself is the first.
    runs: Vec<Run>,
    /// In metres.
    pub(super) rounding: f64,
}

impl<'a> Copies<'a> {
    /// The simulation of `scene`, and copies whose free points start a rounding error away in each coordinate, up or
    /// down at random but the same in every run; their speeds are the same.
    pub(super) fn new(scene: &'a Scene) -> Result<Self> {
        let first = Run::new(scene)?;
        let x = first.simulation.positions();
        let farthest = (0..x.len()).map(|p| x.get(p).amax()).fold(0.0, f64::max);
        let rounding = 0.5 * f64::EPSILON * farthest;
        let mut runs = vec![first];
        for copy in 0..COPIES as u64 {
            let mut run = Run::new(scene)?;
            let simulation = &mut run.simulation;
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
            runs.push(run);
        }
        Ok(Self { scene, runs, rounding })
    }

    /// Advances all by a frame.
    pub(super) fn advance(&mut self) -> Result<()> {
        self.runs.par_iter_mut().try_for_each(|run| run.simulation.advance_frame())
    }

    /// Springs visited by all.
    pub(super) fn springs_visited(&self) -> u64 {
        self.runs.iter().map(Run::springs).sum()
    }

    /// How far they have parted; in the picture too if `measure` is.
    pub(super) fn parting(&self, measure: Measure) -> Result<Parting> {
        let apart = self.apart(Measure::Max)?;
        let of = |measure: Measure, apart: &[Shape]| measure.size(&apart.concat());
        let pixels = match measure {
            Measure::Pixels => Some(of(measure, &self.apart(measure)?)),
            Measure::Rms | Measure::Max => None,
        };
        let time = self.runs[0].simulation.time();
        Ok(Parting { time, rms: of(Measure::Rms, &apart), max: of(Measure::Max, &apart), pixels })
    }

    /// What the points of each copy differ by from those of the first.
    fn apart(&self, measure: Measure) -> Result<Vec<Shape>> {
        let shape = |run: &Run| measure.shape(self.scene, run.simulation.positions());
        let first = shape(&self.runs[0])?;
        self.runs[1..].iter().map(|run| Ok(difference(&shape(run)?, &first))).collect()
    }

    /// Of each point, the largest distance of a copy.
    pub(super) fn map(&self) -> Result<Vec<f64>> {
        let apart = self.apart(Measure::Max)?;
        let of = |p: usize| apart.iter().map(|copy| Measure::Max.size(&copy[p..=p])).fold(0.0, f64::max);
        Ok((0..self.runs[0].simulation.positions().len()).map(of).collect())
    }

    /// What they agree on.
    pub(super) fn spread(&self) -> Spread {
        let range = |of: &dyn Fn(&Simulation) -> f64| {
            let values = self.runs.iter().map(|run| of(&run.simulation));
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
