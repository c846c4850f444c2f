//! The simulation keeps the laws that this method keeps. Each has a known answer, most of them
//! exact for the discrete scheme; a tolerance covers rounding only, at about ten to a hundred times
//! of what was found.

#![expect(clippy::unwrap_used, clippy::cast_possible_truncation, reason = "a test may panic")]

mod scenes;

use drape::cloth::Points;
use drape::cloth::stability::Stability;
use drape::math::{atan2, cos, powi, sin, splitmix64};
use drape::scene::{Cloth, Scene, SelfCollision, Vec3};
use drape::simulation::Simulation;
use proptest::prelude::*;

const G: f64 = 9.8;

/// A cloth of `width` x `height` points and nothing but springs: no weight, damping, limit or contact.
fn springs_only(width: usize, height: usize) -> Scene {
    let mut scene = scenes::with_cloth(Cloth {
        num_width_points: width,
        num_height_points: height,
        thickness: 0.0,
        damping: 0.0,
        ..scenes::cloth()
    });
    scene.sim.gravity = Vec3::zeros();
    scene.sim.stretch_limit = None;
    scene.sim.self_collision = SelfCollision::Off;
    scene
}

fn cloth(scene: &mut Scene) -> &mut Cloth {
    scene.cloth.as_mut().unwrap()
}

fn step_of(scene: &Scene) -> f64 {
    1.0 / scene.sim.fps / f64::from(scene.sim.steps_per_frame)
}

fn mass_of(scene: &Scene) -> f64 {
    let cloth = scene.cloth.as_ref().unwrap();
    let points = (cloth.num_width_points * cloth.num_height_points) as f64;
    cloth.width * cloth.height * cloth.density / points
}

/// A number in -1..1 that depends on `index` alone.
fn noise(index: usize) -> f64 {
    (splitmix64(index as u64) >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
}

/// The simulation of `scene` with every point moving at up to `speed` m/s along each axis.
fn stirred(scene: &Scene, speed: f64) -> Simulation {
    let mut simulation = Simulation::new(scene).unwrap();
    let x = simulation.positions().clone();
    let mut last = x.clone();
    for p in 0..x.len() {
        let velocity = Vec3::new(noise(3 * p), noise(3 * p + 1), noise(3 * p + 2)) * speed;
        last.set(p, x.get(p) - velocity * step_of(scene));
    }
    simulation.set_state(x, last).unwrap();
    simulation
}

fn run(simulation: &mut Simulation, steps: usize) {
    (0..steps).for_each(|_| simulation.step());
}

/// Sum over the points of what `of` makes of the position and the last position.
fn sum(simulation: &Simulation, of: impl Fn(Vec3, Vec3) -> Vec3) -> Vec3 {
    let (x, last) = (simulation.positions(), simulation.last_positions());
    (0..x.len()).map(|p| of(x.get(p), last.get(p))).sum()
}

/// Sum over the points of the lengths of their last displacements, in metres.
fn path(simulation: &Simulation) -> f64 {
    sum(simulation, |x, last| Vec3::new((x - last).norm(), 0.0, 0.0)).x
}

/// Largest distance between corresponding points.
fn distance(a: &Points, b: &Points) -> f64 {
    (0..a.len()).map(|p| (a.get(p) - b.get(p)).norm()).fold(0.0, f64::max)
}

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

#[test]
fn a_cloth_at_rest_is_stable_exactly_from_the_predicted_steps_on() {
    for (points, ks, percent) in [(12, 2e5, 0.0), (8, 1e6, 0.0), (8, 1e6, 60.0)] {
        let mut scene = springs_only(points, points);
        (cloth(&mut scene).ks, cloth(&mut scene).damping) = (ks, percent);
        let stability = Stability::new(scene.cloth.as_ref().unwrap(), &scene.sim).unwrap();
        let fewest = stability.fewest_steps(stability.omega_rest);
        let growth = |steps: f64| {
            scene.sim.steps_per_frame = steps as u32;
            let mut simulation = stirred(&scene, 1e-7);
            let start = simulation.energy().total();
            run(&mut simulation, 3000);
            simulation.energy().total() / start
        };
        let [stable, unstable] = [fewest, fewest - 1.0].map(growth);
        assert!(stable < 1e3, "{points} points, {fewest} steps: energy grew {stable} times");
        assert!(
            unstable > 1e6 || unstable.is_nan(),
            "{points} points, one step fewer: energy grew {unstable} times"
        );
    }
}

#[test]
fn the_stock_cloth_has_its_known_stability() {
    for (points, rest, safe) in [(50, 5.0, 6.0), (200, 19.0, 23.0), (400, 37.0, 45.0)] {
        let mut scene = scenes::pinned2();
        let cloth = cloth(&mut scene);
        (cloth.num_width_points, cloth.num_height_points) = (points, points);
        cloth.pinned = vec![[0, 0], [points - 1, 0]];
        let stability = Stability::new(&cloth.clone(), &scene.sim).unwrap();
        assert_eq!(stability.fewest_steps(stability.omega_rest), rest, "{points} points at rest");
        assert_eq!(stability.fewest_steps(stability.omega_safe), safe, "{points} points at worst");
        assert_eq!(stability.is_unstable_at_rest(), rest > 30.0, "{points} points at 30 steps a frame");
        assert_eq!(stability.is_always_stable(), safe <= 30.0, "{points} points at 30 steps a frame");
        let lattice = (8.0 * 5000.0 / stability.mass).sqrt();
        let part = stability.omega_rest / lattice;
        assert!((0.999..1.0).contains(&part), "{points} points vibrate at {part} of the endless lattice");
        assert!((stability.omega_safe / lattice - 1.5_f64.sqrt()).abs() < 1e-12, "12 against 8 ks/m");
    }
}

/// The largest eigenvalue at rest that is found for `scene`, in N/m.
fn found_at_rest(scene: &Scene) -> f64 {
    let stability = Stability::new(scene.cloth.as_ref().unwrap(), &scene.sim).unwrap();
    stability.omega_rest * stability.omega_rest * stability.mass
}

/// The largest eigenvalue of the endless lattice of `cloth`, over waves of every length: a spring
/// over (dx, dy) with phase difference f between its ends resists by `4 k sin²(f / 2) n nᵀ`.
fn lattice(cloth: &Cloth) -> f64 {
    let spacing = [
        cloth.width / (cloth.num_width_points - 1) as f64,
        cloth.height / (cloth.num_height_points - 1) as f64,
    ];
    let springs = [
        (cloth.enable_structural, 1.0, [[1.0, 0.0], [0.0, 1.0]]),
        (cloth.enable_shearing, 1.0, [[1.0, 1.0], [-1.0, 1.0]]),
        (cloth.enable_bending, 0.2, [[2.0, 0.0], [0.0, 2.0]]),
    ];
    let largest = |p: f64, q: f64| {
        let (mut xx, mut xy, mut yy) = (0.0, 0.0, 0.0);
        for (_, factor, offsets) in springs.into_iter().filter(|(enabled, ..)| *enabled) {
            for [dx, dy] in offsets {
                let half = sin((dx * p + dy * q) / 2.0);
                let k = 4.0 * factor * cloth.ks * half * half;
                let (x, y) = (dx * spacing[0], dy * spacing[1]);
                let square = x * x + y * y;
                (xx, xy, yy) = (xx + k * x * x / square, xy + k * x * y / square, yy + k * y * y / square);
            }
        }
        (xx + yy) / 2.0 + ((xx - yy) * (xx - yy) / 4.0 + xy * xy).sqrt()
    };
    let waves = || (0..=64).map(|wave| f64::from(wave) * std::f64::consts::PI / 64.0);
    waves().flat_map(|p| waves().map(move |q| (p, q))).map(|(p, q)| largest(p, q)).fold(0.0, f64::max)
}

/// A large cloth of any springs vibrates as fast as its endless lattice, but for 0.5 % of the
/// eigenvalue.
#[test]
fn a_large_cloth_vibrates_as_its_endless_lattice() {
    for kinds in 1..8 {
        for height in [1.0, 1.7, 0.2] {
            let mut scene = springs_only(90, 80);
            let cloth = cloth(&mut scene);
            cloth.height = height;
            (cloth.enable_structural, cloth.enable_shearing, cloth.enable_bending) =
                (kinds & 1 > 0, kinds & 2 > 0, kinds & 4 > 0);
            let endless = lattice(cloth);
            let part = found_at_rest(&scene) / endless;
            assert!(
                (0.995..1.0).contains(&part),
                "kinds {kinds:03b}, height {height}: {part} of {endless} N/m"
            );
        }
    }
}

/// Wherever the pins are, the fastest vibration is that of the points which are free.
#[test]
fn pins_anywhere_on_a_large_cloth_are_seen() {
    let pinned = |held: &dyn Fn(usize, usize) -> bool| {
        let mut scene = springs_only(200, 150);
        let points = (0..150).flat_map(|j| (0..200).map(move |i| [i, j]));
        cloth(&mut scene).height = 149.0 / 199.0;
        cloth(&mut scene).pinned = points.filter(|&[i, j]| held(i, j)).collect();
        found_at_rest(&scene) / 5000.0
    };
    let close = |found: f64, exact: f64, part: f64, what: &str| {
        assert!(found <= exact * (1.0 + 1e-12) && found >= part * exact, "{what}: {found} of {exact} ks");
    };
    close(pinned(&|i, j| i < 64 && j < 64), 8.0, 0.999, "the first corner pinned");
    close(pinned(&|i, j| i < 130 || j < 80), 8.0, 0.999, "all but the last corner pinned");
    close(pinned(&|_, _| true), 0.0, 1.0, "all pinned");
    // One point alone: structural springs 2 ks, shearing 2 ks, bending 0.4 ks along each axis.
    close(pinned(&|i, j| [i, j] != [170, 140]), 4.4, 1.0 - 1e-9, "one point free");
    close(pinned(&|i, j| i % 3 > 0 || j % 3 > 0), 4.4, 1.0 - 1e-9, "no two free points joined");
    close(pinned(&|i, j| i % 50 == 0 || j % 50 == 0), 8.0, 0.99, "squares of 49 x 49 free");

    // Nine by seven free points in the middle of nowhere, against the matrix of these alone.
    let block = |i, j, [x, y]: [usize; 2]| !((x..x + 9).contains(&i) && (y..y + 7).contains(&j));
    let mut small = springs_only(13, 11);
    cloth(&mut small).height = 10.0 / 12.0;
    let points = (0..11).flat_map(|j| (0..13).map(move |i| [i, j]));
    cloth(&mut small).pinned = points.filter(|&[i, j]| block(i, j, [2, 2])).collect();
    let rest = Simulation::new(&small).unwrap().positions().clone();
    let exact = eigenvalues(&small, &rest, &rest).last().unwrap() / 5000.0;
    close(pinned(&|i, j| block(i, j, [101, 77])), exact, 0.999, "a block free");
}

/// The eigenvalues of the stiffness of `scene`'s springs with the points at `x`, straight from
/// the definition, pinned points held, smallest first, in N/m.
fn eigenvalues(scene: &Scene, x: &Points, rest: &Points) -> Vec<f64> {
    let cloth = scene.cloth.as_ref().unwrap();
    let (w, h) = (cloth.num_width_points as isize, cloth.num_height_points as isize);
    let mut matrix = nalgebra::DMatrix::<f64>::zeros(3 * x.len(), 3 * x.len());
    let stencils = [
        (cloth.enable_structural, [(1, 0), (0, 1)], 1.0),
        (cloth.enable_shearing, [(1, 1), (-1, 1)], 1.0),
        (cloth.enable_bending, [(2, 0), (0, 2)], 0.2),
    ];
    for (_, offsets, factor) in stencils.into_iter().filter(|(enabled, ..)| *enabled) {
        for ((dx, dy), p) in offsets.into_iter().flat_map(|offset| (0..w * h).map(move |p| (offset, p))) {
            let (i, j) = (p % w - dx, p / w - dy);
            if !(0..w).contains(&i) || j < 0 {
                continue;
            }
            let (a, b) = (p as usize, (j * w + i) as usize);
            let e = x.get(b) - x.get(a);
            let along = e * e.transpose() / e.norm_squared();
            let slack = 1.0 - (rest.get(b) - rest.get(a)).norm() / e.norm();
            let across = (nalgebra::Matrix3::identity() - along) * slack;
            let stiffness = (along + across) * (factor * cloth.ks);
            for (row, column, sign) in [(a, a, 1.0), (b, b, 1.0), (a, b, -1.0), (b, a, -1.0)] {
                let mut block = matrix.fixed_view_mut::<3, 3>(3 * row, 3 * column);
                block += stiffness * sign;
            }
        }
    }
    for &[i, j] in &cloth.pinned {
        for c in 0..3 {
            let index = 3 * (j * cloth.num_width_points + i) + c;
            matrix.row_mut(index).fill(0.0);
            matrix.column_mut(index).fill(0.0);
        }
    }
    let mut values: Vec<f64> = matrix.symmetric_eigenvalues().iter().copied().collect();
    values.sort_by(f64::total_cmp);
    values
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    /// Pinned points stay where they are, bit for bit, whatever touches them.
    #[test]
    fn pinned_points_never_move(
        pins in prop::collection::vec((0_usize..6, 0_usize..6), 1..8), radius in 0.1_f64..1.0,
    ) {
        let mut scene = scenes::sphere();
        scene.spheres[0].origin = Vec3::new(0.5, 1.0, 0.5);
        scene.spheres[0].radius = radius;
        scene.planes.push(scenes::floor());
        let cloth = cloth(&mut scene);
        (cloth.num_width_points, cloth.num_height_points, cloth.thickness) = (6, 6, 0.15);
        cloth.pinned = pins.iter().map(|&(i, j)| [i, j]).collect();
        let mut simulation = Simulation::new(&scene).unwrap();
        let start = simulation.positions().clone();
        run(&mut simulation, 100);
        for (i, j) in pins {
            prop_assert_eq!(simulation.positions().get(j * 6 + i), start.get(j * 6 + i));
        }
        prop_assert!(distance(simulation.positions(), &start) > 0.0, "the others move");
    }

    /// The frequency at rest is that of the matrix, from below; the safe one bounds those of any
    /// configuration.
    #[test]
    fn stability_is_that_of_the_stiffness_matrix(
        points in (2_usize..7, 2_usize..7),
        size in (0.5_f64..2.0, 0.5_f64..2.0),
        kinds in any::<(bool, bool, bool)>(),
        pins in prop::collection::vec((0_usize..6, 0_usize..6), 0..4),
        crumple in 0.0_f64..2.0,
    ) {
        let mut scene = springs_only(points.0, points.1);
        let cloth = cloth(&mut scene);
        (cloth.width, cloth.height) = size;
        (cloth.enable_structural, cloth.enable_shearing, cloth.enable_bending) = kinds;
        cloth.pinned = pins.iter().map(|&(i, j)| [i % points.0, j % points.1]).collect();
        let rest = Simulation::new(&scene).unwrap().positions().clone();
        let stability = Stability::new(scene.cloth.as_ref().unwrap(), &scene.sim).unwrap();
        let [found, safe] = [stability.omega_rest, stability.omega_safe].map(|omega| omega * omega * stability.mass);

        let exact = *eigenvalues(&scene, &rest, &rest).last().unwrap();
        prop_assert!(found <= exact + 1e-6, "at rest {found} N/m, above {exact} N/m");
        prop_assert!(found >= 0.98 * exact - 1e-6, "at rest {found} N/m, well below {exact} N/m");

        let mut x = rest.clone();
        for p in 0..x.len() {
            x.set(p, x.get(p) + Vec3::new(noise(3 * p), noise(3 * p + 1), noise(3 * p + 2)) * crumple);
        }
        let crumpled = *eigenvalues(&scene, &x, &rest).last().unwrap();
        prop_assert!(crumpled <= safe * (1.0 + 1e-9) + 1e-6, "crumpled {crumpled} N/m, above the bound {safe} N/m");
    }
}
