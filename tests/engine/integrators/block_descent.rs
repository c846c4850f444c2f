//! Implicit Euler solved a second way.

use drape::cloth::Points;
use drape::scene::{Integrator, Vec3};
use drape::simulation::Simulation;

use super::{G, hanging, rms};

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
