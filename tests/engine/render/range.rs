//! What is seen does not depend on where the world's origin is, and a camera can be told to frame what there is.

use drape::cloth::Points;
use drape::render::{Options, Picture, Renderer};
use drape::scene::{Overrides, Scene, load_text};
use drape::simulation::Simulation;
use drape::texture_source::TextureSource;

/// A ball, a floor and a light around a place on the x axis, seen by the camera from there.
fn around(x: f64, more: &str) -> (Scene, usize) {
    let text = format!(
        r#"{{"sphere": {{"origin": [{x}, 0.5, 0], "radius": 0.4, "friction": 0.3}},
            "plane": {{"point": [{x}, 0, 0], "normal": [0, 1, 0], "friction": 0.3}},
            "light": {{"position": [{}, 2, 1]}}, "material": {{"shader": "bump", "normal_scaling": 60}},
            "camera": {{"target": [{x}, 0.5, 0], "distance": 2, "polar": 75{more}}}, "render": {{"size": [200, 160]}}}}"#,
        x + 1.0
    );
    let loaded = load_text("around.json", &text, &Overrides::default()).unwrap();
    (loaded.scene, loaded.warnings.len())
}

fn draw(scene: &Scene) -> Picture {
    let points = Simulation::new(scene).map(|simulation| simulation.positions().clone()).unwrap_or_default();
    Renderer::new(scene, &TextureSource::BuiltIn)
        .unwrap()
        .draw(&points, &Options { ids: true, ..Options::default() })
}

/// Pixels with a channel that differs by more than 8 levels.
fn apart(a: &Picture, b: &Picture) -> usize {
    let pixels = a.rgb.chunks(3).zip(b.rgb.chunks(3));
    pixels.filter(|(a, b)| (0..3).any(|c| a[c].abs_diff(b[c]) > 8)).count()
}

#[test]
fn a_picture_is_the_same_wherever_its_scene_is() {
    let here = draw(&around(0.0, "").0);
    assert!(here.stats.covered > 5000, "{}", here.stats.covered);
    for x in [500.0, 513.0, 1e4, 1e6, 1e7, 1e9] {
        let there = draw(&around(x, "").0);
        let apart = apart(&here, &there);
        assert!(apart <= 20, "{apart} pixels at x = {x}");
    }
}

/// A camera that fits goes to the things, and what `camera.target` and `camera.distance` say then has no effect.
#[test]
fn a_camera_that_fits_shows_the_same_wherever_the_scene_is() {
    let at = |[x, y, z]: [f64; 3], objects: &str, more: &str| {
        let text = format!(
            r#"{{{}, "material": {{"shader": "normal"}}, "render": {{"size": [120, 96]}},
                "camera": {{"fit": true, "polar": 65, "azimuth": 25{more}}}}}"#,
            objects.replace("PLACE", &format!("[{x}, {y}, {z}]"))
        );
        draw(&load_text("there.json", &text, &Overrides::default()).unwrap().scene)
    };
    let cloth = r#""cloth": {"width": 1, "height": 0.7, "num_width_points": 8, "num_height_points": 6, "thickness": 0,
        "orientation": 0, "damping": 0, "density": 150, "ks": 5000, "enable_structural": true,
        "enable_shearing": true, "enable_bending": true, "offset": PLACE}"#;
    let cuboid = r#""box": {"origin": PLACE, "size": [0.8, 0.5, 0.6], "friction": 0}"#;
    let ball = r#""sphere": {"origin": PLACE, "radius": 0.4, "friction": 0}"#;
    let on_a_floor =
        format!(r#"{cuboid}, "plane": {{"point": [0, 0, 0], "normal": [0, 1, 0], "friction": 0}}"#);
    for objects in [cloth, cuboid, ball, &on_a_floor] {
        let here = at([0.0; 3], objects, "");
        assert!(here.stats.covered > 1000, "{objects}: {}", here.stats.covered);
        for place in [[1e6, 0.0, 0.0], [0.0, 1e7, 0.0], [0.0, 0.0, -1e7], [1e7, -1e7, 1e7]] {
            for more in ["", r#", "target": [0, 3, 0], "distance": 1e9"#] {
                // Seen alone: a floor at the origin is not at the other places.
                let [here, there] = [[0.0; 3], place]
                    .map(|place| at(place, objects.split(", \"plane\"").next().unwrap(), more));
                let apart = apart(&here, &there);
                assert!(apart <= 20, "{objects}{more} at {place:?}: {apart} pixels");
                assert!(at(place, objects, more).stats.covered > 1000, "{objects} at {place:?}");
            }
        }
    }
}

/// A cloth that is far away from the origin of its own camera is no reason to move anything.
#[test]
fn near_the_origin_nothing_is_moved() {
    for (x, moved) in [(0.0, false), (511.0, false), (513.0, true)] {
        let origin = drape::camera::origin(&around(x, "").0).unwrap();
        assert_eq!(origin.norm() > 0.0, moved, "{x}");
    }
}

#[test]
fn planes_between_which_nothing_can_be_told_apart_are_warned_of() {
    let warnings = |more: &str| {
        let text = format!(
            r#"{{"sphere": {{"origin": [0, 0, 0], "radius": 1, "friction": 0}}, "camera": {{{more}}}}}"#
        );
        load_text("x.json", &text, &Overrides::default()).unwrap().warnings
    };
    for (more, part, fits) in [
        (r#""distance": 4000"#, "told apart only in steps of 9.5e1 m", "camera.near=4"),
        (r#""near": 1e-8"#, "told apart only in steps", "camera.near=0.002"),
        (r#""distance": 2, "near": 3"#, "before the near plane", "camera.near=0.002"),
        (r#""distance": 20000, "near": 20"#, "behind the far plane", "camera.far=200000"),
    ] {
        let found = warnings(more);
        assert!(found.len() == 1 && found[0].message.contains(part), "{more}: {found:?}");
        assert!(found[0].help.contains(fits), "{more}: {}", found[0].help);
    }
    for fine in ["", r#""distance": 100"#, r#""near": 0.5, "distance": 5"#, r#""distance": 4000, "near": 4"#]
    {
        assert_eq!(warnings(fine), [], "{fine}");
    }
    // What is advised shows the nearer ball.
    let balls = |near: &str| {
        let text = format!(
            r#"{{"sphere": [{{"origin": [0, 0, 0], "radius": 495, "friction": 0}}, {{"origin": [0, 0, 0], "radius": 500, "friction": 0}}],
                "camera": {{"target": [0, 0, 0], "distance": 4000, "near": {near}}}, "render": {{"size": [120, 100]}}}}"#
        );
        let picture = draw(&load_text("x.json", &text, &Overrides::default()).unwrap().scene);
        picture.ids.iter().filter(|&&id| id >> 24 == 1).count()
    };
    assert!(balls("0.01") > 100 && balls("4") == 0, "{} and {}", balls("0.01"), balls("4"));
}

/// First and last column and row with an object, as parts of the picture.
fn frame(picture: &Picture) -> [f64; 4] {
    let [width, height] = [picture.width as usize, picture.height as usize];
    let seen: Vec<[usize; 2]> =
        (0..width * height).filter(|&i| picture.ids[i] != 0).map(|i| [i % width, i / width]).collect();
    let part = |axis: usize, of: usize| {
        let all = || seen.iter().map(|place| place[axis]);
        [all().min().unwrap() as f64 / of as f64, 1.0 - (all().max().unwrap() + 1) as f64 / of as f64]
    };
    let ([left, right], [top, bottom]) = (part(0, width), part(1, height));
    [left, right, top, bottom]
}

#[test]
fn a_camera_that_fits_shows_all_there_is_and_little_else() {
    for (scene, frames) in [("sphere", 60), ("pinned2", 40), ("pinned4", 40)] {
        for (polar, size) in [(90, "[200,160]"), (35, "[100,200]"), (0, "[300,100]"), (140, "[128,128]")] {
            let path = crate::repository::path("scenes").join(format!("{scene}.json"));
            let sets = [
                "camera.fit=true".to_owned(),
                format!("camera.polar={polar}"),
                format!("render.size={size}"),
            ];
            let overrides = Overrides { sets: sets.to_vec(), ..Overrides::default() };
            let mut scene = drape::scene::load(&path, &overrides).unwrap().scene;
            // A plane has no end.
            scene.colliders.retain(|collider| matches!(collider, drape::scene::Collider::Sphere(_)));
            let mut simulation = Simulation::new(&scene).unwrap();
            (0..frames).for_each(|_| simulation.advance_frame().unwrap());
            let renderer = Renderer::new(&scene, &TextureSource::BuiltIn).unwrap();
            let picture = renderer.draw(simulation.positions(), &Options { ids: true, ..Options::default() });
            let sides = frame(&picture);
            let narrowest = sides.into_iter().fold(1.0, f64::min);
            assert!(narrowest > 0.0 && narrowest < 0.06, "{path:?} from {polar} in {size}: {sides:?}");
        }
    }
}

#[test]
fn a_camera_that_fits_finds_what_is_small_far_or_flat() {
    for text in [
        r#""sphere": {"origin": [1e6, 7, -3], "radius": 1e-3, "friction": 0}"#,
        r#""sphere": {"origin": [0, 0, 0], "radius": 1e6, "friction": 0}"#,
        r#""plane": {"point": [5, 5, 5], "normal": [0, 1, 1], "friction": 0}"#,
    ] {
        let text = format!(r#"{{{text}, "camera": {{"fit": true}}, "render": {{"size": [100, 80]}}}}"#);
        let scene = load_text("x.json", &text, &Overrides::default()).unwrap().scene;
        let renderer = Renderer::new(&scene, &TextureSource::BuiltIn).unwrap();
        let picture = renderer.draw(&Points::default(), &Options { ids: true, ..Options::default() });
        let sides = frame(&picture);
        let narrowest = sides.into_iter().fold(1.0, f64::min);
        assert!(narrowest > 0.0 && narrowest < 0.08, "{text}: {sides:?}");
    }
}
