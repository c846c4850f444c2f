//! Momentum, energy, time reversal, pins.

use drape::math::powi;
use drape::scene::Vec3;
use drape::simulation::Simulation;

use super::{G, cloth, distance, mass_of, path, run, springs_only, step_of, stirred, sum};

#[test]
fn momentum_follows_its_exact_law() {
    for (percent, limit) in [(0.0, None), (0.0, Some(0.1)), (0.2, None), (0.2, Some(0.1))] {
        let mut scene = springs_only(7, 5);
        scene.sim.stretch_limit = limit;
        cloth(&mut scene).damping = percent;
        let mut simulation = stirred(&scene, 3.0);
        let momentum = |simulation: &Simulation| sum(simulation, |x, last| x - last);
        let (start, scale) = (momentum(&simulation), path(&simulation));
        for k in 1..=2000 {
            simulation.step();
            let expected = start * powi(1.0 - percent / 100.0, k, 1.0);
            let error = (momentum(&simulation) - expected).norm() / scale;
            assert!(error < 1e-11, "{percent} %, {limit:?}, step {k}: off by {error:e}");
        }
        let limited = simulation.counters().springs_limited;
        assert_eq!(limited > 0, limit.is_some(), "the limit acts where there is one: {limited} times");
    }
}

#[test]
fn weight_adds_the_same_momentum_in_every_step() {
    let mut scene = springs_only(6, 6);
    scene.sim.gravity = Vec3::new(1.0, -G, 2.0);
    let mut simulation = stirred(&scene, 3.0);
    let (h, points) = (step_of(&scene), 36.0);
    let mut before = sum(&simulation, |x, last| x - last);
    for k in 0..500 {
        simulation.step();
        let after = sum(&simulation, |x, last| x - last);
        let error = (after - before - scene.sim.gravity * (h * h * points)).norm();
        assert!(error < 1e-13, "step {k}: off by {error:e} m");
        before = after;
    }
}

#[test]
fn angular_momentum_stays_without_the_stretch_limit() {
    let mut simulation = stirred(&springs_only(6, 7), 3.0);
    let angular = |simulation: &Simulation| sum(simulation, |x, last| last.cross(&x));
    let (start, scale) = (angular(&simulation), path(&simulation));
    for k in 1..=2000 {
        simulation.step();
        let error = (angular(&simulation) - start).norm() / scale;
        assert!(error < 1e-11, "step {k}: off by {error:e}");
    }
}

/// Largest deviation of the energy from its start, relative to it, over a fifth of a second at a
/// given number of steps per frame. The velocity at a position is taken from the positions
/// before and after it.
fn energy_deviation(steps_per_frame: u32) -> f64 {
    let mut scene = springs_only(6, 6);
    scene.sim.steps_per_frame = steps_per_frame;
    let (h, m) = (step_of(&scene), mass_of(&scene));
    let mut simulation = stirred(&scene, 0.5);
    let mut start = None;
    let mut largest = 0.0_f64;
    for _ in 0..18 * steps_per_frame {
        let before = simulation.last_positions().clone();
        let spring = simulation.energy().spring;
        simulation.step();
        let after = simulation.positions();
        let velocity = |p| (after.get(p) - before.get(p)) / (2.0 * h);
        let kinetic: f64 = (0..after.len()).map(|p| 0.5 * m * velocity(p).norm_squared()).sum();
        let start = *start.get_or_insert(kinetic + spring);
        largest = largest.max((kinetic + spring - start).abs() / start);
    }
    largest
}

#[test]
fn energy_errs_by_the_square_of_the_step() {
    let [coarse, middle, fine] = [30, 60, 120].map(energy_deviation);
    assert!(coarse < 1e-2, "energy off by {coarse:e}");
    for ratio in [coarse / middle, middle / fine] {
        assert!((ratio - 4.0).abs() < 0.1, "halving the step divides the error by {ratio}, not 4");
    }
}

#[test]
fn a_damped_hanging_cloth_never_gains_energy() {
    for limit in [None, Some(0.1)] {
        let mut scene = springs_only(12, 12);
        scene.sim.gravity = Vec3::new(0.0, -G, 0.0);
        scene.sim.stretch_limit = limit;
        (cloth(&mut scene).damping, cloth(&mut scene).pinned) = (0.2, vec![[0, 0], [11, 0]]);
        let mut simulation = Simulation::new(&scene).unwrap();
        let start = simulation.energy().total();
        for step in 1..=2700 {
            simulation.step();
            let energy = simulation.energy().total();
            assert!(energy <= start * (1.0 + 1e-9), "{limit:?}, step {step}: {energy} J of {start} J");
        }
        let lost = start - simulation.energy().total();
        assert!(lost > 0.1 * start, "the cloth came down: {lost} J of {start} J lost");
    }
}

#[test]
fn time_runs_backwards_without_damping_and_contact() {
    let scene = springs_only(8, 8);
    let mut simulation = stirred(&scene, 1.0);
    let (start, before) = (simulation.positions().clone(), simulation.last_positions().clone());
    run(&mut simulation, 300);
    let (x, last) = (simulation.positions().clone(), simulation.last_positions().clone());
    assert!(distance(&x, &start) > 1e-3, "the cloth moved");
    simulation.set_state(last, x).unwrap();
    run(&mut simulation, 300);
    let error = distance(simulation.positions(), &before).max(distance(simulation.last_positions(), &start));
    assert!(error < 1e-12, "back at the start but for {error:e} m");
}
