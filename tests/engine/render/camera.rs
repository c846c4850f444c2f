//! The camera is the report's.

use crate::scenes;
use drape::camera::Camera;

/// The figures of the report's viewer at 1024 x 800: eye (0.5, 0.5, 2.3), fields of view 50 and 40.03
/// degrees, and the entries of its projection.
#[test]
fn the_stock_camera_stands_where_the_report_s_does() {
    let camera = Camera::of(&scenes::sphere()).expect("a camera");
    assert_eq!(camera.position, [0.5, 0.5, 2.3]);
    let [x, y, z, t] = camera.view_projection;
    for (found, expected) in [(x[0], 2.144507), (y[1], 2.744969), (z[2], -1.000002), (z[3], -1.0)] {
        assert!((found - expected).abs() < 2e-6, "{found} is not {expected}");
    }
    let target = [0, 1, 2, 3].map(|row| 0.5 * x[row] + 0.5 * y[row] + 0.5 * z[row] + t[row]);
    assert!(target[0].abs() < 1e-6 && target[1].abs() < 1e-6, "the target is in the middle: {target:?}");
    assert!((target[3] - 1.8).abs() < 1e-6, "and 1.8 m away: {target:?}");
}

/// Seen from straight above, the picture's up is where a small tilt leaves it.
#[test]
fn straight_down_is_the_limit_of_a_small_tilt() {
    for azimuth in [0.0, 30.0, 90.0, 200.0] {
        let looking = |polar: f64| {
            let mut scene = scenes::sphere();
            (scene.camera.polar, scene.camera.azimuth) = (polar, azimuth);
            Camera::of(&scene).expect("a camera").view_projection
        };
        for (down, tilted) in [(looking(0.0), looking(1e-4)), (looking(180.0), looking(180.0 - 1e-4))] {
            for (a, b) in down.as_flattened().iter().zip(tilted.as_flattened()) {
                assert!((a - b).abs() < 1e-4, "{down:?} {tilted:?}");
            }
        }
    }
}
