//! Momentum, energy, the ledger, the same bits again.

use drape::error::Kind;
use drape::scene::{Damping, Integrator, Precision, Scene, Vec3};
use drape::simulation::Simulation;

use super::{G, OTHERS, end, falling, hanging};
use crate::scenes;

/// Springs pull both ends alike, so only gravity changes the momentum: by `M g h` a step.
#[test]
fn only_gravity_changes_the_momentum() {
    for integrator in [Integrator::Verlet, Integrator::Xpbd, Integrator::ImplicitEuler] {
        let mut scene = falling(integrator);
        scene.sim.tolerance = 1e-13;
        let mut simulation = Simulation::new(&scene).unwrap();
        let mut x = simulation.positions().clone();
        (0..16).for_each(|p| x.set(p, x.get(p) * (1.0 + 0.05 * (p % 3) as f64)));
        simulation.set_state(x.clone(), x).unwrap();
        for step in 1..=300 {
            simulation.step();
            let (x, last) = (simulation.positions(), simulation.last_positions());
            let total = (0..16).map(|p| x.get(p) - last.get(p)).sum::<Vec3>() * 2700.0 / 16.0;
            let expected = Vec3::new(0.0, -G * f64::from(step) / 2700.0, 0.0);
            assert!((total - expected).norm() < 1e-9, "{integrator:?}, step {step}: {total:?}");
        }
    }
}

#[test]
fn implicit_euler_only_takes_energy() {
    for steps in [1, 4, 30] {
        let mut scene = hanging(10, Integrator::ImplicitEuler);
        (scene.sim.steps_per_frame, scene.sim.tolerance) = (steps, 1e-10);
        let mut simulation = Simulation::new(&scene).unwrap();
        let mut before = simulation.energy().total();
        for step in 0..90 * steps.min(10) {
            simulation.step();
            let now = simulation.energy().total();
            assert!(now <= before + 1e-8, "{steps} steps a frame, step {step}: {} J more", now - before);
            before = now;
        }
    }
}

/// An implicit step is solved to the scene's tolerance, or counted: 1e-16 is finer than rounding leaves.
#[test]
fn steps_that_are_not_solved_are_counted() {
    for integrator in [Integrator::ImplicitEuler, Integrator::Bdf2] {
        for (tolerance, unsolved) in [(1e-3, 0), (1e-9, 0), (1e-16, 30)] {
            let mut scene = hanging(10, integrator);
            (scene.sim.steps_per_frame, scene.sim.tolerance) = (1, tolerance);
            let mut simulation = Simulation::new(&scene).unwrap();
            (0..30).for_each(|_| simulation.step());
            assert_eq!(simulation.counters().unsolved_steps, unsolved, "{integrator:?} to {tolerance:e}");
        }
    }
}

/// Visits of the springs are counted, and stay few: the preconditioner and the place where Newton's method starts save
/// them without changing the solution, so that nothing else would notice if they were lost.
#[test]
fn implicit_steps_visit_the_springs_seldom() {
    let visits = |integrator, ks, steps| {
        let mut scene = hanging(24, integrator);
        scene.cloth.as_mut().unwrap().ks = ks;
        scene.sim.steps_per_frame = steps;
        let springs: usize = drape::cloth::springs::counts(scene.cloth.as_ref().unwrap()).iter().sum();
        let counters = end(&scene, 10, steps).counters();
        assert_eq!(counters.unsolved_steps, 0, "{integrator:?}, ks {ks:e}, {steps} steps a frame");
        counters.springs_evaluated / springs as u64 / counters.steps
    };
    let found = [
        visits(Integrator::ImplicitEuler, 5e3, 1),
        visits(Integrator::ImplicitEuler, 5e6, 1),
        visits(Integrator::ImplicitEuler, 5e6, 30),
        visits(Integrator::Bdf2, 5e3, 1),
        visits(Integrator::Bdf2, 5e6, 1),
        visits(Integrator::Bdf2, 5e6, 30),
    ];
    let most = [25, 320, 26, 20, 210, 21];
    assert!(found.iter().zip(most).all(|(found, most)| *found <= most), "{found:?}, at most {most:?}");
}

/// A state that is set is all that the next step knows: BDF2 forgets the velocities before it.
#[test]
fn a_state_that_is_set_leaves_no_memory() {
    for integrator in super::ALL {
        let scene = hanging(10, integrator);
        let mut moved = Simulation::new(&scene).unwrap();
        (0..50).for_each(|_| moved.step());
        let mut fresh = Simulation::new(&scene).unwrap();
        let x = moved.positions().clone();
        for simulation in [&mut moved, &mut fresh] {
            simulation.set_state(x.clone(), x.clone()).unwrap();
            (0..5).for_each(|_| simulation.step());
        }
        assert_eq!(moved.state_hash(), fresh.state_hash(), "{integrator:?}");
    }
}

/// The integrators that are called stable for every step are, and one that gains energy is stopped.
#[test]
fn what_gains_energy_is_stopped() {
    let fails = |integrator| {
        let mut scene = hanging(50, integrator);
        (scene.sim.fps, scene.sim.steps_per_frame) = (60.0, 1);
        let mut simulation = Simulation::new(&scene).unwrap();
        (0..30).find_map(|_| simulation.advance_frame().err()).map(|error| error.kind)
    };
    assert_eq!(fails(Integrator::Verlet), Some(Kind::Unstable));
    assert_eq!(fails(Integrator::Xpbd), Some(Kind::Unstable), "one pass is too few");
    assert_eq!(fails(Integrator::ImplicitEuler), None);
    assert_eq!(fails(Integrator::Bdf2), None);
}

#[test]
fn no_stock_scene_is_refused() {
    std::thread::scope(|scope| {
        for integrator in OTHERS {
            scope.spawn(move || {
                for (name, mut scene) in scenes::stock() {
                    let steps = if integrator == Integrator::Xpbd { 30 } else { 5 };
                    (scene.sim.integrator, scene.sim.steps_per_frame) = (integrator, steps);
                    let cloth = scene.cloth.as_mut().unwrap();
                    (cloth.num_width_points, cloth.num_height_points, cloth.thickness) = (20, 20, 0.024);
                    cloth.pinned.iter_mut().flatten().for_each(|i| *i = (*i).min(19));
                    let mut simulation = Simulation::new(&scene).unwrap();
                    for frame in 0..120 {
                        let result = simulation.advance_frame();
                        assert!(result.is_ok(), "{name} {integrator:?} {frame}: {}", result.unwrap_err());
                    }
                }
            });
        }
    });
}

/// Every phase at once: a cloth that falls on a ball and on the floor.
fn everything(integrator: Integrator) -> Scene {
    let mut scene = scenes::sphere();
    scenes::add_plane(&mut scene, scenes::floor());
    scenes::plane_mut(&mut scene).point.y = 0.35;
    scene.sim.integrator = integrator;
    let cloth = scene.cloth.as_mut().unwrap();
    (cloth.num_width_points, cloth.num_height_points, cloth.thickness) = (16, 16, 0.03);
    cloth.pinned = vec![[0, 0], [5, 7]];
    scene
}

fn everything_single() -> Scene {
    let mut scene = everything(Integrator::Verlet);
    scene.sim.precision = Precision::F32;
    scene
}

#[test]
fn the_ledger_closes_and_damping_takes_energy() {
    for damping in [Damping::PerStep, Damping::PerSecond] {
        for mut scene in OTHERS.map(everything).into_iter().chain([everything_single()]) {
            scene.sim.damping = damping;
            let mut simulation = Simulation::new(&scene).unwrap();
            simulation.record_ledger().unwrap();
            let start = simulation.energy();
            for frame in 1..=90_u32 {
                simulation.advance_frame().unwrap();
                let (now, ledger) = (simulation.energy(), simulation.ledger().unwrap());
                let error = (now.total() - start.total() - ledger.sum()).abs();
                let bound = 1e-13 * f64::from(30 * frame) * start.total().abs().max(now.kinetic);
                let name = (scene.sim.integrator, damping, frame);
                assert!(error <= bound, "{name:?}: off by {error:e} J of {bound:e} J");
            }
            let ledger = simulation.ledger().unwrap();
            assert!(ledger.damping < -10.0, "{:?}: {ledger:?}", scene.sim.integrator);
            for (part, entry) in ledger.entries() {
                assert!((entry != 0.0) == (part != "boxes"), "{:?}: {part}: {entry}", scene.sim.integrator);
            }
        }
    }
}

#[test]
fn runs_repeat_and_a_step_allocates_nothing() {
    for scene in OTHERS.map(everything).into_iter().chain([everything_single()]) {
        let name = (scene.sim.integrator, scene.sim.precision);
        let [mut one, mut two] = [(); 2].map(|()| Simulation::new(&scene).unwrap());
        one.step();
        let allocations = allocation_counter::measure(|| (0..899).for_each(|_| one.step()));
        assert_eq!(allocations.count_total, 0, "{name:?}");
        (0..30).for_each(|_| two.advance_frame().unwrap());
        assert_eq!(one.state_hash(), two.state_hash(), "{name:?}");
        assert_eq!(one.counters(), two.counters(), "{name:?}");
    }
}
