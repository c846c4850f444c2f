//! The Runge-Kutta method: its order, its bound, its four evaluations, its memory.

use drape::diagnostics::stability::Stability;
use drape::integrator::step_bound;
use drape::math::ln;
use drape::scene::{Damping, Integrator, Scene, Vec3};
use drape::simulation::Simulation;

use super::exact::one_spring;
use super::{end, hanging, rms};

/// Halving the step divides the change by 16: without damping, and with damping per second.
#[test]
fn it_is_fourth_order() {
    for damping in [0.0, 0.2] {
        let mut scene = hanging(8, Integrator::Rk4);
        scene.sim.damping = Damping::PerSecond;
        scene.cloth.as_mut().unwrap().damping = damping;
        let runs = [4, 8, 16, 32].map(|steps| end(&scene, 18, steps));
        let changes: Vec<f64> =
            runs.windows(2).map(|pair| rms(pair[0].positions(), pair[1].positions())).collect();
        for pair in changes.windows(2) {
            let order = ln(pair[0] / pair[1]) / ln(2.0);
            assert!((order - 4.0).abs() < 0.15, "damping {damping}: order {order}, {changes:?}");
        }
    }
}

/// It ends where Verlet's scheme does, with far larger steps.
#[test]
fn it_solves_the_same_equations() {
    let mut best = hanging(8, Integrator::Verlet);
    best.sim.start = drape::scene::Start::HalfStep;
    let reference = end(&best, 18, 960);
    let found = end(&hanging(8, Integrator::Rk4), 18, 16);
    let error = rms(found.positions(), reference.positions());
    assert!(error < 1e-7, "{error:e} m");
}

#[test]
fn a_step_evaluates_every_spring_four_times() {
    let mut simulation = Simulation::new(&hanging(50, Integrator::Rk4)).unwrap();
    (0..10).for_each(|_| simulation.step());
    let counters = simulation.counters();
    assert_eq!((counters.springs_evaluated, counters.points_advanced), (4 * 10 * 14_502, 10 * 2498));
}

/// Whether one spring of dt ω = `mu`, moved out of its rest length, swings wider and wider.
fn grows(integrator: Integrator, mu: f64, change: impl Fn(&mut Scene)) -> bool {
    let mut scene = one_spring(integrator, (mu * 2700.0) * (mu * 2700.0));
    change(&mut scene);
    let mut simulation = Simulation::new(&scene).unwrap();
    let mut x = simulation.positions().clone();
    x.set(3, x.get(3) * (1.0 + 1e-6));
    simulation.set_state(x.clone(), x).unwrap();
    let start = simulation.energy().total();
    (0..4000).any(|_| {
        simulation.step();
        let energy = simulation.energy().total();
        energy.is_nan() || energy > 1e3 * start
    })
}

/// One spring is stable below the bound and grows above it, in both ways of damping.
#[test]
fn one_spring_is_stable_exactly_below_the_bound() {
    for (damping, percent) in [(Damping::PerStep, 0.0), (Damping::PerStep, 20.0), (Damping::PerSecond, 5.0)] {
        let change = |scene: &mut Scene| {
            scene.sim.damping = damping;
            scene.cloth.as_mut().unwrap().damping = percent;
        };
        let mut scene = one_spring(Integrator::Rk4, 1.0);
        change(&mut scene);
        let bound = step_bound(scene.cloth.as_ref().unwrap(), &scene.sim, 1.0 / 2700.0).unwrap().at_rest;
        assert!(!grows(Integrator::Rk4, 0.999 * bound, change), "{damping:?} {percent} %: below {bound}");
        assert!(grows(Integrator::Rk4, 1.001 * bound, change), "{damping:?} {percent} %: above {bound}");
    }
}

/// An integrator that claims to have no bound is stable at a step 15 times the bound of Verlet's scheme.
#[test]
fn what_has_no_bound_stands_every_step() {
    for &(name, integrator) in Integrator::NAMES {
        let scene = one_spring(integrator, 1.0);
        let bound = step_bound(scene.cloth.as_ref().unwrap(), &scene.sim, 1.0 / 2700.0);
        assert_eq!(bound.is_none(), !grows(integrator, 30.0, |_| ()), "{name}: {bound:?}");
    }
}

/// The stability check sees it, and its number of steps agrees with its own bound.
#[test]
fn the_stability_check_knows_its_bound() {
    for (damping, percent) in [
        (Damping::PerStep, 0.0),
        (Damping::PerStep, 0.2),
        (Damping::PerSecond, 0.2),
        // The drag alone is too much for fewer than 4465 steps a second.
        (Damping::PerSecond, 99.0),
    ] {
        let mut scene = hanging(16, Integrator::Rk4);
        scene.sim.damping = damping;
        scene.cloth.as_mut().unwrap().damping = percent;
        let stability = |steps: u32| {
            let mut scene = scene.clone();
            scene.sim.steps_per_frame = steps;
            Stability::of_bounded(scene.cloth.as_ref().unwrap(), &scene.sim).unwrap().expect("a bound")
        };
        let steps = stability(30).fewest_steps_worst();
        assert_eq!(steps, stability(1).fewest_steps_worst(), "{damping:?}: from any number of steps");
        assert!(stability(steps as u32).is_always_stable(), "{damping:?} {percent} %: {steps} steps");
        assert!(
            !stability(steps as u32 - 1).is_always_stable(),
            "{damping:?} {percent} %: {steps} - 1 steps"
        );
    }
    let verlet = Stability::new(
        hanging(16, Integrator::Verlet).cloth.as_ref().unwrap(),
        &hanging(16, Integrator::Verlet).sim,
    );
    assert!(verlet.unwrap().limit_worst < 2.0);
}

/// A point that moved after the step takes its velocity from its positions, and the others remember theirs.
#[test]
fn a_corrected_point_starts_anew() {
    let scene = {
        let mut scene = hanging(4, Integrator::Rk4);
        scene.cloth.as_mut().unwrap().pinned.clear();
        scene.sim.gravity = Vec3::new(0.0, -1.0, 0.0);
        scene
    };
    let (h, mut simulation) = (1.0 / 2700.0_f64, Simulation::new(&scene).unwrap());
    (0..3).for_each(|_| simulation.step());
    let fall = simulation.positions().get(0).y - 1.0;
    assert!((fall + 0.5 * 9.0 * h * h).abs() < 1e-15, "remembered velocities fall exactly: {fall:e}");
    let (x, last) = (simulation.positions().clone(), simulation.last_positions().clone());
    simulation.set_state(x.clone(), last.clone()).unwrap();
    simulation.step();
    let mean = (x.get(0).y - last.get(0).y) / h;
    let expected = x.get(0).y + mean * h - 0.5 * h * h;
    assert!((simulation.positions().get(0).y - expected).abs() < 1e-15, "the mean velocity of the last step");
}
