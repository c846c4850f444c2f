//! A step that is too short for the positions is told before the first one, and no other.

#![expect(clippy::unwrap_used, reason = "a test may panic")]

use crate::scenes;
use drape::math::powi;
use drape::scene::{Cloth, Integrator, Precision, Scene, SelfCollision, Sim, Start, Vec3};
use drape::simulation::Simulation;

/// Steps of each fall.
const STEPS: u32 = 1000;

/// A cloth of 2 x 2 points that falls freely in steps of 1 / `rate` seconds.
fn falling(integrator: Integrator, precision: Precision, rate: f64) -> Scene {
    let cloth = Cloth { num_width_points: 2, num_height_points: 2, damping: 0.0, ..scenes::cloth() };
    let start = if integrator == Integrator::Verlet { Start::HalfStep } else { Start::Report };
    let off = SelfCollision::Off;
    let sim = Sim {
        fps: rate / f64::from(STEPS),
        steps_per_frame: STEPS,
        integrator,
        precision,
        start,
        ..Sim::default()
    };
    Scene { sim: Sim { self_collision: off, stretch_limit: None, ..sim }, ..scenes::with_cloth(cloth) }
}

/// Whether a fall of a frame is told to be lost, how far it is in metres, and by what part of it a point is off at the
/// end.
fn told_and_off(scene: &Scene) -> (bool, f64, f64) {
    let mut simulation = Simulation::new(scene).unwrap();
    simulation.allow_unstable();
    let time = 1.0 / scene.sim.fps;
    let told = simulation.unresolved(time).is_some();
    let start = simulation.positions().y[0];
    simulation.advance_frame().unwrap();
    let fall = 0.5 * scene.sim.gravity.norm() * time * time;
    (told, fall, ((start - simulation.positions().y[0]) / fall - 1.0).abs())
}

/// Over steps from 1 ms to 0.2 ns: a fall that is not told to be lost is right, but for what no number at the height of
/// 1 m shows, and one that is told is off by rounding.
#[test]
fn a_fall_that_rounding_takes_is_told() {
    let kinds = [
        (Integrator::Verlet, Precision::F64),
        (Integrator::Verlet, Precision::F32),
        (Integrator::Rk4, Precision::F64),
        (Integrator::Xpbd, Precision::F64),
        (Integrator::ImplicitEuler, Precision::F64),
        (Integrator::Bdf2, Precision::F64),
    ];
    for (integrator, precision) in kinds {
        let number = if precision == Precision::F32 { f64::from(f32::EPSILON) } else { f64::EPSILON };
        let mut counts = [0, 0];
        for quarter in 0..28 {
            let rate = 1e3 * powi(10.0_f64.sqrt().sqrt(), quarter, 1.0);
            let scene = falling(integrator, precision, rate);
            let (told, fall, off) = told_and_off(&scene);
            let name = format!("{integrator:?} {precision:?} {rate:.1e}: told {told}, off by {off:.1e}");
            assert!(told || off < 0.02 || fall < number, "{name}");
            assert!(!told || off > 3e-4, "{name}");
            counts[usize::from(told)] += 1;
        }
        assert!(counts[0] > 5 && counts[1] > 1, "{integrator:?} {precision:?}: {counts:?}");
    }
}

/// Gravity that is lost is told only where it would show beside the velocity and the rest of gravity.
#[test]
fn what_would_not_show_is_not_told() {
    let mut scene = falling(Integrator::Verlet, Precision::F64, 1e9);
    assert!(told_and_off(&scene).0);
    // In a microsecond gravity moves it by 4.9 pm, and 1 mm/s by 1 nm.
    scene.cloth.as_mut().unwrap().velocity = Vec3::new(0.0, 0.0, 1e-3);
    assert!(!told_and_off(&scene).0);
    scene.cloth.as_mut().unwrap().velocity = Vec3::new(0.0, 0.0, 1e-4);
    assert!(told_and_off(&scene).0, "4.9 pm show beside 100 pm");

    let mut scene = falling(Integrator::Verlet, Precision::F64, 1e6);
    scene.sim.gravity = Vec3::new(1e-7, -9.8, 0.0);
    assert!(!told_and_off(&scene).0);
}
