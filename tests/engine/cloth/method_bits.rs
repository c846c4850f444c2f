//! The simulation agrees in every bit with the published method.
//!
//! The textbook cloth is the method a second time, which shares no code with the library. Random small scenes and the
//! five stock scenes are run by both, for up to 1000 frames.

#![expect(clippy::unwrap_used, reason = "a test may panic")]

use crate::scenes;
use crate::textbook_cloth::Cloth;
use drape::cloth::Points;
use drape::math::{StateHash, splitmix64};
use drape::scene::{Collider, Orientation, Plane, Scene, SelfCollision, Sphere, Vec3};
use drape::simulation::Simulation;
use proptest::prelude::*;

/// Whether all bits are those of `simulation`.
fn equals(cloth: &Cloth, simulation: &Simulation) -> Result<(), String> {
    for p in 0..cloth.x.len() {
        let theirs = [simulation.positions().get(p), simulation.last_positions().get(p)];
        for (ours, theirs) in [cloth.x[p], cloth.last[p]].into_iter().zip(theirs.map(|v| [v.x, v.y, v.z])) {
            if ours.map(f64::to_bits) != theirs.map(f64::to_bits) {
                return Err(format!("point {p}: {ours:?} by the method, {theirs:?} here"));
            }
        }
    }
    Ok(())
}

/// Runs both for `steps` steps and compares all bits after each, up to where a position stops
/// being finite: there the method ends. With `snap` the points start on a lattice of that pitch, in
/// metres, so that some meet and many lie on the border of a box.
fn agree(scene: &Scene, steps: u64, snap: Option<f64>) -> Result<(), String> {
    let mut simulation = Simulation::new(scene).map_err(|error| error.to_string())?;
    let mut cloth = Cloth::new(scene);
    if let Some(pitch) = snap {
        let mut start = simulation.positions().clone();
        for p in 0..start.len() {
            start.set(p, start.get(p).map(|value| (value / pitch).round() * pitch + 0.0));
            (cloth.x[p], cloth.last[p]) = (start.get(p).into(), start.get(p).into());
        }
        simulation.set_state(start.clone(), start).map_err(|error| error.to_string())?;
    }
    for step in 0..=steps {
        equals(&cloth, &simulation).map_err(|difference| format!("step {step}, {difference}"))?;
        simulation.step();
        cloth.step();
        if !cloth.x.iter().flatten().all(|value| value.is_finite()) {
            break;
        }
    }
    Ok(())
}

prop_compose! {
    fn vector(size: f64)(x in -size..size, y in -size..size, z in -size..size) -> Vec3 {
        Vec3::new(x, y, z)
    }
}

prop_compose! {
    fn any_cloth()(
        points in prop_oneof![4 => (2_usize..9, 2_usize..9), 1 => (9_usize..40, 2_usize..5)],
        size in (0.05_f64..2.0, 0.05_f64..2.0),
        vertical in any::<bool>(),
        kinds in any::<(bool, bool, bool)>(),
        pins in prop::collection::vec((0_usize..9, 0_usize..9), 0..6),
        damping in prop_oneof![Just(0.0), Just(0.2), Just(100.0), 0.0..20.0],
        ks in prop_oneof![Just(0.0), Just(5000.0), 1.0..20_000.0],
        thickness in prop_oneof![Just(0.0), 0.0..0.3],
        density in prop_oneof![Just(150.0), 5.0..500.0],
    ) -> drape::scene::Cloth {
        drape::scene::Cloth {
            width: size.0,
            height: size.1,
            num_width_points: points.0,
            num_height_points: points.1,
            thickness,
            orientation: if vertical { Orientation::Vertical } else { Orientation::Horizontal },
            offset: Vec3::zeros(),
            velocity: Vec3::zeros(),
            pinned: pins.iter().map(|&(i, j)| [i % points.0, j % points.1]).collect(),
            damping,
            density,
            ks,
            enable_structural: kinds.0,
            enable_shearing: kinds.1,
            enable_bending: kinds.2,
            material: scenes::material(),
        }
    }
}

prop_compose! {
    fn any_plane()(
        point in vector(1.0), normal in vector(3.0), friction in 0.0_f64..=1.0, floor in any::<bool>(),
    ) -> Plane {
        let point = if floor { Vec3::zeros() } else { point };
        let normal = if floor { Vec3::new(0.0, 1.0, 0.0) } else { normal + Vec3::new(0.0, 3.5, 0.0) };
        Plane { point, normal, friction, material: scenes::material() }
    }
}

prop_compose! {
    fn any_sphere()(origin in vector(1.0), radius in 0.05_f64..1.0, friction in 0.0_f64..=1.0) -> Sphere {
        Sphere { origin, radius, friction, ..scenes::ball() }
    }
}

prop_compose! {
    fn any_scene()(
        cloth in any_cloth(),
        planes in prop::collection::vec(any_plane(), 0..3),
        spheres in prop::collection::vec(any_sphere(), 0..3),
        gravity in prop_oneof![Just(Vec3::new(0.0, -9.8, 0.0)), Just(Vec3::new(-0.0, 0.0, -0.0)), vector(60.0)],
        steps_per_frame in 1_u32..40,
        stretch_limit in prop_oneof![Just(None), Just(Some(0.1)), (0.0_f64..0.5).prop_map(Some)],
        stretch_passes in 1_u32..4,
        self_collision in prop_oneof![4 => Just(SelfCollision::SameBox), 1 => Just(SelfCollision::Off)],
    ) -> Scene {
        let mut scene = scenes::pinned2();
        scene.cloth = Some(cloth);
        let planes = planes.into_iter().map(Collider::Plane);
        scene.colliders = planes.chain(spheres.into_iter().map(Collider::Sphere)).collect();
        scene.sim = drape::scene::Sim {
            gravity, steps_per_frame, stretch_limit, stretch_passes, self_collision, ..scene.sim
        };
        scene
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn any_small_scene_agrees_in_every_bit(
        scene in any_scene(), snap in prop_oneof![2 => Just(None), 1 => (0.02_f64..0.5).prop_map(Some)],
    ) {
        if let Err(difference) = agree(&scene, 60, snap) {
            prop_assert!(false, "{difference}");
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]

    #[test]
    fn any_small_scene_agrees_in_every_bit_for_1000_frames(scene in any_scene()) {
        if let Err(difference) = agree(&scene, 1000 * u64::from(scene.sim.steps_per_frame), None) {
            prop_assert!(false, "{difference}");
        }
    }
}

/// The rows of this cloth are swept in five bands. What `last` says of a pinned point stays, though it means nothing.
#[test]
fn a_cloth_of_several_bands_agrees_in_every_bit() {
    let mut scene = scenes::pinned2();
    let cloth = scene.cloth.as_mut().unwrap();
    (cloth.num_width_points, cloth.num_height_points) = (91, 97);
    cloth.pinned = vec![[0, 0], [90, 19], [3, 20], [90, 96]];
    let mut simulation = Simulation::new(&scene).unwrap();
    let mut textbook = Cloth::new(&scene);
    let start = simulation.positions().clone();
    let mut last = start.clone();
    for p in 0..start.len() {
        last.y[p] += 1e-4 * (splitmix64(p as u64) % 8) as f64;
        textbook.last[p] = last.get(p).into();
    }
    simulation.set_state(start, last).unwrap();
    for step in 0..40 {
        equals(&textbook, &simulation).unwrap_or_else(|difference| panic!("step {step}, {difference}"));
        simulation.step();
        textbook.step();
    }
}

/// One hash over the state hashes of frames 1 to 1000 of the stock scenes. They change only when
/// the method does.
const STOCK_HASHES: [u64; 5] = [
    0x2b70_7580_0555_eba5,
    0x9feb_ce28_1188_5726,
    0x132c_08ce_09aa_07d6,
    0x9c54_f1ec_c70e_cba6,
    0xdb2e_58bc_a924_b0d5,
];

/// The textbook cloth takes a minute and a half of CPU time for all 1000 frames, so here it runs along for 100.
#[test]
fn stock_scenes_agree_in_every_bit_and_keep_their_hashes() {
    all_stock_scenes_agree(100);
}

/// All frames by both: `cargo test --release --test engine method_bits -- --ignored`.
#[test]
#[ignore = "the textbook cloth is slow"]
fn stock_scenes_agree_in_every_bit_for_1000_frames() {
    all_stock_scenes_agree(1000);
}

fn all_stock_scenes_agree(by_both: u64) {
    std::thread::scope(|scope| {
        for ((name, scene), hash) in scenes::stock().into_iter().zip(STOCK_HASHES) {
            scope.spawn(move || stock_scene_agrees(name, &scene, hash, by_both));
        }
    });
}

/// Runs 1000 frames, compares all bits after each of the first `by_both`, and all of them with
/// `expected`.
fn stock_scene_agrees(name: &str, scene: &Scene, expected: u64, by_both: u64) {
    let mut simulation = Simulation::new(scene).unwrap();
    let mut cloth = Cloth::new(scene);
    let mut hash = StateHash::default();
    for frame in 1..=1000 {
        simulation.advance_frame().unwrap();
        hash.write(&simulation.state_hash().to_le_bytes());
        if frame <= by_both {
            (0..30).for_each(|_| cloth.step());
            if let Err(difference) = equals(&cloth, &simulation) {
                panic!("{name}, frame {frame}: {difference}");
            }
        }
    }
    assert_eq!(hash.finish(), expected, "{name}: {:#018x}", hash.finish());
}

/// A cloth of 200 x 200 points, a large one whose steps are shared among threads.
fn large_scene() -> Scene {
    let mut scene = scenes::sphere();
    scenes::add_plane(&mut scene, scenes::floor());
    (scene.sim.fps, scene.sim.steps_per_frame) = (270.0, 40);
    scene.sim.stretch_passes = 2;
    let cloth = scene.cloth.as_mut().unwrap();
    (cloth.num_width_points, cloth.num_height_points) = (200, 200);
    cloth.thickness = 0.0025;
    cloth.pinned = vec![[0, 0], [199, 0], [77, 100]];
    scene
}

/// That cloth in 20 folds, crumpled a little, half through the floor and partly in the ball, with
/// points that are too close and springs that are too long everywhere.
fn folds(start: &Points) -> Points {
    let mut folded = start.clone();
    for p in 0..start.len() {
        let noise = |c| (splitmix64(3 * p as u64 + c) >> 11) as f64 / (1_u64 << 53) as f64 - 0.5;
        let fold = (start.x[p] * 20.0).floor();
        let along = start.x[p] - fold / 20.0;
        let across = if fold % 2.0 == 0.0 { along } else { 0.05 - along };
        let place = Vec3::new(0.3 + across, 0.0041 * (fold - 9.5), start.z[p]);
        folded.set(p, place + Vec3::new(noise(0), noise(1), noise(2)) * 0.002);
    }
    folded
}

/// The state hash after a frame of the folded cloth as one thread computed it before steps were shared.
const FOLDED_HASH: u64 = 0xbc21_2803_712a_bb56;

#[test]
fn a_large_cloth_has_the_same_bits_for_every_number_of_threads() {
    let scene = large_scene();
    let mut start = Simulation::new(&scene).unwrap();
    let x = folds(start.positions());
    let last = Points { y: x.y.iter().map(|y| y + 0.001).collect(), ..x.clone() };
    start.set_state(x, last).unwrap();
    start.allow_unstable();
    for threads in [1, 2, 5] {
        let mut simulation = start.clone();
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| simulation.advance_frame().unwrap());
        let hash = simulation.state_hash();
        assert_eq!(hash, FOLDED_HASH, "{threads} threads: {hash:#018x}");
        let done = simulation.counters();
        let least = done.self_collision_moves.min(done.object_moves).min(done.springs_limited);
        assert!(least > 10_000, "every phase has much to do: {done:?}");
    }
}
