//! The method of the report, written from its text with points as triples, one list of springs and
//! a tree of boxes, one scalar operation at a time. It shares no code with the library. It can make
//! the mistakes that programs of students make.

#![expect(clippy::unwrap_used, clippy::cast_possible_truncation, reason = "a test may panic")]

use std::collections::BTreeMap;

use drape::scene::{Orientation, Plane, Scene, SelfCollision, Sphere, Vec3};

/// What is done differently from the method; by default nothing.
#[derive(Clone, Copy, Default)]
pub(crate) struct Mistakes {
    /// Points are width / W apart.
    pub(crate) pitch: bool,
    /// A pin is [row, column].
    pub(crate) pins_are_rows: bool,
    /// Pin k is a list of columns in row k.
    pub(crate) pins_are_lists: bool,
    /// Bending springs are as stiff as the others.
    pub(crate) stiff_bending: bool,
    /// All springs have 0.2 ks.
    pub(crate) soft_springs: bool,
    /// Damping is a fraction, not a percentage.
    pub(crate) damping_is_a_fraction: bool,
    /// Points are put onto the plane, not 0.1 mm beside it.
    pub(crate) no_plane_offset: bool,
    /// Boxes are told apart by one number in binary32, of coordinates that are cut towards zero.
    pub(crate) float_hash: bool,
    /// Coordinates of boxes are cut towards zero.
    pub(crate) cut_boxes: bool,
}

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
    mistakes: Mistakes,
}

fn splitmix64(x: u64) -> u64 {
    let mut x = x.wrapping_add(0x9E3779B97F4A7C15);
    x = (x ^ (x >> 30)).wrapping_mul(0xBF58476D1CE4E5B9);
    x = (x ^ (x >> 27)).wrapping_mul(0x94D049BB133111EB);
    x ^ (x >> 31)
}

impl<'a> Cloth<'a> {
    pub(crate) fn new(scene: &'a Scene, mistakes: Mistakes) -> Self {
        let cloth = scene.cloth.as_ref().unwrap();
        let (w, h) = (cloth.num_width_points, cloth.num_height_points);
        let gaps = |points: usize| (if mistakes.pitch { points } else { points - 1 }) as f64;
        let mut x = Vec::new();
        for j in 0..h {
            for i in 0..w {
                let u = cloth.width * i as f64 / gaps(w);
                let v = cloth.height * j as f64 / gaps(h);
                let r = (splitmix64((j * w + i) as u64) >> 11) as f64 * (1.0 / 9_007_199_254_740_992.0);
                x.push(match cloth.orientation {
                    Orientation::Horizontal => [u, 1.0, v],
                    Orientation::Vertical => [u, v, (2.0 * r - 1.0) / 1000.0],
                });
            }
        }
        let mut pinned = vec![false; w * h];
        for pin in &cloth.pinned {
            let [i, j] = if mistakes.pins_are_rows { [pin[1], pin[0]] } else { *pin };
            pinned[j * w + i] = true;
        }
        if mistakes.pins_are_lists {
            pinned.fill(false);
            let lists = cloth.pinned.iter().enumerate();
            lists.flat_map(|(j, list)| list.map(|i| j * w + i)).for_each(|p| pinned[p] = true);
        }
        let ks = if mistakes.soft_springs { cloth.ks * 0.2 } else { cloth.ks };
        let bending = if mistakes.soft_springs || mistakes.stiff_bending { ks } else { cloth.ks * 0.2 };
        let mut springs = Vec::new();
        for j in 0..h as i64 {
            for i in 0..w as i64 {
                let mut spring = |enabled: bool, oi: i64, oj: i64, k: f64| {
                    if enabled && oi >= 0 && oi < w as i64 && oj >= 0 {
                        let (a, b) = ((j * w as i64 + i) as usize, (oj * w as i64 + oi) as usize);
                        springs.push(Spring { a, b, k, l0: len(sub(x[a], x[b])) });
                    }
                };
                spring(cloth.enable_structural, i - 1, j, ks);
                spring(cloth.enable_structural, i, j - 1, ks);
                spring(cloth.enable_shearing, i - 1, j - 1, ks);
                spring(cloth.enable_shearing, i + 1, j - 1, ks);
                spring(cloth.enable_bending, i - 2, j, bending);
                spring(cloth.enable_bending, i, j - 2, bending);
            }
        }
        let t = scene.sim.steps_per_frame as f64;
        let m = cloth.width * cloth.height * cloth.density / w as f64 / h as f64;
        let dt = 1.0 / scene.sim.fps / t;
        let keep = 1.0 - if mistakes.damping_is_a_fraction { cloth.damping } else { cloth.damping / 100.0 };
        Cloth { scene, last: x.clone(), x, pinned, springs, m, a2: dt * dt / m, keep, t, mistakes }
    }

    /// Puts the points at `x`, where the springs are at rest.
    #[allow(dead_code, reason = "not every test starts anywhere else")]
    pub(crate) fn start_at(&mut self, x: Vec<V>) {
        for s in &mut self.springs {
            s.l0 = len(sub(x[s.a], x[s.b]));
        }
        self.last.clone_from(&x);
        self.x = x;
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
        let key = |x: V| ((x[0] / bx).floor() as i64, (x[1] / by).floor() as i64, (x[2] / bz).floor() as i64);
        // A cut towards zero makes the boxes beside 0 one.
        let cut = |x: V| [x[0] / bx, x[1] / by, x[2] / bz].map(|value| value.trunc() as f32);
        let sum = |[x, y, z]: [f32; 3]| ((x * x + y * y + z * z * z) as i64, 0, 0);
        let each = |[x, y, z]: [f32; 3]| (x as i64, y as i64, z as i64);
        let key = |x: V| match self.mistakes {
            Mistakes { float_hash: true, .. } => sum(cut(x)),
            Mistakes { cut_boxes: true, .. } => each(cut(x)),
            _ => key(x),
        };
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
                for plane in self.scene.planes() {
                    self.plane(p, plane);
                }
                for sphere in self.scene.spheres() {
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
                let offset = if self.mistakes.no_plane_offset { 0.0 } else { 1e-4 };
                let off = if side >= 0.0 { offset } else { -offset };
                let tp = add(add(last, mul(dir, s)), mul(n, off));
                self.x[p] = add(last, mul(sub(tp, last), 1.0 - plane.friction));
            }
        }
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
