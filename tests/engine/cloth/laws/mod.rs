//! The simulation keeps the laws that this method keeps. Each has a known answer, most of them
//! exact for the discrete scheme; a tolerance covers rounding only, at about ten to a hundred times
//! of what was found.

#![expect(clippy::unwrap_used, clippy::cast_possible_truncation, reason = "a test may panic")]

mod conservation;
mod falling;
mod one_spring;
mod strip;
mod vibration;

use crate::scenes;
use drape::cloth::Points;
use drape::math::splitmix64;
use drape::scene::{Cloth, Scene, SelfCollision, Vec3};
use drape::simulation::Simulation;

const G: f64 = 9.8;

/// A cloth of `width` x `height` points and nothing but springs: no weight, damping, limit or contact.
fn springs_only(width: usize, height: usize) -> Scene {
    let mut scene = scenes::with_cloth(Cloth {
        num_width_points: width,
        num_height_points: height,
        thickness: 0.0,
        damping: 0.0,
        ..scenes::cloth()
    });
    scene.sim.gravity = Vec3::zeros();
    scene.sim.stretch_limit = None;
    scene.sim.self_collision = SelfCollision::Off;
    scene
}

fn cloth(scene: &mut Scene) -> &mut Cloth {
    scene.cloth.as_mut().unwrap()
}

fn step_of(scene: &Scene) -> f64 {
    1.0 / scene.sim.fps / f64::from(scene.sim.steps_per_frame)
}

fn mass_of(scene: &Scene) -> f64 {
    let cloth = scene.cloth.as_ref().unwrap();
    let points = (cloth.num_width_points * cloth.num_height_points) as f64;
    cloth.width * cloth.height * cloth.density / points
}

/// A number in -1..1 that depends on `index` alone.
fn noise(index: usize) -> f64 {
    (splitmix64(index as u64) >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
}

/// The simulation of `scene` with every point moving at up to `speed` m/s along each axis.
fn stirred(scene: &Scene, speed: f64) -> Simulation {
    let mut simulation = Simulation::new(scene).unwrap();
    let x = simulation.positions().clone();
    let mut last = x.clone();
    for p in 0..x.len() {
        let velocity = Vec3::new(noise(3 * p), noise(3 * p + 1), noise(3 * p + 2)) * speed;
        last.set(p, x.get(p) - velocity * step_of(scene));
    }
    simulation.set_state(x, last).unwrap();
    simulation
}

fn run(simulation: &mut Simulation, steps: usize) {
    (0..steps).for_each(|_| simulation.step());
}

/// Sum over the points of what `of` makes of the position and the last position.
fn sum(simulation: &Simulation, of: impl Fn(Vec3, Vec3) -> Vec3) -> Vec3 {
    let (x, last) = (simulation.positions(), simulation.last_positions());
    (0..x.len()).map(|p| of(x.get(p), last.get(p))).sum()
}

/// Sum over the points of the lengths of their last displacements, in metres.
fn path(simulation: &Simulation) -> f64 {
    sum(simulation, |x, last| Vec3::new((x - last).norm(), 0.0, 0.0)).x
}

/// Largest distance between corresponding points.
fn distance(a: &Points, b: &Points) -> f64 {
    (0..a.len()).map(|p| (a.get(p) - b.get(p)).norm()).fold(0.0, f64::max)
}
