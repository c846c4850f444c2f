//! Steps of the cloth, next to the method written down step by step, as in a textbook.

use drape::simulation::Simulation;

use super::textbook_cloth::Cloth;
use super::{medians, scene};

/// Frames before the comparison: the cloth of selfCollision has fallen and folded by then.
const FRAMES: u64 = 90;

/// A table of stock scenes.
pub(super) fn table(rounds: usize) {
    println!("\n| µs a step, after a second | drape | the method step by step | ratio |\n|---|--:|--:|--:|");
    for name in ["pinned2", "pinned4", "sphere", "plane", "selfCollision"] {
        let scene = scene(name, &[]);
        let mut simulation = Simulation::new(&scene).unwrap();
        (0..FRAMES).for_each(|_| simulation.advance_frame().unwrap());
        let triples = |points: &drape::cloth::Points| {
            (0..points.len()).map(|p| <[f64; 3]>::from(points.get(p))).collect()
        };
        let mut textbook = Cloth::new(&scene);
        textbook.x = triples(simulation.positions());
        textbook.last = triples(simulation.last_positions());
        let steps = scene.sim.steps_per_frame;
        let ours = || simulation.advance_frame().unwrap();
        let theirs = || (0..steps).for_each(|_| textbook.step());
        let [ours, theirs] =
            medians(rounds, ours, theirs).map(|time| time.as_secs_f64() * 1e6 / f64::from(steps));
        println!("| {name} | {ours:.1} | {theirs:.1} | {:.1} |", theirs / ours);
    }
}
