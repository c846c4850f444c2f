//! One run of a scene: where it ends and the energies on its way.

use drape::error::{Error, Kind};
use drape::scene::{Cloth, Damping, Precision, Scene};
use drape::simulation::Simulation;
use drape_lab::run::start::start;

/// What a run was like.
pub(super) struct Course {
    /// Where the points end, in metres.
    x: Vec<[f64; 3]>,
    /// The farthest that they were from their start at the end of a frame, root mean square, in metres.
    pub(super) way: f64,
    /// Largest coordinate, in metres.
    pub(super) size: f64,
    /// Most energy of motion and springs, in J.
    pub(super) most: f64,
    /// The most that all energies together rose above the start, in J.
    pub(super) rise: f64,
    /// What it was stopped for.
    pub(super) stopped: Option<String>,
    /// Whether every number that a summary has of it is one.
    pub(super) finite: bool,
}

/// Runs `scene` as the program does, or with its checks off; an error if it is refused before the start.
pub(super) fn run(scene: &Scene, frames: u64, checks: bool) -> Result<Course, Error> {
    let (mut now, _) = start(scene, frames, None, !checks)?;
    let begin = positions(&now);
    let energy = now.energy();
    let mut course = Course {
        x: begin.clone(),
        way: 0.0,
        size: largest(&begin),
        most: energy.kinetic + energy.spring,
        rise: 0.0,
        stopped: None,
        finite: true,
    };
    for _ in 0..frames {
        if let Err(error) = now.advance_frame() {
            assert_eq!(error.kind, Kind::Unstable, "{error}");
            course.stopped = Some(error.message);
            break;
        }
        course.note(&now, &begin, energy.total());
    }
    Ok(course)
}

impl Course {
    fn note(&mut self, now: &Simulation, begin: &[[f64; 3]], start: f64) {
        self.x = positions(now);
        self.way = self.way.max(distance(&self.x, begin));
        self.size = self.size.max(largest(&self.x));
        let (energy, extremes) = (now.energy(), now.extremes());
        self.most = self.most.max(energy.kinetic + energy.spring);
        self.rise = self.rise.max(energy.total() - start);
        self.finite &=
            [self.way, energy.total(), extremes.speed, extremes.stretch].iter().all(|v| v.is_finite());
    }

    /// How far its points end from those of a `truth`, root mean square, in metres.
    pub(super) fn apart(&self, truth: &Self) -> f64 {
        distance(&self.x, &truth.x)
    }

    /// How far rounding may have moved the points of `cloth` in `steps` steps, in metres: at most a thousandth of its
    /// shorter side, since what moves it by more leaves nothing of it.
    pub(super) fn rounding(&self, cloth: &Cloth, precision: Precision, steps: f64) -> f64 {
        let unit = if precision == Precision::F32 { f64::from(f32::EPSILON) } else { f64::EPSILON };
        (5.0 * unit * self.size * steps.sqrt()).min(1e-3 * cloth.width.min(cloth.height))
    }
}

/// `scene` with so many `times` the steps, damped alike.
pub(super) fn finer(scene: &Scene, times: u32) -> Scene {
    let mut scene = scene.clone();
    scene.sim.steps_per_frame *= times;
    if let (Damping::PerStep, Some(cloth)) = (scene.sim.damping, &mut scene.cloth) {
        let retention = drape::math::pow(1.0 - cloth.damping / 100.0, 1.0 / f64::from(times));
        cloth.damping = 100.0 * (1.0 - retention);
    }
    scene
}

fn positions(simulation: &Simulation) -> Vec<[f64; 3]> {
    let x = simulation.positions();
    (0..x.len()).map(|p| x.get(p).into()).collect()
}

fn largest(x: &[[f64; 3]]) -> f64 {
    x.iter().flatten().fold(0.0, |most, value| value.abs().max(most))
}

/// Root mean square of the distances between points.
fn distance(a: &[[f64; 3]], b: &[[f64; 3]]) -> f64 {
    let square =
        |(a, b): (&[f64; 3], &[f64; 3])| a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>();
    (a.iter().zip(b).map(square).sum::<f64>() / a.len() as f64).sqrt()
}
