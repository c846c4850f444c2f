//! Numbers are read exactly, and patches and sets change a scene in their order.

use std::fs;

use drape::scene::{Camera, Cloth, Orientation, Overrides, Scene, Sim, load};

use super::values::{empty, stock_cloth, with};

#[test]
fn numbers_are_the_nearest_binary64() {
    // Bits from an independent correctly rounding reader.
    let cases = [
        ("0.0095", 0x3f83_74bc_6a7e_f9db),
        ("0.1", 0x3fb9_9999_9999_999a),
        ("1.00000000000000011102230246251565404236316680908203125", 0x3ff0_0000_0000_0000),
        ("1.00000000000000011102230246251565404236316680908203126", 0x3ff0_0000_0000_0001),
        ("123456.7890123456789012345678901234567890", 0x40fe_240c_9fcb_68cd),
        ("2.2250738585072011e-308", 0x000f_ffff_ffff_ffff),
        ("5e-324", 1),
        ("1e-999", 0),
        ("-0", 0x8000_0000_0000_0000),
        ("6.02214076e14", 0x4301_1daf_20a1_3800),
        ("300e-2", 0x4008_0000_0000_0000),
        ("720575940379279.36", 0x4304_7ae1_47ae_147b),
    ];
    for (text, bits) in cases {
        let scene = with(&format!("{{\"sim\": {{\"gravity\": [0, {text}, 0]}}}}"), &[]);
        assert_eq!(scene.sim.gravity.y.to_bits(), bits, "{text}: {:#x}", scene.sim.gravity.y.to_bits());
        let set = with("{}", &[&format!("sim.gravity=[0,{text},0]")]);
        assert_eq!(set.sim.gravity.y.to_bits(), bits, "--set {text}");
    }
}

#[test]
fn whole_numbers_may_be_written_with_a_point_or_an_exponent() {
    let text = fs::read_to_string(crate::repository::path("scenes/pinned2.json")).unwrap();
    let sets = [
        "cloth.num_width_points=50.0",
        "cloth.orientation=1.0",
        "cloth.pinned=[[-0,4.9e1]]",
        "render.samples=40e-1",
    ];
    let scene = with(&text, &sets);
    let cloth = scene.cloth.unwrap();
    assert_eq!((cloth.num_width_points, cloth.orientation), (50, Orientation::Vertical));
    assert_eq!((cloth.pinned, scene.render.samples), (vec![[0, 49]], 4));
}

#[test]
fn patches_come_first_then_sets_each_in_order() {
    let folder = tempfile::tempdir().unwrap();
    let patch = |name: &str, text: &str| {
        let path = folder.path().join(name);
        fs::write(&path, text).unwrap();
        path
    };
    let patches = vec![
        patch("a.json", r#"{"cloth": {"ks": 1, "density": 1, "damping": 1, "pinned": null}, "plane": null}"#),
        patch("b.json", r#"{"cloth": {"density": 2, "damping": 2}, "camera": {"polar": 60}}"#),
    ];
    let sets = vec!["cloth.damping=3".into(), "cloth.damping=4".into(), "sim.stretch_limit=null".into()];
    let scene = load(
        &crate::repository::path("scenes/plane.json"),
        &Overrides { patches, sets, ..Overrides::default() },
    )
    .unwrap()
    .scene;
    let cloth = Cloth { ks: 1.0, density: 2.0, damping: 4.0, ..stock_cloth() };
    let sim = Sim { stretch_limit: None, ..empty().sim };
    let camera = Camera { polar: 60.0, ..empty().camera };
    assert_eq!(scene, Scene { cloth: Some(cloth), sim, camera, ..empty() });
}

#[test]
fn sets_reach_one_object_and_lists_of_objects() {
    let one = fs::read_to_string(crate::repository::path("scenes/sphere.json")).unwrap();
    let other = r#"{"origin": [0, 0, 0], "radius": 1, "friction": 0}"#;
    let list = format!("{{\"sphere\": [{other}]}}");
    let two = format!("{{\"sphere\": [{other}, {other}]}}");
    let radii = |text: &str, set: &str| -> Vec<f64> {
        with(text, &[set]).spheres().map(|sphere| sphere.radius).collect()
    };
    assert_eq!(radii(&one, "sphere.radius=3"), [3.0]);
    assert_eq!(radii(&one, "sphere.0.radius=3"), [3.0]);
    assert_eq!(radii(&list, "sphere.radius=3"), [3.0]);
    assert_eq!(radii(&list, "sphere.0.radius=3"), [3.0]);
    assert_eq!(radii(&two, "sphere.1.radius=3"), [1.0, 3.0]);
    assert_eq!(radii(&two, "sphere.0.origin.1=3"), [1.0, 1.0]);
    assert_eq!(radii(&two, "sphere=[]"), [0.0; 0]);
}
