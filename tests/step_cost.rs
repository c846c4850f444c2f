//! A step does only what the scene requires, and a simulation fails with an error, never a panic.

#![expect(clippy::unwrap_used, reason = "a test may panic")]

#[path = "support/scenes/mod.rs"]
mod scenes;

use drape::cloth::{Counters, Points};
use drape::error::Kind;
use drape::scene::{Scene, SelfCollision};
use drape::simulation::Simulation;

/// What `frames` frames of `scene` cost.
fn cost(scene: &Scene, frames: usize) -> Counters {
    let mut simulation = Simulation::new(scene).unwrap();
    (0..frames).for_each(|_| simulation.advance_frame().unwrap());
    simulation.counters()
}

/// The sphere scene with a floor, in which every phase has something to do.
fn everything() -> Scene {
    let mut scene = scenes::sphere();
    scenes::add_plane(&mut scene, scenes::floor());
    scene
}

#[test]
fn the_stock_cloth_has_its_14502_springs() {
    for (structural, shearing, bending, springs) in [
        (true, true, true, 14_502),
        (true, false, false, 4900),
        (false, true, false, 4802),
        (false, false, true, 4800),
    ] {
        let mut scene = scenes::pinned2();
        let cloth = scene.cloth.as_mut().unwrap();
        (cloth.enable_structural, cloth.enable_shearing, cloth.enable_bending) =
            (structural, shearing, bending);
        let counters = cost(&scene, 1);
        assert_eq!(counters.springs_evaluated, 30 * springs, "{structural} {shearing} {bending}");
        assert_eq!(counters.points_advanced, 30 * 2498, "two of 2500 points are pinned");
    }
}

#[test]
fn every_phase_counts_what_it_does() {
    let counters = cost(&everything(), 60);
    assert_eq!(counters.steps, 1800);
    assert_eq!(counters.object_tests, 1800 * 2500 * 2);
    for count in [
        counters.boxes_searched,
        counters.pairs_tested,
        counters.self_collision_moves,
        counters.object_moves,
        counters.springs_checked,
        counters.springs_limited,
    ] {
        assert!(count > 0, "{counters:?}");
    }
}

#[test]
fn what_a_scene_does_without_costs_nothing() {
    let mut scene = everything();
    scene.sim.self_collision = SelfCollision::Off;
    let counters = cost(&scene, 2);
    assert_eq!((counters.boxes_searched, counters.pairs_tested), (0, 0), "self-collision is off");

    let mut scene = everything();
    scene.cloth.as_mut().unwrap().thickness = 0.0;
    let counters = cost(&scene, 2);
    assert_eq!((counters.boxes_searched, counters.pairs_tested), (0, 0), "no thickness");

    let mut scene = everything();
    scene.sim.stretch_limit = None;
    let counters = cost(&scene, 2);
    assert_eq!((counters.springs_checked, counters.springs_limited), (0, 0), "no limit");

    assert_eq!(cost(&scenes::pinned2(), 2).object_tests, 0, "no objects");

    let mut scene = everything();
    let cloth = scene.cloth.as_mut().unwrap();
    (cloth.enable_structural, cloth.enable_shearing, cloth.enable_bending) = (false, false, false);
    let counters = cost(&scene, 2);
    assert_eq!((counters.springs_evaluated, counters.springs_checked), (0, 0), "no springs");
}

#[test]
fn absent_phases_take_no_memory() {
    let bytes = |scene: &Scene| {
        allocation_counter::measure(|| drop(Simulation::new(scene).unwrap())).bytes_max / (2500 * 8)
    };
    let all = bytes(&everything());

    let mut scene = everything();
    scene.sim.self_collision = SelfCollision::Off;
    let saved = all - bytes(&scene);
    assert!(saved >= 10, "without self-collision {saved} arrays less");

    let mut scene = everything();
    scene.sim.stretch_limit = None;
    let saved = all - bytes(&scene);
    assert!(saved >= 6, "without the stretch limit {saved} arrays less");

    let mut scene = everything();
    scene.cloth.as_mut().unwrap().enable_bending = false;
    let saved = all - bytes(&scene);
    assert!(saved >= 4, "without bending springs {saved} arrays less");
}

/// So 2048 x 2048 points fit in 2 GiB.
#[test]
fn a_point_of_a_large_cloth_takes_less_than_512_bytes() {
    let mut scene = scenes::self_collision();
    let cloth = scene.cloth.as_mut().unwrap();
    (cloth.num_width_points, cloth.num_height_points, cloth.thickness) = (256, 256, 0.0018);
    let memory = allocation_counter::measure(|| Simulation::new(&scene).unwrap().step());
    let bytes = memory.bytes_max / (256 * 256);
    assert!(bytes < 512, "{bytes} bytes a point");
}

#[test]
fn a_step_allocates_nothing() {
    for (name, scene) in scenes::stock().into_iter().chain([("everything", everything())]) {
        let mut simulation = Simulation::new(&scene).unwrap();
        simulation.step();
        let allocations = allocation_counter::measure(|| (0..1500).for_each(|_| simulation.step()));
        assert_eq!(allocations.count_total, 0, "{name}");
    }
}

/// What watches a step changes no bit of it, and takes no memory in it.
#[test]
fn observers_change_nothing() {
    for scene in [everything(), scenes::self_collision()] {
        let run = |watch: &dyn Fn(&mut Simulation)| {
            let mut simulation = Simulation::new(&scene).unwrap();
            watch(&mut simulation);
            // The first step of a process starts its threads.
            simulation.step();
            let allocations = allocation_counter::measure(|| (0..1799).for_each(|_| simulation.step()));
            assert_eq!(allocations.count_total, 0);
            (simulation.state_hash(), simulation.counters())
        };
        let plain = run(&|_| ());
        assert_eq!(run(&Simulation::record_timings), plain, "with times");
        assert_eq!(run(&|simulation| simulation.record_ledger().unwrap()), plain, "with a ledger");
    }
}

#[test]
fn a_scene_without_cloth_only_keeps_time() {
    let mut scene = everything();
    scene.cloth = None;
    let mut simulation = Simulation::new(&scene).unwrap();
    (0..3).for_each(|_| simulation.advance_frame().unwrap());
    assert_eq!((simulation.frame(), simulation.steps()), (3, 90));
    assert!((simulation.time() - 3.0 / 90.0).abs() < 1e-15);
    assert!(simulation.positions().is_empty(), "no points");
    assert_eq!(simulation.counters(), Counters { steps: 90, ..Counters::default() });
}

#[test]
fn phases_are_timed_only_when_asked() {
    let mut simulation = Simulation::new(&everything()).unwrap();
    simulation.step();
    assert_eq!(simulation.timings(), None, "nobody asked");
    simulation.record_timings();
    (0..10).for_each(|_| simulation.step());
    let t = simulation.timings().unwrap();
    assert_eq!(t.verlet, 0, "forces and Verlet's scheme are one sweep");
    for (number, ns) in [t.forces, t.self_collision, t.objects, t.stretch_limit].iter().enumerate() {
        assert!(*ns > 0, "phase {number} of those that are timed");
    }
    simulation.record_ledger().unwrap();
    (0..10).for_each(|_| simulation.step());
    assert!(simulation.timings().unwrap().verlet > 0, "the ledger needs the forces, in a phase of their own");
}

#[test]
fn a_blow_up_is_an_error_that_names_step_point_and_frame() {
    let mut scene = scenes::pinned2();
    scene.sim.stretch_limit = None;
    scene.sim.steps_per_frame = 2;
    scene.cloth.as_mut().unwrap().density = 1e-3;
    let mut simulation = Simulation::new(&scene).unwrap();
    let error = (0..100_000).find_map(|_| simulation.advance_frame().err()).expect("it blows up");
    assert_eq!(error.kind, Kind::Unstable);
    let last_good = simulation.frame() - 1;
    let in_frame = [1, 2].map(|step| format!("at step {};", 2 * last_good + step));
    assert!(in_frame.iter().any(|step| error.message.contains(step)), "{error}");
    let place = format!("; last good frame: {last_good}");
    for part in [&place, "point (", "spring between point (", "most energy came from springs"] {
        assert!(error.message.contains(part), "{part}: {error}");
    }
}

#[test]
fn impossible_cloths_are_errors() {
    let kind = |change: &dyn Fn(&mut Scene)| {
        let mut scene = everything();
        change(&mut scene);
        Simulation::new(&scene).map(|_| ()).map_err(|error| error.kind)
    };
    let points = |w, h| {
        move |scene: &mut Scene| {
            let cloth = scene.cloth.as_mut().unwrap();
            (cloth.num_width_points, cloth.num_height_points) = (w, h);
        }
    };
    assert_eq!(kind(&points(1 << 40, 1 << 40)), Err(Kind::Scene), "more points than can be counted");
    assert_eq!(kind(&points(1 << 32, 1 << 28)), Err(Kind::Scene), "more bytes than can be addressed");
    assert_eq!(kind(&points(1, 9)), Err(Kind::Scene), "one point wide");
    assert_eq!(kind(&points(9, 0)), Err(Kind::Scene), "no points high");
    assert_eq!(
        kind(&|scene| scene.cloth.as_mut().unwrap().pinned = vec![[0, 50]]),
        Err(Kind::Scene),
        "pin outside"
    );
    assert_eq!(kind(&points(2, 2)), Ok(()), "the smallest cloth");
}

#[test]
fn a_state_must_fit_the_cloth() {
    let mut simulation = Simulation::new(&scenes::pinned2()).unwrap();
    let x = simulation.positions().clone();
    let short = Points::zeros(2499).unwrap();
    assert_eq!(simulation.set_state(x.clone(), short).unwrap_err().kind, Kind::Scene);
    let before = simulation.state_hash();
    assert!(simulation.set_state(x.clone(), x).is_ok(), "a state of this cloth");
    assert_eq!(simulation.state_hash(), before, "the same state");
}
