//! Each integrator solves its own discrete equations, has its order, and keeps its laws.

#![expect(clippy::unwrap_used, clippy::cast_possible_truncation, reason = "a test may panic")]

mod scenes;

use drape::cloth::{Points, damping_rate};
use drape::error::Kind;
use drape::math::{atan2, cos, ln, powi};
use drape::scene::{Damping, Integrator, Precision, Scene, SelfCollision, Start, Vec3};
use drape::simulation::Simulation;

const G: f64 = 9.8;
const ALL: [Integrator; 4] =
    [Integrator::Verlet, Integrator::Xpbd, Integrator::ImplicitEuler, Integrator::Bdf2];
const OTHERS: [Integrator; 3] = [Integrator::Xpbd, Integrator::ImplicitEuler, Integrator::Bdf2];

/// A cloth of `side` x `side` points held at two corners, undamped, without limit and contact.
fn hanging(side: usize, integrator: Integrator) -> Scene {
    let mut scene = scenes::pinned2();
    scene.sim.integrator = integrator;
    (scene.sim.stretch_limit, scene.sim.self_collision) = (None, SelfCollision::Off);
    let cloth = scene.cloth.as_mut().unwrap();
    (cloth.num_width_points, cloth.num_height_points, cloth.damping) = (side, side, 0.0);
    cloth.pinned = vec![[0, 0], [side - 1, 0]];
    scene
}

/// The same cloth, held nowhere.
fn falling(integrator: Integrator) -> Scene {
    let mut scene = hanging(4, integrator);
    scene.cloth.as_mut().unwrap().pinned.clear();
    scene
}

/// Root of the mean squared distance of corresponding points.
fn rms(a: &Points, b: &Points) -> f64 {
    let squares: f64 = (0..a.len()).map(|p| (a.get(p) - b.get(p)).norm_squared()).sum();
    (squares / a.len() as f64).sqrt()
}

/// The positions of `scene` after `frames` frames of so many steps.
fn end(scene: &Scene, frames: u32, steps_per_frame: u32) -> Simulation {
    let mut scene = scene.clone();
    scene.sim.steps_per_frame = steps_per_frame;
    let mut simulation = Simulation::new(&scene).unwrap();
    (0..frames).for_each(|_| simulation.advance_frame().unwrap());
    simulation
}

/// `a · b` and `a / b` of complex numbers.
fn times(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]]
}
fn over(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    times(a, [b[0] / (b[0] * b[0] + b[1] * b[1]), -b[1] / (b[0] * b[0] + b[1] * b[1])])
}

/// The exact discrete displacements of one spring with `mu` = dt ω, released at 1 from rest.
/// With y = x + i v / ω the spring is `y' = -i ω y`.
fn exact(integrator: Integrator, mu: f64, steps: usize) -> Vec<f64> {
    let theta = {
        let c = 1.0 - 0.5 * mu * mu;
        atan2((1.0 - c * c).sqrt(), c)
    };
    let (mut y, mut before) = ([1.0, 0.0], [1.0, 0.0]);
    let next = |k: usize| {
        let euler = over(y, [1.0, mu]);
        let numerator = [(4.0 * y[0] - before[0]) / 3.0, (4.0 * y[1] - before[1]) / 3.0];
        before = y;
        y = match integrator {
            Integrator::Verlet => [cos((k as f64 + 1.5) * theta) / cos(0.5 * theta), 0.0],
            Integrator::Xpbd | Integrator::ImplicitEuler => euler,
            Integrator::Bdf2 if k == 0 => euler,
            Integrator::Bdf2 => over(numerator, [1.0, 2.0 / 3.0 * mu]),
        };
        y[0]
    };
    (0..steps).map(next).collect()
}

/// Two crossed springs, of which the one between (0, 0) and (1, 1) has a free end.
fn one_spring(integrator: Integrator, ks: f64) -> Scene {
    let mut scene = hanging(2, integrator);
    (scene.sim.gravity, scene.sim.tolerance) = (Vec3::zeros(), 1e-14);
    let cloth = scene.cloth.as_mut().unwrap();
    (cloth.enable_structural, cloth.enable_bending) = (false, false);
    cloth.pinned = vec![[0, 0], [1, 0], [0, 1]];
    (cloth.ks, cloth.density) = (ks, 4.0);
    scene
}

#[test]
fn one_spring_moves_by_the_exact_discrete_solution() {
    for integrator in ALL {
        for mu in [0.05, 0.3, 1.0, 1.9, 30.0] {
            if integrator == Integrator::Verlet && mu > 2.0 {
                continue;
            }
            let ks = (mu * 2700.0) * (mu * 2700.0);
            let mut simulation = Simulation::new(&one_spring(integrator, ks)).unwrap();
            let rest = simulation.positions().clone();
            let along = Vec3::new(0.5_f64.sqrt(), 0.0, 0.5_f64.sqrt());
            let mut x = rest.clone();
            x.set(3, rest.get(3) + along * 0.1);
            simulation.set_state(x.clone(), x).unwrap();
            for (k, expected) in exact(integrator, mu, 300).into_iter().enumerate() {
                simulation.step();
                let found = (simulation.positions().get(3) - rest.get(3)).dot(&along) / 0.1;
                assert!(
                    (found - expected).abs() < 1e-9,
                    "{integrator:?}, mu {mu}, step {k}: {found}, not {expected}"
                );
            }
        }
    }
}

/// Without springs in the way: symplectic and implicit Euler fall by `g h² k (k + 1) / 2`.
#[test]
fn free_fall_is_the_exact_discrete_one() {
    let h = 1.0 / 2700.0;
    for integrator in OTHERS {
        let mut simulation = Simulation::new(&falling(integrator)).unwrap();
        let (mut y, mut last, mut v, mut v_last) = (0.0, 0.0, 0.0, 0.0);
        for k in 0..900_i32 {
            simulation.step();
            let (v_next, y_next) = if integrator == Integrator::Bdf2 && k > 0 {
                let v_next = (4.0 * v - v_last) / 3.0 - 2.0 / 3.0 * h * G;
                (v_next, (4.0 * y - last) / 3.0 + 2.0 / 3.0 * h * v_next)
            } else {
                (v - h * G, y + h * (v - h * G))
            };
            (v_last, v, last, y) = (v, v_next, y, y_next);
            let t = f64::from(k + 1) * h;
            let continuous = -0.5 * G * t * t;
            let bound = if integrator == Integrator::Bdf2 { G * h * h } else { 0.5001 * G * h * t + 1e-9 };
            assert!((y - continuous).abs() <= bound, "{integrator:?} {k}: the equations of the test");
            for found in &simulation.positions().y {
                assert!((found - 1.0 - y).abs() < 1e-9, "{integrator:?}, step {k}: {} of {y}", found - 1.0);
            }
        }
    }
}

/// Free fall ends at `g / c` with damping per second, for every step; with damping per step
/// at `g h / d`, and `g h / (d + d² / 2)` for the second-order formula.
#[test]
fn damping_has_its_terminal_speed() {
    for integrator in OTHERS {
        for (damping, steps) in [(Damping::PerStep, 30), (Damping::PerSecond, 1), (Damping::PerSecond, 30)] {
            let mut scene = falling(integrator);
            let d = 0.02;
            scene.cloth.as_mut().unwrap().damping = 100.0 * d;
            (scene.sim.damping, scene.sim.steps_per_frame, scene.sim.tolerance) = (damping, steps, 1e-12);
            let mut simulation = Simulation::new(&scene).unwrap();
            (0..300).for_each(|_| simulation.advance_frame().unwrap());
            let expected = match (damping, integrator) {
                (Damping::PerSecond, _) => G / damping_rate(2.0),
                (_, Integrator::Bdf2) => G / 2700.0 / (d + d * d / 2.0),
                _ => G / 2700.0 / d,
            };
            let speed = simulation.extremes().speed;
            assert!((speed / expected - 1.0).abs() < 1e-6, "{integrator:?} {damping:?}: {speed}, {expected}");
        }
    }
}

/// Halving the step divides the error by two to the power of the order.
#[test]
fn every_integrator_has_its_order() {
    let mut best = hanging(8, Integrator::Verlet);
    best.sim.start = Start::HalfStep;
    let reference = end(&best, 18, 960).positions().clone();
    for (integrator, order) in [
        (Integrator::Verlet, 2.0),
        (Integrator::Bdf2, 2.0),
        (Integrator::ImplicitEuler, 1.0),
        (Integrator::Xpbd, 1.0),
    ] {
        let mut scene = hanging(8, integrator);
        scene.sim.tolerance = 1e-9;
        if integrator == Integrator::Verlet {
            scene.sim.start = Start::HalfStep;
        }
        let errors = [30, 60, 120].map(|steps| rms(end(&scene, 18, steps).positions(), &reference));
        for pair in errors.windows(2) {
            let found = ln(pair[0] / pair[1]) / ln(2.0);
            assert!((found - order).abs() < 0.1, "{integrator:?}: order {found} of {order}, {errors:?}");
        }
    }
}

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
    scene.planes.push(scenes::floor());
    scene.planes[0].point.y = 0.35;
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
                assert!(entry != 0.0, "{:?}: {part} takes part", scene.sim.integrator);
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

/// A cloth at rest stays there, under every integrator at the same place.
#[test]
fn all_come_to_the_same_rest() {
    let rests = ALL.map(|integrator| {
        let mut scene = hanging(5, integrator);
        scene.cloth.as_mut().unwrap().damping = 0.6;
        (scene.sim.tolerance, scene.sim.iterations) = (1e-12, 40);
        end(&scene, 900, 10).positions().clone()
    });
    for (integrator, rest) in ALL.iter().zip(&rests) {
        // Passes over the springs do not converge quite.
        let most = if *integrator == Integrator::Xpbd { 1e-4 } else { 1e-6 };
        assert!(rms(rest, &rests[0]) < most, "{integrator:?}: {:e} m away", rms(rest, &rests[0]));
    }
}

/// The stock cloth at 600 steps a second after 0.5 s, against a converged reference. Independent
/// solvers of implicit Euler's equations (projective dynamics, block descent) end there as well.
#[test]
fn implicit_euler_has_its_published_error() {
    let mut best = hanging(50, Integrator::Verlet);
    (best.sim.fps, best.sim.start) = (60.0, Start::HalfStep);
    let reference = end(&best, 30, 288);
    let mut scene = hanging(50, Integrator::ImplicitEuler);
    scene.sim.fps = 60.0;
    let found = end(&scene, 30, 10);
    let error = rms(found.positions(), reference.positions());
    let gained = found.energy().total() - 1470.0;
    assert!((error - 4.12e-3).abs() < 2e-5, "rms {error} m");
    assert!((gained + 32.13).abs() < 0.02, "energy {gained} J");
}

/// In displacement form binary32 stays close to binary64, and closer than a centimetre for small
/// steps too, where the position form stands still.
#[test]
fn binary32_stays_close_to_binary64() {
    for (steps, most) in [(30, 1e-5), (120, 1e-4), (300, 2e-4)] {
        let mut scene = hanging(50, Integrator::Verlet);
        scene.sim.damping = Damping::PerSecond;
        scene.cloth.as_mut().unwrap().damping = 0.2;
        let double = end(&scene, 45, steps);
        scene.sim.precision = Precision::F32;
        let single = end(&scene, 45, steps);
        let largest = (0..2500)
            .map(|p| (double.positions().get(p) - single.positions().get(p)).norm())
            .fold(0.0, f64::max);
        assert!(0.0 < largest && largest < most, "{steps} steps a frame: {largest:e} m");
        let x = single.positions();
        for value in x.x.iter().chain(&x.y).chain(&x.z).enumerate().filter(|(i, _)| i % 2500 > 49) {
            let rounded = *value.1 as f32;
            assert_eq!(f64::from(rounded), *value.1, "positions are binary32 numbers");
        }
    }
}

#[test]
fn the_exact_solution_of_the_test_decays_as_it_must() {
    let mu: f64 = 0.3;
    let euler = exact(Integrator::ImplicitEuler, mu, 40);
    let envelope = powi(1.0 / (1.0 + mu * mu).sqrt(), 40, 1.0);
    assert!(euler[39].abs() <= envelope, "|z| = (1 + mu²)^(-1/2)");
    let largest = exact(Integrator::Bdf2, 0.05, 4000)[3900..].iter().fold(0.0_f64, |a, b| a.max(b.abs()));
    // |z| ~ 1 - mu⁴ / 4 for BDF2.
    let expected = powi(1.0 - 0.25 * powi(0.05_f64, 4, 1.0), 3950, 1.0);
    assert!((largest / expected - 1.0).abs() < 0.01, "{largest}, {expected}");
}

/// The springs of a scene's cloth as (a, b, stiffness, rest length), found from the grid alone.
fn springs(side: usize, ks: f64, x: &Points) -> Vec<(usize, usize, f64, f64)> {
    let mut springs = Vec::new();
    for (a, b) in (0..side * side).flat_map(|a| (0..a).map(move |b| (a, b))) {
        let apart = [(a % side).abs_diff(b % side), a / side - b / side];
        let stiffness = match apart {
            [0, 1] | [1, 0] | [1, 1] => ks,
            [0, 2] | [2, 0] => 0.2 * ks,
            _ => continue,
        };
        springs.push((a, b, stiffness, (x.get(a) - x.get(b)).norm()));
    }
    springs
}

/// One step of implicit Euler by vertex block descent: one point after the other goes to where a
/// Newton step of its own three unknowns leads, until nothing moves any more.
fn block_descent(
    x: &Points,
    last: &Points,
    springs: &[(usize, usize, f64, f64)],
    pins: &[usize],
    inertia: f64,
    gravity: Vec3,
) -> Points {
    let mut now = x.clone();
    let target = |p: usize| x.get(p) * 2.0 - last.get(p) + gravity;
    for _ in 0..20_000 {
        let mut farthest = 0.0_f64;
        for p in (0..x.len()).filter(|p| !pins.contains(p)) {
            let mut force = (target(p) - now.get(p)) * inertia;
            let mut hessian = nalgebra::Matrix3::identity() * inertia;
            for &(a, b, k, rest) in springs.iter().filter(|(a, b, ..)| *a == p || *b == p) {
                let e = now.get(a + b - p) - now.get(p);
                let (l, n) = (e.norm(), e.normalize());
                force += n * (k * (l - rest));
                hessian += (n * n.transpose()
                    + (nalgebra::Matrix3::identity() - n * n.transpose()) * (1.0 - rest / l).max(0.0))
                    * k;
            }
            let moved = hessian.try_inverse().unwrap() * force;
            now.set(p, now.get(p) + moved);
            farthest = farthest.max(moved.norm());
        }
        if farthest < 1e-15 {
            return now;
        }
    }
    panic!("block descent did not converge");
}

/// Two solvers that share no code agree, step by step.
#[test]
fn implicit_euler_agrees_with_block_descent() {
    let side = 6;
    for (steps_per_frame, frames) in [(1, 20), (10, 3)] {
        let mut scene = hanging(side, Integrator::ImplicitEuler);
        (scene.sim.steps_per_frame, scene.sim.tolerance) = (steps_per_frame, 1e-12);
        let mut simulation = Simulation::new(&scene).unwrap();
        let springs = springs(side, 5000.0, simulation.positions());
        let h = 1.0 / 90.0 / f64::from(steps_per_frame);
        let inertia = 150.0 / 36.0 / (h * h);
        for step in 0..frames * steps_per_frame {
            let (x, last) = (simulation.positions().clone(), simulation.last_positions().clone());
            let gravity = Vec3::new(0.0, -G * h * h, 0.0);
            let expected = block_descent(&x, &last, &springs, &[0, side - 1], inertia, gravity);
            simulation.step();
            let away = rms(simulation.positions(), &expected);
            assert!(away < 1e-11, "{steps_per_frame} steps a frame, step {step}: {away:e} m");
        }
    }
}
