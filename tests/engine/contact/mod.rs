//! Contact under `sim.contact` = `coulomb`: its laws against closed forms.

mod energy;
mod extremes;
mod itself;
mod page;
mod sliding;
mod swept;

use drape::cloth::Points;
use drape::scene::{Overrides, Scene, Vec3, load_text};
use drape::simulation::Simulation;

/// A cloth of 4 x 4 points without damping, thickness and stretch limit at y = 1, under `coulomb`, with `sets`.
fn scene(sets: &[&str]) -> Scene {
    let text = r#"{"cloth": {"width": 1, "height": 1, "num_width_points": 4, "num_height_points": 4,
        "thickness": 0, "orientation": 0, "damping": 0, "density": 150, "ks": 5000,
        "enable_structural": true, "enable_shearing": true, "enable_bending": true},
        "sim": {"contact": "coulomb", "damping": "per_second", "stretch_limit": null}}"#;
    let sets = sets.iter().map(ToString::to_string).collect();
    load_text("scene.json", text, &Overrides { sets, ..Overrides::default() }).unwrap().scene
}

/// The integrators, with what the start of each needs for its first step to be right.
const INTEGRATORS: [&[&str]; 6] = [
    &["sim.start=half_step"],
    &["sim.start=half_step", "sim.precision=f32"],
    &["sim.integrator=rk4"],
    &["sim.integrator=xpbd", "sim.iterations=4"],
    &["sim.integrator=implicit_euler", "sim.tolerance=1e-9"],
    &["sim.integrator=bdf2", "sim.tolerance=1e-9"],
];

/// The simulation of `scene` with a ledger.
fn simulation(scene: &Scene) -> Simulation {
    let mut simulation = Simulation::new(scene).unwrap();
    simulation.record_ledger().unwrap();
    simulation
}

/// `scene` after `seconds`.
fn after(scene: &Scene, seconds: f64) -> Simulation {
    let mut simulation = simulation(scene);
    let frames = (seconds * scene.sim.fps).round() as u64;
    (0..frames).for_each(|_| simulation.advance_frame().unwrap());
    simulation
}

/// The mean position.
fn middle(x: &Points) -> Vec3 {
    (0..x.len()).map(|p| x.get(p)).sum::<Vec3>() / x.len() as f64
}

/// How far the points are from where they started, at most, in metres.
fn farthest(simulation: &Simulation, scene: &Scene) -> f64 {
    let start = Simulation::new(scene).unwrap();
    let (x, start) = (simulation.positions(), start.positions());
    (0..x.len()).map(|p| (x.get(p) - start.get(p)).norm()).fold(0.0, f64::max)
}
