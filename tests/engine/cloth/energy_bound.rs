//! A cloth that blows up is an error, before the first step or within a few frames; a stable one
//! never is.

#![expect(clippy::unwrap_used, clippy::cast_possible_truncation, reason = "a test may panic")]

use crate::scenes;
use std::collections::BTreeSet;

use drape::diagnostics::stability::Stability;
use drape::error::Kind;
use drape::math::powi;
use drape::scene::{Cloth, Integrator, Orientation, Precision, Scene, SelfCollision, Sim, Vec3};
use drape::simulation::Simulation;
use rayon::prelude::*;

/// `pinned2` with `side` x `side` points and springs of `ks` on `density`.
fn sheet(side: usize, ks: f64, density: f64) -> Scene {
    let pinned = vec![[0, 0], [side - 1, 0]];
    scenes::with_cloth(Cloth {
        num_width_points: side,
        num_height_points: side,
        thickness: 0.2 / side as f64,
        pinned,
        ks,
        density,
        ..scenes::cloth()
    })
}

fn stability(scene: &Scene) -> Stability {
    Stability::new(scene.cloth.as_ref().unwrap(), &scene.sim).unwrap()
}

/// The frame in which `scene` fails with a ledger kept, if it does within `frames`.
fn failure(scene: &Scene, frames: u64) -> Option<u64> {
    let mut simulation = Simulation::new(scene).unwrap();
    simulation.record_ledger().unwrap();
    (1..=frames).find(|_| match simulation.advance_frame() {
        Ok(()) => false,
        Err(error) => {
            assert_eq!(error.kind, Kind::Unstable, "{error}");
            true
        }
    })
}

#[test]
fn no_stock_scene_is_refused() {
    std::thread::scope(|scope| {
        for (name, scene) in scenes::stock() {
            scope.spawn(move || assert_eq!(failure(&scene, 150), None, "{name}"));
        }
    });
}

/// Over stiffness, density and steps, with the stretch limit and without: a cloth with fewer steps
/// than are stable at rest fails within a second, one with as many never does.
#[test]
fn what_is_predicted_is_what_happens() {
    let cells =
        [500.0, 5e3, 5e4, 5e5].into_iter().flat_map(|ks| [1.5, 15.0, 150.0, 1500.0].map(|rho| (ks, rho)));
    cells.par_bridge().for_each(|(ks, density)| {
        for limit in [None, Some(0.1)] {
            let mut scene = sheet(16, ks, density);
            scene.sim.stretch_limit = limit;
            let stability = stability(&scene);
            let [rest, safe] =
                [stability.fewest_steps_rest(), stability.fewest_steps_worst()].map(|steps| steps as u32);
            let part = |part: f64| (part * f64::from(rest)) as u32;
            let fewer = [1, part(0.3), part(0.6), part(0.8), part(0.9), rest - 1];
            let too_few: BTreeSet<u32> = fewer.into_iter().filter(|&n| (1..rest).contains(&n)).collect();
            let enough = BTreeSet::from([rest, rest.midpoint(safe), safe]);
            for steps in too_few.into_iter().chain(enough) {
                scene.sim.steps_per_frame = steps;
                assert_eq!(
                    failure(&scene, 90).is_some(),
                    steps < rest,
                    "ks {ks}, density {density}, limit {limit:?}: {steps} steps, {rest} at rest, {safe} at worst"
                );
            }
        }
    });
}

/// A large cloth that is stable at rest but not when it is deformed blows up behind the stretch
/// limit: the ledger alone shows it.
#[test]
fn a_blow_up_that_holds_little_energy_is_seen_by_the_ledger() {
    let mut scene = sheet(200, 5000.0, 150.0);
    (scene.sim.steps_per_frame, scene.cloth.as_mut().unwrap().thickness) = (19, 0.0);
    let found = stability(&scene);
    assert!(!found.is_unstable_at_rest() && !found.is_always_stable());
    let frame = failure(&scene, 60).expect("seen");
    let mut simulation = Simulation::new(&scene).unwrap();
    for _ in 0..frame {
        simulation.advance_frame().expect("not seen without a ledger");
    }
}

/// Without damping a cloth can gain energy in resonance although small vibrations about any shape are
/// stable; a little damping prevents it, and so does a step below the bound at worst.
#[test]
fn resonance_makes_an_undamped_cloth_gain_energy() {
    let mut scene = sheet(12, 5000.0, 150.0);
    (scene.sim.steps_per_frame, scene.sim.fps) = (1, 121.0);
    (scene.sim.stretch_limit, scene.sim.self_collision) = (None, SelfCollision::Off);
    let damped = |scene: &Scene, damping: f64| {
        let mut scene = scene.clone();
        scene.cloth.as_mut().unwrap().damping = damping;
        scene
    };
    let undamped = damped(&scene, 0.0);
    let found = stability(&undamped);
    assert!(found.dt * found.omega_safe < found.limit && !found.is_always_stable(), "{found:?}");
    assert!(failure(&undamped, 4000).is_some());
    assert_eq!(failure(&damped(&scene, 0.05), 4000), None);
    let enough = Scene { sim: Sim { fps: 171.0, ..undamped.sim.clone() }, ..undamped };
    assert!(stability(&enough).is_always_stable(), "{:?}", stability(&enough));
    assert_eq!(failure(&enough, 4000), None);
}

/// Self-collision pushes points apart in every step until they are far enough, and pushes add up: to more
/// than one push gives, and no more than the guard allows.
#[test]
fn pushes_of_self_collision_are_no_blow_up() {
    for steps in [3, 30, 300] {
        let mut scene = sheet(20, 0.0, 150.0);
        (scene.sim.gravity, scene.sim.stretch_limit) = (Vec3::zeros(), None);
        (scene.sim.steps_per_frame, scene.sim.self_collision) = (steps, SelfCollision::Neighbors);
        let cloth = scene.cloth.as_mut().unwrap();
        (cloth.thickness, cloth.damping) = (0.05, 0.0);
        assert_eq!(failure(&scene, 90), None, "{steps} steps a frame");
        let mut simulation = Simulation::new(&scene).unwrap();
        (0..90).for_each(|_| simulation.advance_frame().unwrap());
        let push = 0.5 * 150.0 * (2.0 * 0.05 * scene.sim.fps) * (2.0 * 0.05 * scene.sim.fps);
        let kinetic = simulation.energy().kinetic;
        assert!(kinetic > push || steps == 3, "{kinetic} J in motion, {push} J for one push");
    }
}

/// Rounding moves a cloth that nothing else moves, in binary32 against the stretch limit too: that is no blow-up.
#[test]
fn rounding_is_no_blow_up() {
    let kinds = [
        (Integrator::Bdf2, Precision::F64),
        (Integrator::ImplicitEuler, Precision::F64),
        (Integrator::Rk4, Precision::F64),
        (Integrator::Verlet, Precision::F64),
        (Integrator::Verlet, Precision::F32),
    ];
    for (integrator, precision) in kinds {
        for (limit, ks) in [(None, 5e3), (Some(0.1), 8e4), (Some(0.0), 5e3)] {
            let mut scene = sheet(8, ks, 150.0);
            (scene.sim.gravity, scene.sim.stretch_limit) = (Vec3::zeros(), limit);
            (scene.sim.integrator, scene.sim.precision) = (integrator, precision);
            scene.sim.self_collision = SelfCollision::Off;
            let cloth = scene.cloth.as_mut().unwrap();
            (cloth.orientation, cloth.offset, cloth.damping) =
                (Orientation::Vertical, Vec3::new(2.3, 0.0, 0.0), 0.0);
            assert_eq!(failure(&scene, 90), None, "{integrator:?}, {precision:?}, {limit:?}");
        }
    }
}

/// A cloth so heavy that the stretch limit bears it: its springs answer each correction, more the
/// nearer the step is to the bound, and put in more than the allowance while the cloth comes to rest.
#[test]
fn springs_that_answer_the_stretch_limit_are_no_blow_up() {
    let mut scene = scenes::pinned2();
    (scene.sim.fps, scene.cloth.as_mut().unwrap().ks) = (5.7, 500.0);
    assert!(stability(&scene).is_always_stable());
    let mut simulation = Simulation::new(&scene).unwrap();
    simulation.record_ledger().unwrap();
    (0..40).for_each(|_| simulation.advance_frame().unwrap());
    let (ledger, kinetic) = (simulation.ledger().unwrap(), simulation.energy().kinetic);
    let put_in = ledger.springs + ledger.gravity;
    // Half of M g L, as `src/diagnostics/energy_bound.rs` has it, is 735 J.
    assert!(put_in > 735.0 && kinetic < 30.0, "{put_in} J in, {kinetic} J in motion");
}

/// The stretch limit keeps strains at 10 % and every number finite, and yet it is seen.
#[test]
fn a_blow_up_behind_the_stretch_limit_is_seen_and_can_be_allowed() {
    for times in [1.1, 1.4, 4.0] {
        let mut scene = scenes::pinned2();
        let Stability { dt, limit, omega_rest, .. } = stability(&scene);
        scene.cloth.as_mut().unwrap().ks *= times * powi(limit / (dt * omega_rest), 2, 1.0);
        assert!(stability(&scene).is_unstable_at_rest());
        let mut simulation = Simulation::new(&scene).unwrap();
        let error = (0..30).find_map(|_| simulation.advance_frame().err()).expect("seen");
        for part in [
            "motion and height hold",
            "at step ",
            "point (",
            "spring between",
            "most energy came from springs",
            "last good frame",
        ] {
            assert!(error.to_string().contains(part), "{times}: {part}: {error}");
        }

        if times > 2.0 {
            continue;
        }
        let mut simulation = Simulation::new(&scene).unwrap();
        simulation.allow_unstable();
        for _ in 0..40 {
            simulation.advance_frame().unwrap();
        }
        assert!(
            simulation.extremes().stretch < 1.5,
            "{times}: nothing else shows it: {:?}",
            simulation.extremes()
        );
    }
}

/// The error names the very step at which stepping by hand breaks the check first.
#[test]
fn the_step_that_is_named_is_the_first_lost_one() {
    let mut scene = sheet(6, 5e6, 150.0);
    (scene.sim.stretch_limit, scene.sim.steps_per_frame) = (None, 2000);
    scene.sim.fps = 0.01;
    let mut simulation = Simulation::new(&scene).unwrap();
    simulation.allow_unstable();
    let error = simulation.advance_frame().unwrap_err();
    let mut by_hand = Simulation::new(&scene).unwrap();
    let step = (1..=2000).find(|_| {
        by_hand.step();
        let x = by_hand.positions();
        !x.x.iter().chain(&x.y).chain(&x.z).all(|value| value.abs() <= 1e15)
    });
    let place = format!("at step {};", step.unwrap());
    assert!(error.message.contains(&place) && error.message.contains("is lost"), "{place} {error}");
}

/// The step that is named is the first one after which springs and gravity have put in too much.
#[test]
fn the_step_that_is_named_is_the_first_overdrawn_one() {
    let mut scene = sheet(16, 5e5, 15000.0);
    scene.sim.steps_per_frame = 1;
    let mut simulation = Simulation::new(&scene).unwrap();
    simulation.record_ledger().unwrap();
    let error = (0..90).find_map(|_| simulation.advance_frame().err()).expect("seen");
    let step = simulation.steps();
    let numbers: Vec<f64> = error
        .message
        .split(' ')
        .filter_map(|word| word.parse().ok())
        .filter(|number| *number > 0.0)
        .collect();
    let [put_in, most] = numbers[..2] else { panic!("two energies: {error}") };
    let ledger = simulation.ledger().unwrap();
    assert!((ledger.springs + ledger.gravity - put_in).abs() < 1e-4 * put_in, "{error}");
    assert!(put_in > most && error.message.contains(&format!(" at step {step};")), "step {step}: {error}");

    let mut by_hand = Simulation::new(&scene).unwrap();
    by_hand.record_ledger().unwrap();
    (1..step).for_each(|_| by_hand.step());
    let before = by_hand.ledger().unwrap();
    assert!(before.springs + before.gravity <= most, "the step before was fine: {before:?}");
}

/// A large cloth is refused at 30 steps a frame and accepted at 45, before the first step; and that
/// is what happens: at 30 it blows up, at 45 it falls.
#[test]
fn a_large_cloth_is_judged_before_the_first_step() {
    let mut scene = sheet(400, 5000.0, 150.0);
    scene.cloth.as_mut().unwrap().thickness = 0.0;
    assert!(stability(&scene).is_unstable_at_rest(), "30 steps");
    assert!(failure(&scene, 4).is_some(), "30 steps");
    scene.sim.steps_per_frame = 45;
    assert!(stability(&scene).is_always_stable(), "45 steps");
    assert_eq!(failure(&scene, 2), None, "45 steps");
}
