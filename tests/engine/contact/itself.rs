//! Contact of the cloth with itself under `coulomb`: pushing apart gives no speed, and approach is inelastic.

use drape::scene::{Overrides, Scene, load};

use super::{scene, simulation};

/// The stock selfCollision cloth of 20 x 20 points, which falls on itself, with `sets`.
fn falling(sets: &[&str]) -> Scene {
    let path = crate::repository::path("scenes/selfCollision.json");
    let size = ["cloth.num_width_points=20", "cloth.num_height_points=20", "cloth.thickness=0.02"];
    let sets = [&size[..], &["sim.damping=per_second", "sim.contact=coulomb"], sets].concat();
    let sets = sets.iter().map(ToString::to_string).collect();
    load(&path, &Overrides { sets, ..Overrides::default() }).unwrap().scene
}

/// Neighbours that start closer than twice the thickness are not driven apart.
#[test]
fn what_overlaps_at_the_start_stays_at_rest() {
    for search in ["sim.self_collision=same_box", "sim.self_collision=neighbors"] {
        let sets = ["cloth.num_width_points=20", "cloth.num_height_points=20", "cloth.thickness=0.05"];
        let mut simulation = simulation(&scene(&[&sets[..], &["sim.gravity=[0,0,0]", search]].concat()));
        (0..30).for_each(|_| simulation.advance_frame().unwrap());
        assert_eq!(simulation.extremes().speed, 0.0, "{search}");
        assert!(simulation.counters().pairs_tested > 0, "{search}: pairs were looked at");
    }
}

/// A cloth that falls on itself only loses energy by that, and keeps its distance, at every step.
#[test]
fn a_cloth_that_falls_on_itself_loses_energy_and_keeps_its_distance() {
    for steps in [15, 60] {
        let steps = format!("sim.steps_per_frame={steps}");
        let mut simulation = simulation(&falling(&[&steps, "sim.self_collision=neighbors"]));
        let (mut nearest, mut risen, mut before) = (f64::INFINITY, 0.0_f64, 0.0);
        for _ in 0..120 {
            simulation.advance_frame().unwrap();
            let (distance, entry) =
                (simulation.extremes().distance, simulation.ledger().unwrap().self_collision);
            nearest = nearest.min(distance);
            risen = risen.max(entry - before);
            before = entry;
        }
        // They keep 40 mm. What pairs bring each other too close by, some pushes make good, against the springs.
        assert!(before < -0.1 && risen < 1e-6, "{steps}: {before} J in all, {risen:e} J in a frame");
        assert!(nearest > 0.034, "{steps}: {nearest} m");
    }
}
