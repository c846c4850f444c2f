//! Nothing passes through an object, however fast, thin or crowded.

use drape::scene::Vec3;

use crate::scenes::colliders::depth_in_any;

use super::{after, middle, scene, simulation};

/// A cloth that flies at 1e4 m/s, 3.7 m in a step, at something that is 1 cm thick ends at its near side.
#[test]
fn a_fast_cloth_stops_at_a_thin_object() {
    let objects = [
        r#"sphere={"origin":[0.5,-7,0.5],"radius":0.005,"friction":1e15}"#,
        r#"box={"origin":[0.5,-7,0.5],"size":[2,0.01,2],"friction":1e15}"#,
        r#"plane={"point":[0.5,-7,0.5],"normal":[0,1,0],"friction":1e15}"#,
    ];
    for object in objects {
        for side in [1.0, -1.0] {
            let velocity = format!("cloth.velocity=[0,{},0]", -1e4 * side);
            let offset = format!("cloth.offset=[0,{},0]", 8.0 * side - 8.0);
            // One point of 2 x 2 flies at the middle of the object.
            let corner = [
                "cloth.num_width_points=2",
                "cloth.num_height_points=2",
                "sim.gravity=[0,0,0]",
                "cloth.ks=0",
            ];
            let sets =
                [&corner[..], &[object, &velocity, &offset, "cloth.width=0.5", "cloth.height=0.5"]].concat();
            let end = after(&scene(&sets), 0.1);
            let x = end.positions().get(3);
            let half = if object.starts_with("plane") { 0.0 } else { 0.005 };
            assert!(
                (x - Vec3::new(0.5, -7.0 + half * side, 0.5)).norm() < 1e-9,
                "{object}, side {side}: {x}"
            );
            let last = end.last_positions().get(3);
            assert!((x - last).norm() < 1e-12, "{object}, side {side}: at rest");
        }
    }
}

/// A ball in the corner of floor and wall: what slides into the wedge between them stays outside of all three.
#[test]
fn objects_that_overlap_let_nothing_in() {
    let objects = [
        r#"plane=[{"point":[0,0,0],"normal":[0,1,0],"friction":0.2},{"point":[1.5,0,0],"normal":[-2,0,0],"friction":0}]"#,
        r#"sphere=[{"origin":[0.5,0.1,0.5],"radius":0.3,"friction":0.3},{"origin":[0.8,0.2,0.5],"radius":0.3,"friction":0.3}]"#,
        r#"box={"origin":[1.2,0.1,0.5],"size":[0.4,0.4,2],"friction":0.4}"#,
    ];
    let size = ["cloth.num_width_points=24", "cloth.num_height_points=24", "sim.stretch_limit=0.1"];
    for velocity in ["cloth.velocity=[0,0,0]", "cloth.velocity=[20,-50,0]", "cloth.velocity=[1e4,-1e4,1e3]"] {
        let scene = scene(&[&objects[..], &size, &[velocity, "cloth.damping=0.2", "sim.fps=60"]].concat());
        let mut simulation = simulation(&scene);
        for _ in 0..60 {
            simulation.advance_frame().unwrap();
            let x = simulation.positions();
            for x in (0..x.len()).map(|p| x.get(p)) {
                let depth = depth_in_any(&scene.colliders, x);
                assert!(depth < 1e-9, "{velocity}, frame {}: {depth:e} m inside at {x}", simulation.frame());
            }
        }
    }
}

/// Free fall onto the floor ends there at the right time, without a rebound, and stays at the height of the floor.
#[test]
fn a_fall_ends_on_the_floor_without_a_rebound() {
    for steps in [10, 30, 1000] {
        let steps = format!("sim.steps_per_frame={steps}");
        let floor = r#"plane={"point":[0,0,0],"normal":[0,1,0],"friction":0}"#;
        let scene = scene(&[&steps, floor, "sim.start=half_step", "cloth.ks=0"]);
        let mut simulation = simulation(&scene);
        let landing = (2.0_f64 / 9.8).sqrt();
        for _ in 0..90 {
            simulation.advance_frame().unwrap();
            let (y, t) = (middle(simulation.positions()).y, simulation.time());
            let expected = if t < landing { 1.0 - 4.9 * t * t } else { 0.0 };
            assert!((y - expected).abs() < 1e-8, "{steps}, {t} s: {y} m, not {expected}");
        }
        assert!(simulation.energy().kinetic < 1e-20, "{steps}: {:?}", simulation.energy());
    }
}

/// A cloth over the edge of a box hangs around it: no point is inside, and the edge carries it.
#[test]
fn a_box_carries_a_cloth_over_its_corner() {
    let object = r#"box={"origin":[0.8,0.5,0.8],"size":[0.8,0.8,0.8],"friction":0.5}"#;
    let size = ["cloth.num_width_points=20", "cloth.num_height_points=20", "cloth.damping=1"];
    let end = after(&scene(&[&size[..], &[object, "sim.stretch_limit=0.1"]].concat()), 3.0);
    let x = end.positions();
    let mut on_top = 0;
    for x in (0..x.len()).map(|p| x.get(p)) {
        let e = (x - Vec3::new(0.8, 0.5, 0.8)).abs();
        assert!(e.amax() >= 0.4, "inside at {x}");
        on_top += usize::from((x.y - 0.9).abs() < 1e-6);
    }
    assert!(
        (100..300).contains(&on_top) && end.energy().kinetic < 1.0,
        "{on_top} on top, {:?}",
        end.energy()
    );
}
