//! The simulation agrees in every bit with the published method.
//!
//! `naive` is the method a second time, written from its text with points as triples, one list of
//! springs and a tree of boxes. It shares no code with the library. Random small scenes and the
//! five stock scenes are run by both, for up to 1000 frames.

#![expect(clippy::unwrap_used, clippy::cast_possible_truncation, reason = "a test may panic")]

mod scenes;

use std::collections::BTreeMap;

use drape::math::StateHash;
use drape::scene::{Orientation, Plane, Scene, SelfCollision, Sphere, Vec3};
use drape::simulation::Simulation;
use proptest::prelude::*;

/// The method, one scalar operation at a time.
mod naive {
    use super::*;

    type V = [f64; 3];

    fn each(a: V, b: V, op: impl Fn(f64, f64) -> f64) -> V {
        [op(a[0], b[0]), op(a[1], b[1]), op(a[2], b[2])]
    }
    fn add(a: V, b: V) -> V {
        each(a, b, |a, b| a + b)
    }
    fn sub(a: V, b: V) -> V {
        each(a, b, |a, b| a - b)
    }
    fn mul(a: V, s: f64) -> V {
        each(a, [s; 3], |a, s| a * s)
    }
    fn dot(a: V, b: V) -> f64 {
        a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
    }
    fn len(a: V) -> f64 {
        dot(a, a).sqrt()
    }
    fn triple(v: Vec3) -> V {
        [v.x, v.y, v.z]
    }

    struct Spring {
        a: usize,
        b: usize,
        k: f64,
        l0: f64,
    }

    pub(crate) struct Cloth<'a> {
        scene: &'a Scene,
        pub(crate) x: Vec<V>,
        pub(crate) last: Vec<V>,
        pinned: Vec<bool>,
        springs: Vec<Spring>,
        m: f64,
        a2: f64,
        keep: f64,
        t: f64,
    }

    fn splitmix64(x: u64) -> u64 {
        let mut x = x.wrapping_add(0x9E3779B97F4A7C15);
        x = (x ^ (x >> 30)).wrapping_mul(0xBF58476D1CE4E5B9);
        x = (x ^ (x >> 27)).wrapping_mul(0x94D049BB133111EB);
        x ^ (x >> 31)
    }

    impl<'a> Cloth<'a> {
        pub(crate) fn new(scene: &'a Scene) -> Self {
            let cloth = scene.cloth.as_ref().unwrap();
            let (w, h) = (cloth.num_width_points, cloth.num_height_points);
            let mut x = Vec::new();
            for j in 0..h {
                for i in 0..w {
                    let u = cloth.width * i as f64 / (w - 1) as f64;
                    let v = cloth.height * j as f64 / (h - 1) as f64;
                    let r = (splitmix64((j * w + i) as u64) >> 11) as f64 * (1.0 / 9_007_199_254_740_992.0);
                    x.push(match cloth.orientation {
                        Orientation::Horizontal => [u, 1.0, v],
                        Orientation::Vertical => [u, v, (2.0 * r - 1.0) / 1000.0],
                    });
                }
            }
            let mut pinned = vec![false; w * h];
            for pin in &cloth.pinned {
                pinned[pin[1] * w + pin[0]] = true;
            }
            let mut springs = Vec::new();
            for j in 0..h as i64 {
                for i in 0..w as i64 {
                    let mut spring = |enabled: bool, oi: i64, oj: i64, k: f64| {
                        if enabled && oi >= 0 && oi < w as i64 && oj >= 0 {
                            let (a, b) = ((j * w as i64 + i) as usize, (oj * w as i64 + oi) as usize);
                            springs.push(Spring { a, b, k, l0: len(sub(x[a], x[b])) });
                        }
                    };
                    spring(cloth.enable_structural, i - 1, j, cloth.ks);
                    spring(cloth.enable_structural, i, j - 1, cloth.ks);
                    spring(cloth.enable_shearing, i - 1, j - 1, cloth.ks);
                    spring(cloth.enable_shearing, i + 1, j - 1, cloth.ks);
                    spring(cloth.enable_bending, i - 2, j, cloth.ks * 0.2);
                    spring(cloth.enable_bending, i, j - 2, cloth.ks * 0.2);
                }
            }
            let t = scene.sim.steps_per_frame as f64;
            let m = cloth.width * cloth.height * cloth.density / w as f64 / h as f64;
            let dt = 1.0 / scene.sim.fps / t;
            let keep = 1.0 - cloth.damping / 100.0;
            Cloth { scene, last: x.clone(), x, pinned, springs, m, a2: dt * dt / m, keep, t }
        }

        pub(crate) fn step(&mut self) {
            let f = self.forces();
            self.verlet(&f);
            if self.scene.sim.self_collision == SelfCollision::SameBox {
                self.self_collision();
            }
            self.objects();
            if let Some(limit) = self.scene.sim.stretch_limit {
                for _ in 0..self.scene.sim.stretch_passes {
                    self.stretch_limit(1.0 + limit);
                }
            }
        }

        fn forces(&self) -> Vec<V> {
            let mut f = vec![mul(triple(self.scene.sim.gravity), self.m); self.x.len()];
            for s in &self.springs {
                let e = sub(self.x[s.b], self.x[s.a]);
                let l = len(e);
                if l == 0.0 {
                    continue;
                }
                let force = mul(e, s.k * (l - s.l0) / l);
                f[s.a] = add(f[s.a], force);
                f[s.b] = sub(f[s.b], force);
            }
            f
        }

        fn verlet(&mut self, f: &[V]) {
            for (p, &f) in f.iter().enumerate() {
                if !self.pinned[p] {
                    let kept = mul(sub(self.x[p], self.last[p]), self.keep);
                    let new = add(add(self.x[p], kept), mul(f, self.a2));
                    self.last[p] = self.x[p];
                    self.x[p] = new;
                }
            }
        }

        fn self_collision(&mut self) {
            let cloth = self.scene.cloth.as_ref().unwrap();
            let bx = 3.0 * cloth.width / cloth.num_width_points as f64;
            let by = 3.0 * cloth.height / cloth.num_height_points as f64;
            let bz = if bx > by { bx } else { by };
            let key =
                |x: V| ((x[0] / bx).floor() as i64, (x[1] / by).floor() as i64, (x[2] / bz).floor() as i64);
            let keys: Vec<_> = self.x.iter().map(|&x| key(x)).collect();
            let mut boxes = BTreeMap::<_, Vec<usize>>::new();
            for (p, &key) in keys.iter().enumerate() {
                boxes.entry(key).or_default().push(p);
            }
            for p in 0..self.x.len() {
                if self.pinned[p] {
                    continue;
                }
                let (mut sum, mut count) = ([0.0; 3], 0.0);
                for &o in &boxes[&keys[p]] {
                    let e = sub(self.x[p], self.x[o]);
                    let l = len(e);
                    if o != p && 0.0 < l && l < 2.0 * cloth.thickness {
                        sum = add(sum, mul(e, (2.0 * cloth.thickness - l) / l));
                        count += 1.0;
                    }
                }
                if count > 0.0 {
                    self.x[p] = add(self.x[p], mul(sum, 1.0 / count / self.t));
                }
            }
        }

        fn objects(&mut self) {
            for p in 0..self.x.len() {
                if !self.pinned[p] {
                    for plane in &self.scene.planes {
                        self.plane(p, plane);
                    }
                    for sphere in &self.scene.spheres {
                        self.sphere(p, sphere);
                    }
                }
            }
        }

        fn sphere(&mut self, p: usize, sphere: &Sphere) {
            let (origin, last) = (triple(sphere.origin), self.last[p]);
            let e = sub(self.x[p], origin);
            let l = len(e);
            if 0.0 < l && l < sphere.radius {
                let tp = add(origin, mul(e, sphere.radius / l));
                self.x[p] = add(last, mul(sub(tp, last), 1.0 - sphere.friction));
            }
        }

        fn plane(&mut self, p: usize, plane: &Plane) {
            let normal = triple(plane.normal);
            let n = each(normal, [len(normal); 3], |n, l| n / l);
            let last = self.last[p];
            let dir = sub(self.x[p], last);
            let den = dot(dir, n);
            if den != 0.0 {
                let side = dot(sub(last, triple(plane.point)), n);
                let s = -side / den;
                if (0.0..=1.0).contains(&s) {
                    let off = if side >= 0.0 { 1e-4 } else { -1e-4 };
                    let tp = add(add(last, mul(dir, s)), mul(n, off));
                    self.x[p] = add(last, mul(sub(tp, last), 1.0 - plane.friction));
                }
            }
        }

        /// Whether all bits are those of `simulation`.
        pub(crate) fn equals(&self, simulation: &Simulation) -> Result<(), String> {
            for p in 0..self.x.len() {
                let theirs = [simulation.positions().get(p), simulation.last_positions().get(p)];
                for (ours, theirs) in [self.x[p], self.last[p]].into_iter().zip(theirs.map(triple)) {
                    if ours.map(f64::to_bits) != theirs.map(f64::to_bits) {
                        return Err(format!("point {p}: {ours:?} by the method, {theirs:?} here"));
                    }
                }
            }
            Ok(())
        }

        fn stretch_limit(&mut self, factor: f64) {
            for s in &self.springs {
                if self.pinned[s.a] && self.pinned[s.b] {
                    continue;
                }
                let e = sub(self.x[s.b], self.x[s.a]);
                let l = len(e);
                let max = factor * s.l0;
                if l > max {
                    let c = mul(e, (l - max) / l);
                    if self.pinned[s.a] {
                        self.x[s.b] = sub(self.x[s.b], c);
                    } else if self.pinned[s.b] {
                        self.x[s.a] = add(self.x[s.a], c);
                    } else {
                        self.x[s.a] = add(self.x[s.a], mul(c, 0.5));
                        self.x[s.b] = sub(self.x[s.b], mul(c, 0.5));
                    }
                }
            }
        }
    }
}

/// Runs both for `steps` steps and compares all bits after each, up to where a position stops
/// being finite: there the method ends. With `snap` the points start on a lattice of that pitch, in
/// metres, so that some meet and many lie on the border of a box.
fn agree(scene: &Scene, steps: u64, snap: Option<f64>) -> Result<(), String> {
    let mut simulation = Simulation::new(scene).map_err(|error| error.to_string())?;
    let mut cloth = naive::Cloth::new(scene);
    if let Some(pitch) = snap {
        let mut start = simulation.positions().clone();
        for p in 0..start.len() {
            start.set(p, start.get(p).map(|value| (value / pitch).round() * pitch + 0.0));
            (cloth.x[p], cloth.last[p]) = (start.get(p).into(), start.get(p).into());
        }
        simulation.set_state(start.clone(), start).map_err(|error| error.to_string())?;
    }
    for step in 0..=steps {
        cloth.equals(&simulation).map_err(|difference| format!("step {step}, {difference}"))?;
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
        Sphere { origin, radius, friction, ..scenes::sphere().spheres.remove(0) }
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
        scene.planes = planes;
        scene.spheres = spheres;
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

/// One hash over the state hashes of frames 1 to 1000 of the stock scenes. They change only when
/// the method does.
const STOCK_HASHES: [u64; 5] = [
    0x2b70_7580_0555_eba5,
    0x9feb_ce28_1188_5726,
    0x132c_08ce_09aa_07d6,
    0x9c54_f1ec_c70e_cba6,
    0xdb2e_58bc_a924_b0d5,
];

/// The naive method takes a minute and a half of CPU time for all 1000 frames, so here it runs along for 100.
#[test]
fn stock_scenes_agree_in_every_bit_and_keep_their_hashes() {
    all_stock_scenes_agree(100);
}

/// All frames by both: `cargo test --release --test method_bits -- --ignored`.
#[test]
#[ignore = "the naive method is slow"]
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
    let mut cloth = naive::Cloth::new(scene);
    let mut hash = StateHash::default();
    for frame in 1..=1000 {
        simulation.advance_frame().unwrap();
        hash.write(&simulation.state_hash().to_le_bytes());
        if frame <= by_both {
            (0..30).for_each(|_| cloth.step());
            if let Err(difference) = cloth.equals(&simulation) {
                panic!("{name}, frame {frame}: {difference}");
            }
        }
    }
    assert_eq!(hash.finish(), expected, "{name}: {:#018x}", hash.finish());
}
