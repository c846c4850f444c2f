//! Contact at the ends of every range.

use super::{after, farthest, middle, scene};

const SLOPE: &str = "sim.gravity=[4.9,-8.487,0]";

#[test]
fn friction_from_0_to_1e15() {
    for (friction, expected) in [("0", 9.8), ("1", 0.0), ("1e15", 0.0)] {
        let floor = format!(r#"plane={{"point":[0,1,0],"normal":[0,1,0],"friction":{friction}}}"#);
        let scene = scene(&[SLOPE, &floor, "sim.start=half_step"]);
        let moved = farthest(&after(&scene, 2.0), &scene);
        assert!((moved - expected).abs() < 1e-9, "friction {friction}: {moved} m");
    }
}

/// Far from the origin a position has few digits: a slide is right to the rounding of its steps.
#[test]
fn far_from_the_origin_a_slide_is_right_to_rounding() {
    for (far, bound) in [(1e3, 1e-6), (1e6, 1e-4), (1e9, 1.0)] {
        let floor = format!(r#"plane={{"point":[{far},{far},0],"normal":[0,1,0],"friction":0.5}}"#);
        let offset = format!("cloth.offset=[{far},{},0]", far - 1.0);
        let scene = scene(&[SLOPE, &floor, &offset, "sim.start=half_step", "sim.steps_per_frame=3"]);
        let moved = middle(after(&scene, 2.0).positions()).x - far - 0.5;
        assert!((moved - 1.313).abs() < bound, "at {far} m: {moved} m");
    }
}

/// A ball of 1e9 m has a surface that is known to 1e-7 m: what lies on it stays within that.
#[test]
fn a_ball_of_1e9_m_is_a_floor() {
    let floor = r#"sphere={"origin":[0,-999999999,0],"radius":1e9,"friction":0.6}"#;
    let scene = scene(&[floor, "sim.start=half_step"]);
    let end = after(&scene, 2.0);
    let moved = farthest(&end, &scene);
    assert!(moved < 1e-6 && end.energy().kinetic < 1e-9, "{moved:e} m, {:?}", end.energy());
}
