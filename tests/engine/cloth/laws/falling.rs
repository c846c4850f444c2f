//! What has weight: free fall, a hanging chain.

use drape::math::powi;
use drape::scene::Vec3;
use drape::simulation::Simulation;

use super::{G, cloth, mass_of, run, springs_only, step_of};

#[test]
fn free_fall_has_its_closed_form_and_its_first_order_error() {
    let mut scene = springs_only(4, 3);
    scene.sim.gravity = Vec3::new(0.0, -G, 0.0);
    let h = step_of(&scene);
    let mut simulation = Simulation::new(&scene).unwrap();
    for k in 1..=600 {
        simulation.step();
        let (k, t) = (f64::from(k), simulation.time());
        let drop = G * h * h * k * (k + 1.0) / 2.0;
        for &y in &simulation.positions().y {
            assert!((1.0 - y - drop).abs() < 1e-10 * drop, "step {k}: fell {} instead of {drop}", 1.0 - y);
            let error = (1.0 - y) - G * t * t / 2.0;
            assert!((error - G * h * t / 2.0).abs() < 1e-10, "step {k}: off by {error}");
        }
        let (energy, mass) = (simulation.energy(), 12.0 * mass_of(&scene));
        let kinetic = mass * (G * h * k) * (G * h * k) / 2.0;
        assert!((energy.kinetic - kinetic).abs() < 1e-8 * kinetic, "step {k}: {energy:?}");
        assert!((energy.gravitational - mass * G * (1.0 - drop)).abs() < 1e-7, "step {k}: {energy:?}");
        assert!(energy.spring < 1e-9, "step {k}: {energy:?}");
    }
}

#[test]
fn damped_free_fall_has_its_closed_form_and_terminal_speed() {
    let mut scene = springs_only(3, 2);
    scene.sim.gravity = Vec3::new(0.0, -G, 0.0);
    cloth(&mut scene).damping = 0.2;
    let (h, d) = (step_of(&scene), 0.002);
    let q = 1.0 - d;
    let mut simulation = Simulation::new(&scene).unwrap();
    for k in 1..=6000_u32 {
        simulation.step();
        let drop = G * h * h / d * (f64::from(k) - q * (1.0 - powi(q, k, 1.0)) / d);
        let fell = 1.0 - simulation.positions().y[0];
        assert!((fell - drop).abs() < 1e-9 * drop.max(1e-6), "step {k}: fell {fell} instead of {drop}");
    }
    let speed = (simulation.last_positions().y[0] - simulation.positions().y[0]) / h;
    assert!((speed - 1.814_8).abs() < 1e-4, "terminal speed {speed} m/s");
}

#[test]
fn a_hanging_chain_stretches_as_its_weights_say() {
    let mut scene = springs_only(2, 8);
    scene.sim.gravity = Vec3::new(0.0, 0.0, G);
    let weight = mass_of(&scene) * G;
    let cloth = cloth(&mut scene);
    (cloth.enable_shearing, cloth.enable_bending) = (false, false);
    cloth.pinned = vec![[0, 0], [1, 0]];
    cloth.damping = 0.35;
    let (ks, links) = (cloth.ks, 7);
    let mut simulation = Simulation::new(&scene).unwrap();
    run(&mut simulation, 25_000);
    let mut expected = 0.0;
    for j in 1..=links {
        expected += 1.0 / 7.0 + f64::from(links - j + 1) * weight / ks;
        let found = simulation.positions().z[2 * j as usize];
        assert!((found - expected).abs() < 1e-10, "link {j} ends at {found}, not {expected}");
    }
}
