//! The energy ledger closes, has its known entries, and changes nothing.

#![expect(clippy::unwrap_used, reason = "a test may panic")]

use crate::scenes;
use drape::diagnostics::ledger::Ledger;
use drape::math::powi;
use drape::scene::{Scene, Vec3};
use drape::simulation::Simulation;

/// Every phase at once: a folded cloth that falls on a ball and on the floor.
fn everything() -> Scene {
    let mut scene = scenes::sphere();
    scenes::add_plane(&mut scene, scenes::floor());
    scenes::plane_mut(&mut scene).point.y = 0.35;
    let cloth = scene.cloth.as_mut().unwrap();
    (cloth.num_width_points, cloth.num_height_points, cloth.thickness) = (16, 16, 0.03);
    cloth.pinned = vec![[0, 0], [5, 7]];
    scene
}

fn recorded(scene: &Scene) -> Simulation {
    let mut simulation = Simulation::new(scene).unwrap();
    simulation.record_ledger().unwrap();
    simulation
}

/// The entries sum to the change of the energy but for 1e-13 of it per step.
#[test]
fn the_ledger_closes() {
    for (name, mut scene) in scenes::stock().into_iter().chain([("everything", everything())]) {
        let cloth = scene.cloth.as_mut().unwrap();
        if name != "everything" {
            (cloth.num_width_points, cloth.num_height_points, cloth.thickness) = (14, 14, 0.03);
            cloth.pinned.iter_mut().flatten().for_each(|i| *i = (*i).min(13));
        }
        let mut simulation = recorded(&scene);
        let start = simulation.energy();
        let mut used: Vec<f64> = Ledger::default().entries().map(|_| 0.0).collect();
        for frame in 1..=120_u32 {
            simulation.advance_frame().unwrap();
            let (now, ledger) = (simulation.energy(), simulation.ledger().unwrap());
            let error = (now.total() - start.total() - ledger.sum()).abs();
            let bound = 1e-13 * f64::from(30 * frame) * start.total().abs().max(now.kinetic);
            assert!(error <= bound, "{name}, frame {frame}: off by {error:e} J, bound {bound:e} J");
            ledger.entries().zip(&mut used).for_each(|((_, e), used)| *used += e.abs());
        }
        if name == "everything" {
            let unused = Ledger::default().entries().zip(&used).filter(|(_, used)| **used == 0.0);
            let unused: Vec<&str> = unused.map(|((name, _), _)| name).collect();
            assert_eq!(unused, ["boxes"], "every part takes part but that of boxes, of which there is none");
        }
    }
}

/// In free fall gravity's entry is `m g · d / 2` less, d the last displacement, and nothing else
/// has one but damping, which takes `(1 - keep) d0 · (d0 + d1) m / (2 dt²)` each step.
#[test]
fn free_fall_has_the_entries_of_its_closed_form() {
    let mut scene = scenes::with_cloth(scenes::cloth());
    let cloth = scene.cloth.as_mut().unwrap();
    (cloth.num_width_points, cloth.num_height_points, cloth.thickness) = (4, 3, 0.0);
    cloth.damping = 1.0;
    let mass = 150.0;
    let mut simulation = recorded(&scene);
    let h = 1.0 / 2700.0;
    let (mut before, mut drag) = (0.0, 0.0);
    for step in 1..=900 {
        simulation.step();
        let moved = 0.99 * before - 9.8 * h * h;
        drag -= 0.01 * before * (before + moved) * mass / (2.0 * h * h);
        before = moved;
        let ledger = simulation.ledger().unwrap();
        let gravity = mass * 9.8 * moved / 2.0;
        assert!(
            (ledger.gravity - gravity).abs() < 1e-9 * gravity.abs(),
            "step {step}: {ledger:?}, not {gravity}"
        );
        assert!(
            (ledger.damping - drag).abs() < 1e-9 * drag.abs() + 1e-12,
            "step {step}: {ledger:?}, not {drag}"
        );
        let rest = ledger.sum() - ledger.gravity - ledger.damping;
        assert!(rest.abs() < 1e-9, "step {step}: {ledger:?}");
    }
}

/// What the finite step makes the springs and gravity add goes to zero with the step.
#[test]
fn springs_and_gravity_exchange_energy_evenly_when_the_step_vanishes() {
    let largest = |steps_per_frame| {
        let mut scene = scenes::pinned2();
        scene.sim.stretch_limit = None;
        scene.sim.steps_per_frame = steps_per_frame;
        let cloth = scene.cloth.as_mut().unwrap();
        (cloth.num_width_points, cloth.num_height_points, cloth.thickness) = (6, 6, 0.0);
        (cloth.pinned, cloth.damping) = (vec![[0, 0], [5, 0]], 0.0);
        let mut simulation = recorded(&scene);
        let mut largest = 0.0_f64;
        for _ in 0..18 * steps_per_frame {
            simulation.step();
            largest = largest.max(simulation.ledger().unwrap().sum().abs());
        }
        largest
    };
    let [coarse, middle, fine] = [30, 60, 120].map(largest);
    for ratio in [coarse / middle, middle / fine] {
        assert!((ratio - 2.0).abs() < 0.1, "half the step divides the entries by {ratio}, not 2");
    }
}

/// With a ledger the cloth moves as without one, to the last bit, with the same work.
#[test]
fn a_ledger_changes_nothing() {
    let scene = everything();
    let (mut with, mut without) = (recorded(&scene), Simulation::new(&scene).unwrap());
    for frame in 0..60 {
        with.advance_frame().unwrap();
        without.advance_frame().unwrap();
        assert_eq!(with.state_hash(), without.state_hash(), "frame {frame}");
    }
    assert_eq!(with.counters(), without.counters());
    assert_eq!(without.ledger(), None, "nobody asked");
    assert!(with.ledger().unwrap().stretch_limit != 0.0, "the stretch limit took part");
}

#[test]
fn a_ledger_takes_memory_only_when_asked_for_and_a_frame_none() {
    let mut simulation = Simulation::new(&everything()).unwrap();
    let frames = |simulation: &mut Simulation| {
        allocation_counter::measure(|| (0..30).for_each(|_| simulation.advance_frame().unwrap())).count_total
    };
    simulation.advance_frame().unwrap();
    assert_eq!(frames(&mut simulation), 0, "frames without a ledger");
    let ledger = allocation_counter::measure(|| simulation.record_ledger().unwrap());
    assert_eq!(ledger.bytes_total, 3 * 8 * 256, "a vector a point");
    assert_eq!(frames(&mut simulation), 0, "frames with a ledger");
}

/// The extremes of a cloth at rest are those of its grid, and of a falling one its speed.
#[test]
fn extremes_have_their_known_values() {
    let mut scene = scenes::with_cloth(scenes::cloth());
    scene.sim.gravity = Vec3::new(0.0, -9.8, 0.0);
    let mut simulation = Simulation::new(&scene).unwrap();
    let start = simulation.extremes();
    assert_eq!((start.stretch, start.speed), (1.0, 0.0));
    assert!((start.distance - 1.0 / 49.0).abs() < 1e-15, "{start:?}");
    (0..10).for_each(|_| simulation.step());
    let terminal = (1.0 - powi(0.998, 10, 1.0)) / 0.002;
    let speed = 9.8 / 2700.0 * terminal;
    assert!((simulation.extremes().speed - speed).abs() < 1e-9, "{:?}", simulation.extremes());
}
