//! One spring, whose discrete solution is known, and a pulse along a chain of them.

use drape::math::{atan2, cos, powi, sin};
use drape::scene::Vec3;
use drape::simulation::Simulation;

use super::{cloth, distance, mass_of, springs_only, step_of};

/// Two points on springs along x, pulled from where the springs are slack to a balance `pull`
/// metres away: the distance from there after each step, in metres, with `mu2` = (dt ω)².
fn oscillator(pull: f64, mu2: f64, damping: f64, steps: usize) -> Vec<f64> {
    let mut scene = springs_only(2, 2);
    let h = step_of(&scene);
    scene.sim.gravity = Vec3::new(pull * mu2 / (h * h), 0.0, 0.0);
    let ks = mu2 * mass_of(&scene) / (h * h);
    let cloth = cloth(&mut scene);
    (cloth.ks, cloth.damping) = (ks, damping);
    (cloth.enable_shearing, cloth.enable_bending) = (false, false);
    cloth.pinned = vec![[0, 0], [0, 1]];
    let balance = 1.0 + pull;
    let mut simulation = Simulation::new(&scene).unwrap();
    let mut found = vec![simulation.positions().x[1] - balance];
    for _ in 0..steps {
        simulation.step();
        found.push(simulation.positions().x[1] - balance);
    }
    found
}

#[test]
fn one_spring_swings_as_the_discrete_solution_says() {
    for mu2 in [0.01, 0.4, 1.0, 3.5] {
        let found = oscillator(0.1, mu2, 0.0, 2000);
        let cosine = 1.0 - mu2 / 2.0;
        let theta = atan2((1.0 - cosine * cosine).sqrt(), cosine);
        for (k, u) in found.iter().enumerate() {
            let expected = found[0] * cos((k as f64 + 0.5) * theta) / cos(theta / 2.0);
            let error = (u - expected).abs() / found[0].abs();
            assert!(error < 1e-10, "(dt ω)² = {mu2}, step {k}: off by {error:e} of the start");
        }
    }
}

#[test]
fn one_spring_keeps_verlets_invariant() {
    for mu2 in [0.01, 0.4, 1.0, 3.5] {
        let found = oscillator(0.1, mu2, 0.0, 2000);
        // Twice the invariant over the mass, times h².
        let invariant = |pair: &[f64]| (pair[1] - pair[0]) * (pair[1] - pair[0]) + mu2 * pair[0] * pair[1];
        // One step before the start the points were where they started.
        let start = mu2 * found[0] * found[0];
        for (k, pair) in found.windows(2).enumerate() {
            let error = (invariant(pair) - start).abs() / start;
            assert!(error < 1e-11, "(dt ω)² = {mu2}, step {k}: off by {error:e}");
        }
    }
}

#[test]
fn a_damped_spring_decays_as_the_discrete_solution_says() {
    for (mu2, percent) in [(0.01, 0.2), (0.4, 5.0), (1.0, 20.0)] {
        let q = 1.0 - percent / 100.0;
        let found = oscillator(0.1, mu2, percent, 400);
        let cosine = (1.0 + q - mu2) / (2.0 * q.sqrt());
        let sine = (1.0 - cosine * cosine).sqrt();
        let theta = atan2(sine, cosine);
        let b = (cosine - q.sqrt()) / sine;
        for (k, u) in found.iter().enumerate() {
            let angle = k as f64 * theta;
            let decay = powi(q.sqrt(), k as u32, 1.0);
            let expected = found[0] * decay * (cos(angle) + b * sin(angle));
            let error = (u - expected).abs() / found[0].abs();
            assert!(error < 1e-12, "(dt ω)² = {mu2}, {percent} %, step {k}: off by {error:e} of the start");
        }
    }
}

#[test]
fn one_spring_is_stable_exactly_below_the_limit() {
    for percent in [0.0, 0.2, 50.0, 90.0] {
        let limit = 4.0 - 2.0 * percent / 100.0;
        let largest = |mu2: f64| {
            let found = oscillator(1e-3, mu2, percent, 3000);
            found.iter().map(|u| (u / found[0]).abs()).fold(0.0, f64::max)
        };
        assert!(largest(limit - 0.02) < 20.0, "{percent} %: grew below the limit");
        assert!(largest(limit + 0.02) > 500.0, "{percent} %: did not grow above the limit");
    }
}

#[test]
fn at_the_magic_step_a_pulse_moves_one_point_a_step() {
    let mut scene = springs_only(60, 2);
    let h = step_of(&scene);
    let ks = mass_of(&scene) / (h * h);
    let cloth = cloth(&mut scene);
    (cloth.ks, cloth.enable_shearing, cloth.enable_bending) = (ks, false, false);
    let pulse = |i: f64| if (10.0..14.0).contains(&i) { 1e-3 * (i - 9.0) } else { 0.0 };
    let mut simulation = Simulation::new(&scene).unwrap();
    let start = simulation.positions().clone();
    let moved = |steps: f64| {
        let mut x = start.clone();
        (0..x.len()).for_each(|p| x.x[p] += pulse((p % 60) as f64 - steps));
        x
    };
    simulation.set_state(moved(0.0), moved(-1.0)).unwrap();
    for k in 1..=40 {
        simulation.step();
        let error = distance(simulation.positions(), &moved(f64::from(k)));
        assert!(error < 1e-13, "step {k}: off by {error:e} m");
    }
}
