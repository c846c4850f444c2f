//! A cloth on a slope slides by `(g_t - μ g_n) t² / 2` and sticks below `tan θ = μ`, at every step, on every object and
//! under every integrator.

use super::{INTEGRATORS, after, farthest, middle, scene};

/// Gravity of 9.8 m/s² on a floor that is tilted by 30 degrees.
const SLOPE: &str = "sim.gravity=[4.9,-8.487,0]";

/// The floor at the height of the cloth, as each kind of object.
fn floors(friction: f64) -> [String; 3] {
    [
        format!(r#"plane={{"point":[0,1,0],"normal":[0,3,0],"friction":{friction}}}"#),
        format!(r#"box={{"origin":[0,0.5,0],"size":[50,1,50],"friction":{friction}}}"#),
        format!(r#"sphere={{"origin":[0,-99999999,0],"radius":1e8,"friction":{friction}}}"#),
    ]
}

/// How far the cloth slides in 2 s.
fn slide(floor: &str, steps: u32, sets: &[&str]) -> f64 {
    let steps = format!("sim.steps_per_frame={steps}");
    let scene = scene(&[&[SLOPE, floor, &steps], sets].concat());
    let moved = middle(after(&scene, 2.0).positions());
    assert!((moved.y - 1.0).abs() < 1e-6 && (moved.z - 0.5).abs() < 1e-5, "on the floor: {moved}");
    moved.x - 0.5
}

#[test]
fn a_slide_is_that_of_coulombs_law_at_every_step() {
    for (friction, expected) in [(0.0, 9.8), (0.5, 1.313), (0.57, 0.5 * (4.9 - 0.57 * 8.487) * 4.0)] {
        for floor in floors(friction) {
            for steps in [1, 10, 30, 120] {
                let found = slide(&floor, steps, INTEGRATORS[0]);
                // The surface of the ball is rounded to 1.5e-8 m, and with it the normal impulse of each step.
                let bound = if floor.starts_with("sphere") { 1e-4 } else { 1e-6 };
                assert!(
                    (found - expected).abs() < bound,
                    "{floor}, {steps} steps: {found} m, not {expected}"
                );
            }
        }
    }
}

#[test]
fn every_integrator_slides_alike() {
    for sets in INTEGRATORS {
        for (friction, expected) in [(0.0, 9.8), (0.5, 1.313)] {
            let error = |steps| (slide(&floors(friction)[0], steps, sets) - expected).abs() / expected;
            let (coarse, fine) = (error(10), error(40));
            // First order: implicit schemes begin with the speed of a whole step, as the report's start does.
            assert!(coarse < 1.2e-3 && fine < 3e-4, "{sets:?}, friction {friction}: {coarse:e}, {fine:e}");
        }
    }
}

/// `tan θ` = 0.5774: a coefficient of 0.6 holds the cloth.
#[test]
fn a_cloth_below_the_angle_of_friction_stays_where_it_is() {
    for sets in INTEGRATORS {
        for floor in floors(0.6) {
            let steps = if sets.len() > 1 { "sim.steps_per_frame=10" } else { "sim.steps_per_frame=30" };
            let scene = scene(&[&[SLOPE, &floor, steps], sets].concat());
            let moved = farthest(&after(&scene, 10.0), &scene);
            assert!(moved < 1e-6, "{floor}, {sets:?}: {moved:e} m in 10 s");
        }
    }
}

/// The slope is a tilted plane under upright gravity, and the cloth lands on it.
#[test]
fn a_tilted_plane_is_a_slope() {
    let plane = |friction: f64| {
        format!(
            r#"plane={{"point":[0.5,0.9999999,0.5],"normal":[0.5,0.8660254037844386,0],"friction":{friction}}}"#
        )
    };
    for (friction, acceleration) in [(0.0, 4.9), (0.3, 4.9 - 0.3 * 9.8 * 0.866_025_403_784_438_6)] {
        let mut moved = Vec::new();
        for steps in [10, 40] {
            let steps = format!("sim.steps_per_frame={steps}");
            // So small that all of it lies on the slope at once.
            let small = ["cloth.width=1e-7", "cloth.height=1e-7", "cloth.offset=[0.5,0,0.5]", "cloth.ks=0"];
            let scene = scene(&[&small[..], &[&steps, &plane(friction), "sim.start=half_step"]].concat());
            let x = middle(after(&scene, 1.0).positions());
            moved.push((x - nalgebra::Vector3::new(0.5, 1.0, 0.5)).norm() / (0.5 * acceleration));
        }
        assert!(moved.iter().all(|part| (part - 1.0).abs() < 2e-3), "friction {friction}: {moved:?}");
    }
}
