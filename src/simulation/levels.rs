//! The cloth moves to the last bit in the same way with every set of vector instructions.

use std::path::Path;

use super::Simulation;
use crate::lanes::level::Level;
use crate::scene::{Overrides, load_stock};

/// The state after a cloth of `points` × `points` has fallen on a ball and a plane for some frames.
fn state(points: u32, frames: usize) -> (u64, u64) {
    let sets = [
        &format!("cloth.num_width_points={points}"),
        &format!("cloth.num_height_points={points}"),
        "cloth.thickness=0.012",
        "cloth.ks=500",
        "sphere.origin=[0.5,0.79,0.5]",
        r#"plane={"point":[0,0.95,0],"normal":[0.1,1,0],"friction":0.4}"#,
        "sim.contact=\"outside\"",
    ];
    let overrides = Overrides { sets: sets.map(str::to_owned).to_vec(), ..Overrides::default() };
    let scene = load_stock(Path::new("scenes/sphere.json"), &overrides).unwrap().scene;
    let mut simulation = Simulation::new(&scene).unwrap();
    simulation.allow_unstable();
    (0..frames).for_each(|_| simulation.advance_frame().unwrap());
    let counters = simulation.counters();
    assert!(counters.self_collision_moves > 0 && counters.object_moves > 0 && counters.springs_limited > 0);
    (simulation.state_hash(), counters.object_moves)
}

#[test]
fn every_level_moves_the_cloth_to_the_same_bits() {
    for (points, frames) in [(50, 12), (91, 6)] {
        let widest = state(points, frames);
        for level in Level::available() {
            level.limit();
            assert_eq!(state(points, frames), widest, "{points} x {points} points, {level:?}");
        }
        Level::Avx512.limit();
    }
}
