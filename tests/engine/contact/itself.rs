//! Contact of the cloth with itself under `coulomb`: pushing apart gives no speed, and approach is inelastic.

use drape::scene::{Overrides, Scene, load};
use drape::simulation::Simulation;

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

/// What lies on itself after 2 s is slower with shorter steps, not faster, and keeps its distance.
#[test]
fn a_cloth_that_falls_on_itself_loses_its_speed() {
    for steps in [30, 120] {
        let steps = format!("sim.steps_per_frame={steps}");
        let scene = falling(&[&steps, "sim.self_collision=neighbors"]);
        let mut simulation = Simulation::new(&scene).unwrap();
        simulation.record_ledger().unwrap();
        let (mut fastest, mut nearest, mut risen) = (0.0_f64, f64::INFINITY, 0.0_f64);
        let mut before = 0.0;
        for _ in 0..180 {
            simulation.advance_frame().unwrap();
            let (extremes, entry) = (simulation.extremes(), simulation.ledger().unwrap().self_collision);
            if simulation.frame() > 120 {
                fastest = fastest.max(extremes.speed);
            }
            nearest = nearest.min(extremes.distance);
            risen = risen.max(entry - before);
            before = entry;
        }
        println!("{steps}: {fastest} m/s, {nearest} m, {risen:e} J, {:?} {:?}", simulation.ledger(), simulation.energy());
        assert!(fastest < 0.8, "{steps}: {fastest} m/s");
        assert!(nearest > 0.01, "{steps}: {nearest} m");
        assert!(risen < 1e-3, "{steps}: {risen:e} J");
    }
}
