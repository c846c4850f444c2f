//! Order of convergence, and figures that others published.

use drape::math::ln;
use drape::scene::{Damping, Integrator, Precision, Start};

use super::{ALL, end, hanging, rms};

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
