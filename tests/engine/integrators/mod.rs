//! Each integrator solves its own discrete equations, has its order, and keeps its laws.

#![expect(clippy::unwrap_used, clippy::cast_possible_truncation, reason = "a test may panic")]

mod accuracy;
mod block_descent;
mod exact;
mod laws;
mod rk4;

use crate::scenes;
use drape::cloth::Points;
use drape::scene::{Integrator, Scene, SelfCollision};
use drape::simulation::Simulation;

const G: f64 = 9.8;
const ALL: [Integrator; 5] =
    [Integrator::Verlet, Integrator::Rk4, Integrator::Xpbd, Integrator::ImplicitEuler, Integrator::Bdf2];
const OTHERS: [Integrator; 4] =
    [Integrator::Rk4, Integrator::Xpbd, Integrator::ImplicitEuler, Integrator::Bdf2];

/// A cloth of `side` x `side` points held at two corners, undamped, without limit and contact.
fn hanging(side: usize, integrator: Integrator) -> Scene {
    let mut scene = scenes::pinned2();
    scene.sim.integrator = integrator;
    (scene.sim.stretch_limit, scene.sim.self_collision) = (None, SelfCollision::Off);
    let cloth = scene.cloth.as_mut().unwrap();
    (cloth.num_width_points, cloth.num_height_points, cloth.damping) = (side, side, 0.0);
    cloth.pinned = vec![[0, 0], [side - 1, 0]];
    scene
}

/// The same cloth, held nowhere.
fn falling(integrator: Integrator) -> Scene {
    let mut scene = hanging(4, integrator);
    scene.cloth.as_mut().unwrap().pinned.clear();
    scene
}

/// Root of the mean squared distance of corresponding points.
fn rms(a: &Points, b: &Points) -> f64 {
    let squares: f64 = (0..a.len()).map(|p| (a.get(p) - b.get(p)).norm_squared()).sum();
    (squares / a.len() as f64).sqrt()
}

/// The positions of `scene` after `frames` frames of so many steps.
fn end(scene: &Scene, frames: u32, steps_per_frame: u32) -> Simulation {
    let mut scene = scene.clone();
    scene.sim.steps_per_frame = steps_per_frame;
    let mut simulation = Simulation::new(&scene).unwrap();
    (0..frames).for_each(|_| simulation.advance_frame().unwrap());
    simulation
}
