//! What is known exactly of the discrete equations.

use drape::cloth::damping_rate;
use drape::math::{atan2, cos, powi};
use drape::scene::{Damping, Integrator, Scene, Vec3};
use drape::simulation::Simulation;

use super::{ALL, G, OTHERS, falling, hanging};

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
            Integrator::Rk4 => {
                let square = mu * mu;
                times(y, [1.0 - square / 2.0 + square * square / 24.0, mu * square / 6.0 - mu])
            }
            Integrator::Xpbd | Integrator::ImplicitEuler => euler,
            Integrator::Bdf2 if k == 0 => euler,
            Integrator::Bdf2 => over(numerator, [1.0, 2.0 / 3.0 * mu]),
        };
        y[0]
    };
    (0..steps).map(next).collect()
}

/// Two crossed springs, of which the one between (0, 0) and (1, 1) has a free end.
pub(super) fn one_spring(integrator: Integrator, ks: f64) -> Scene {
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
            if matches!(integrator, Integrator::Verlet | Integrator::Rk4) && mu > 2.0 {
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

/// Without springs in the way: symplectic and implicit Euler fall by `g h² k (k + 1) / 2`, Runge-Kutta by `g t² / 2`.
#[test]
fn free_fall_is_the_exact_discrete_one() {
    let h = 1.0 / 2700.0;
    for integrator in OTHERS {
        let mut simulation = Simulation::new(&falling(integrator)).unwrap();
        let (mut y, mut last, mut v, mut v_last) = (0.0, 0.0, 0.0, 0.0);
        for k in 0..900_i32 {
            simulation.step();
            let (v_next, y_next) = match integrator {
                Integrator::Bdf2 if k > 0 => {
                    let v_next = (4.0 * v - v_last) / 3.0 - 2.0 / 3.0 * h * G;
                    (v_next, (4.0 * y - last) / 3.0 + 2.0 / 3.0 * h * v_next)
                }
                Integrator::Rk4 => (v - h * G, y + h * (v - 0.5 * h * G)),
                _ => (v - h * G, y + h * (v - h * G)),
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
/// at `g h / d`, `g h / (d + d² / 2)` for the second-order formula, and `g h (1 / d - 1 / 2)` for Runge-Kutta.
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
                (_, Integrator::Rk4) => G / 2700.0 * (1.0 / d - 0.5),
                _ => G / 2700.0 / d,
            };
            let speed = simulation.extremes().speed;
            assert!((speed / expected - 1.0).abs() < 1e-6, "{integrator:?} {damping:?}: {speed}, {expected}");
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
