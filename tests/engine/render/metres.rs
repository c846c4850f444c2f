//! Distances along the view axis are those of the rays through the middles of the pixels.

use drape::cloth::Points;
use drape::math::{sin_cos_degrees, tan};
use drape::render::{Options, Renderer};
use drape::scene::{Overrides, load_text};
use drape::texture_source::TextureSource;

const SIDE: u16 = 64;

/// The distances in a picture of `objects`, from the top row on.
fn metres(objects: &str, camera: &str) -> Vec<f32> {
    let text = format!(
        r#"{{{objects}, "material": {{"shader": "normal"}}, "render": {{"size": [{SIDE}, {SIDE}]}},
            "camera": {{"vfov": 40, "hfov": 40, {camera}}}}}"#
    );
    let scene = load_text("metres.json", &text, &Overrides::default()).unwrap().scene;
    let renderer = Renderer::new(&scene, &TextureSource::BuiltIn).unwrap();
    let (points, options) = (Points::default(), Options::default());
    renderer.metres(&renderer.draw(&points, &options).depth, &points, &options)
}

#[test]
fn a_floor_is_as_far_as_its_rays_are_long() {
    for (polar, planes) in
        [(0.0, ""), (30.0, ""), (30.0, r#","near": 0.5, "far": 40"#), (55.0, r#", "near": 1, "far": 6"#)]
    {
        let camera = format!(r#""target": [0, 0, 0], "distance": 3, "polar": {polar}{planes}"#);
        let seen = metres(r#""plane": {"point": [0, 0, 0], "normal": [0, 1, 0], "friction": 0}"#, &camera);
        let (sin, cos) = sin_cos_degrees(polar);
        let slope = tan(f64::to_radians(20.0));
        for (row, distances) in (0..SIDE).zip(seen.chunks(usize::from(SIDE))) {
            let upwards = slope * (1.0 - (2.0 * f64::from(row) + 1.0) / f64::from(SIDE));
            let expected = 3.0 * cos / (cos - sin * upwards);
            let finite = distances.iter().map(|&distance| f64::from(distance)).filter(|d| d.is_finite());
            // The column in the middle is on the floor: 4 metres are wider than what is seen there.
            assert!(distances[usize::from(SIDE) / 2].is_finite() || expected > 4.5, "{polar}: row {row}");
            for distance in finite {
                let error = (distance - expected).abs();
                assert!(error < 1e-4 * expected, "{polar}{planes}: {distance} for {expected} in row {row}");
            }
        }
    }
}

#[test]
fn the_background_is_infinitely_far_and_a_camera_that_fits_has_planes_of_its_own() {
    let cuboid = r#""box": {"origin": [0, 0, 0], "size": [2e-4, 2e-4, 2e-4], "friction": 0}"#;
    let seen = metres(cuboid, r#""fit": true, "near": 10, "far": 20, "polar": 90"#);
    let infinite = seen.iter().filter(|distance| distance.is_infinite()).count();
    assert!(infinite > 100 && infinite < seen.len() - 1000, "{infinite} of {} pixels", seen.len());
    let finite: Vec<f32> = seen.into_iter().filter(|distance| distance.is_finite()).collect();
    // The camera is opposite to a face, which touches the edge of the picture but for a margin of a twentieth.
    let expected = 0.98e-4 / tan(f64::to_radians(20.0)) * 1.05;
    for distance in finite {
        assert!((f64::from(distance) / expected - 1.0).abs() < 0.02, "{distance} for {expected}");
    }
}
