//! The stiffness of a cloth is that of its springs: a strip of the same stuff sags less, the more columns it has.

use drape::scene::{Overrides, load_text};
use drape::simulation::Simulation;

/// How far the lower edge of the strip of `docs/scene.md` sinks, in metres.
fn sag(columns: usize) -> f64 {
    let pins: Vec<[usize; 2]> = (0..columns).map(|i| [i, 20]).collect();
    let text = format!(
        r#"{{"cloth": {{"width": 0.2, "height": 1, "num_width_points": {columns}, "num_height_points": 21, "thickness": 0.001,
            "orientation": 1, "pinned": {pins:?}, "damping": 1, "density": 150, "ks": 5000, "enable_structural": true,
            "enable_shearing": false, "enable_bending": false}},
            "sim": {{"stretch_limit": null, "self_collision": "off"}}}}"#
    );
    let scene = load_text("strip.json", &text, &Overrides::default()).unwrap().scene;
    let mut simulation = Simulation::new(&scene).unwrap();
    (0..270).for_each(|_| simulation.advance_frame().unwrap());
    -simulation.positions().y[0]
}

#[test]
fn a_strip_sags_by_what_the_page_says() {
    let page = std::fs::read_to_string(crate::repository::path("docs/scene.md")).unwrap();
    for columns in [3, 17] {
        // Each row of springs carries what hangs below it.
        let expected = 0.2 * 150.0 * 9.8 * 10.0 / (5000.0 * columns as f64);
        let found = sag(columns);
        assert!((found - expected).abs() < 5e-3 * expected, "{columns}: {found} instead of {expected}");
        assert!(page.contains(&format!("{expected:.3} m with {columns}")), "{expected}");
    }
}
