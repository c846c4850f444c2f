//! A cloth that blows up is an error, before the first step or within a few frames; a stable one
//! never is.

#![expect(clippy::unwrap_used, clippy::cast_possible_truncation, reason = "a test may panic")]

mod scenes;

use drape::cloth::stability::Stability;
use drape::error::Kind;
use drape::math::powi;
use drape::scene::{Cloth, Scene};
use drape::simulation::Simulation;

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

/// The frame in which `scene` fails, if it does within `frames`.
fn failure(scene: &Scene, frames: u64) -> Option<u64> {
    let mut simulation = Simulation::new(scene).unwrap();
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
            scope.spawn(move || assert_eq!(failure(&scene, 300), None, "{name}"));
        }
    });
}

/// Over stiffness and density: as many steps as the worst case asks for never fail, with the
/// stretch limit and without; fewer than at rest fail soon without it. (Behind the limit, with one
/// step a frame, a blow-up may hold less energy than is allowed: the bound sees it, the guard not.)
#[test]
fn what_is_predicted_is_what_happens() {
    for ks in [500.0, 5e3, 5e4, 5e5] {
        for density in [1.5, 15.0, 150.0, 1500.0] {
            for limit in [None, Some(0.1)] {
                let mut scene = sheet(16, ks, density);
                scene.sim.stretch_limit = limit;
                let stability = stability(&scene);
                let [rest, safe] = [stability.omega_rest, stability.omega_safe]
                    .map(|omega| stability.fewest_steps(omega) as u32);
                let mut frame_at = |steps, frames| {
                    scene.sim.steps_per_frame = steps;
                    failure(&scene, frames)
                };
                let cell = format!("ks {ks}, density {density}, limit {limit:?}");
                assert_eq!(
                    frame_at(safe, 90),
                    None,
                    "{cell}: {safe} steps are stable in every configuration"
                );
                assert_eq!(frame_at(rest, 90), None, "{cell}: {rest} steps are stable at rest");
                // A quarter fewer steps than at rest: the cloth does not blow up before it is stretched.
                let over = (0.77 * stability.omega_rest / (90.0 * stability.limit)).floor() as u32;
                if over > 0 && limit.is_none() {
                    assert!(frame_at(over, 90).is_some(), "{cell}: {over} steps, at least {rest} at rest");
                }
            }
        }
    }
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

/// A large cloth is refused at 30 steps a frame and accepted at 45, before the first step.
#[test]
fn a_large_cloth_is_judged_before_the_first_step() {
    let mut scene = sheet(400, 5000.0, 150.0);
    assert!(stability(&scene).is_unstable_at_rest(), "30 steps");
    scene.sim.steps_per_frame = 45;
    assert!(stability(&scene).is_always_stable(), "45 steps");
}
