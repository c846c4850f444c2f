//! A cloth simulator to learn from: the whole method in one file, one scalar operation after the
//! other, with points as triples, a list of springs and a map of boxes.
//!
//! It is the mass-spring cloth of Provot, "Deformation constraints in a mass-spring model to describe
//! rigid cloth behavior" (1995), with Verlet's scheme. It shares no code with the library's own simulator, which is
//! the same method made fast; both agree in every bit, and the tests of the library rely on that.
//!
//! `cargo run --release --example textbook_cloth` drops a cloth onto a ball, prints what happens, and compares.

#![allow(
    clippy::unwrap_used,
    clippy::cast_possible_truncation,
    reason = "it is short to read, for small scenes"
)]
#![allow(dead_code, unreachable_pub, reason = "tests use other parts of it than the example")]

use std::collections::BTreeMap;

use drape::scene::{Orientation, Plane, Scene, SelfCollision, Sphere};

/// A vector in space. The order of the operations on its components is part of the method.
pub type Vector = [f64; 3];

fn add(a: Vector, b: Vector) -> Vector {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}
fn sub(a: Vector, b: Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}
fn scale(a: Vector, s: f64) -> Vector {
    [a[0] * s, a[1] * s, a[2] * s]
}
fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
fn length(a: Vector) -> f64 {
    dot(a, a).sqrt()
}

/// A spring between two points.
pub struct Spring {
    /// The point that owns it.
    pub a: usize,
    /// The other end.
    pub b: usize,
    /// Stiffness, in N/m.
    pub stiffness: f64,
    /// Rest length, in metres.
    pub rest: f64,
}

/// The cloth of a scene in motion. Point (column i, row j) of W columns has index `j W + i`.
pub struct Cloth<'a> {
    scene: &'a Scene,
    /// Where the points are, in metres.
    pub x: Vec<Vector>,
    /// Where they were one step ago.
    pub last: Vec<Vector>,
    /// Which of them never move.
    pub pinned: Vec<bool>,
    /// The springs in the order in which they are created, and handled.
    pub springs: Vec<Spring>,
    /// Mass of a point, in kg.
    pub mass: f64,
    /// Step, in seconds.
    pub dt: f64,
    /// The part of its displacement that a point repeats in the next step.
    pub velocity_retention: f64,
    /// How far above a plane a point is put back, in metres.
    pub plane_offset: f64,
    /// The box of self-collision in which a point lies, given its coordinates in units of a box.
    pub box_of: fn(Vector) -> [i64; 3],
}

impl<'a> Cloth<'a> {
    /// The cloth of `scene`, which has one, at its start.
    pub fn new(scene: &'a Scene) -> Self {
        let cloth = scene.cloth.as_ref().unwrap();
        let (w, h) = (cloth.num_width_points, cloth.num_height_points);
        let mut pinned = vec![false; w * h];
        for [i, j] in &cloth.pinned {
            pinned[j * w + i] = true;
        }
        let x = starting_grid(scene);
        Cloth {
            scene,
            last: x.clone(),
            springs: springs(scene, &x),
            x,
            pinned,
            mass: cloth.width * cloth.height * cloth.density / w as f64 / h as f64,
            dt: 1.0 / scene.sim.fps / f64::from(scene.sim.steps_per_frame),
            velocity_retention: 1.0 - cloth.damping / 100.0,
            plane_offset: 1e-4,
            box_of: |[x, y, z]| [x.floor() as i64, y.floor() as i64, z.floor() as i64],
        }
    }

    /// One step of the method.
    pub fn step(&mut self) {
        let forces = self.forces();
        self.integrate(&forces);
        if self.scene.sim.self_collision == SelfCollision::SameBox {
            self.collide_with_itself();
        }
        self.collide_with_objects();
        self.limit_stretch();
    }

    /// Phase 1: The force on every point: its weight, and Hooke's law for each spring.
    pub fn forces(&self) -> Vec<Vector> {
        let gravity = self.scene.sim.gravity;
        let weight = scale([gravity.x, gravity.y, gravity.z], self.mass);
        let mut forces = vec![weight; self.x.len()];
        for spring in &self.springs {
            let along = sub(self.x[spring.b], self.x[spring.a]);
            let l = length(along);
            if l > 0.0 {
                let force = scale(along, spring.stiffness * (l - spring.rest) / l);
                forces[spring.a] = add(forces[spring.a], force);
                forces[spring.b] = sub(forces[spring.b], force);
            }
        }
        forces
    }

    /// Phase 2: Verlet's scheme: each point repeats most of its last displacement, and the force adds to it.
    pub fn integrate(&mut self, forces: &[Vector]) {
        let dt2_over_m = self.dt * self.dt / self.mass;
        for p in (0..self.x.len()).filter(|&p| !self.pinned[p]) {
            let repeated = scale(sub(self.x[p], self.last[p]), self.velocity_retention);
            let next = add(add(self.x[p], repeated), scale(forces[p], dt2_over_m));
            self.last[p] = self.x[p];
            self.x[p] = next;
        }
    }

    /// Phase 3: Space is divided into boxes. Each point moves away from those in its box that are closer than twice the
    /// thickness, by the mean of what separates them, spread over the steps of a frame.
    pub fn collide_with_itself(&mut self) {
        let cloth = self.scene.cloth.as_ref().unwrap();
        let distance = 2.0 * cloth.thickness;
        let steps_per_frame = f64::from(self.scene.sim.steps_per_frame);
        let size_x = 3.0 * cloth.width / cloth.num_width_points as f64;
        let size_y = 3.0 * cloth.height / cloth.num_height_points as f64;
        let size_z = size_x.max(size_y);
        let boxes: Vec<[i64; 3]> =
            self.x.iter().map(|x| (self.box_of)([x[0] / size_x, x[1] / size_y, x[2] / size_z])).collect();
        let mut members = BTreeMap::<_, Vec<usize>>::new();
        for (p, of) in boxes.iter().enumerate() {
            members.entry(of).or_default().push(p);
        }
        for p in (0..self.x.len()).filter(|&p| !self.pinned[p]) {
            let (mut sum, mut count) = ([0.0; 3], 0.0);
            for &other in members[&boxes[p]].iter().filter(|&&other| other != p) {
                let away = sub(self.x[p], self.x[other]);
                let l = length(away);
                if 0.0 < l && l < distance {
                    sum = add(sum, scale(away, (distance - l) / l));
                    count += 1.0;
                }
            }
            if count > 0.0 {
                self.x[p] = add(self.x[p], scale(sum, 1.0 / count / steps_per_frame));
            }
        }
    }

    /// Phase 4: Points that went through a plane or into a sphere are put back on its surface, and friction takes a
    /// part of the way from where they were to there.
    pub fn collide_with_objects(&mut self) {
        let scene = self.scene;
        for p in 0..self.x.len() {
            if !self.pinned[p] {
                scene.planes().for_each(|plane| self.collide_with_plane(p, plane));
                scene.spheres().for_each(|sphere| self.collide_with_sphere(p, sphere));
            }
        }
    }

    fn collide_with_plane(&mut self, p: usize, plane: &Plane) {
        let normal = [plane.normal.x, plane.normal.y, plane.normal.z];
        let normal = normal.map(|n| n / length(normal));
        let (last, way) = (self.last[p], sub(self.x[p], self.last[p]));
        let height = dot(sub(last, [plane.point.x, plane.point.y, plane.point.z]), normal);
        // After this part of its way the point meets the plane; no number if it moves along it.
        let part = -height / dot(way, normal);
        if (0.0..=1.0).contains(&part) {
            let offset = if height >= 0.0 { self.plane_offset } else { -self.plane_offset };
            let surface = add(add(last, scale(way, part)), scale(normal, offset));
            self.x[p] = add(last, scale(sub(surface, last), 1.0 - plane.friction));
        }
    }

    fn collide_with_sphere(&mut self, p: usize, sphere: &Sphere) {
        let (last, origin) = (self.last[p], [sphere.origin.x, sphere.origin.y, sphere.origin.z]);
        let out = sub(self.x[p], origin);
        let l = length(out);
        if 0.0 < l && l < sphere.radius {
            let surface = add(origin, scale(out, sphere.radius / l));
            self.x[p] = add(last, scale(sub(surface, last), 1.0 - sphere.friction));
        }
    }

    /// Phase 5: Springs that are longer than 1.1 times their rest length are shortened to that, one after the other, by moving
    /// both ends, or the one that is not pinned.
    pub fn limit_stretch(&mut self) {
        let Some(limit) = self.scene.sim.stretch_limit else { return };
        for _ in 0..self.scene.sim.stretch_passes {
            for &Spring { a, b, rest, .. } in &self.springs {
                let along = sub(self.x[b], self.x[a]);
                let (l, longest) = (length(along), (1.0 + limit) * rest);
                if l > longest {
                    let excess = scale(along, (l - longest) / l);
                    match (self.pinned[a], self.pinned[b]) {
                        (true, true) => {}
                        (true, false) => self.x[b] = sub(self.x[b], excess),
                        (false, true) => self.x[a] = add(self.x[a], excess),
                        (false, false) => {
                            self.x[a] = add(self.x[a], scale(excess, 0.5));
                            self.x[b] = sub(self.x[b], scale(excess, 0.5));
                        }
                    }
                }
            }
        }
    }
}

/// Where the points of a scene's cloth start: in the plane y = 1, or upright with a little noise in depth, without
/// which the cloth would fall flat.
fn starting_grid(scene: &Scene) -> Vec<Vector> {
    let cloth = scene.cloth.as_ref().unwrap();
    let (w, h) = (cloth.num_width_points, cloth.num_height_points);
    let mut x = Vec::new();
    for j in 0..h {
        for i in 0..w {
            let u = cloth.width * i as f64 / (w - 1) as f64;
            let v = cloth.height * j as f64 / (h - 1) as f64;
            let noise = (splitmix64((j * w + i) as u64) >> 11) as f64 * (1.0 / 9_007_199_254_740_992.0);
            x.push(match cloth.orientation {
                Orientation::Horizontal => [u, 1.0, v],
                Orientation::Vertical => [u, v, (2.0 * noise - 1.0) / 1000.0],
            });
        }
    }
    x
}

/// The springs between points at `x`, at rest: each point owns those to its neighbours to the left and above.
fn springs(scene: &Scene, x: &[Vector]) -> Vec<Spring> {
    let cloth = scene.cloth.as_ref().unwrap();
    let (w, h) = (cloth.num_width_points as i64, cloth.num_height_points as i64);
    let mut springs = Vec::new();
    for j in 0..h {
        for i in 0..w {
            let mut join = |enabled: bool, to_i: i64, to_j: i64, stiffness: f64| {
                if enabled && to_i >= 0 && to_i < w && to_j >= 0 {
                    let (a, b) = ((j * w + i) as usize, (to_j * w + to_i) as usize);
                    springs.push(Spring { a, b, stiffness, rest: length(sub(x[a], x[b])) });
                }
            };
            join(cloth.enable_structural, i - 1, j, cloth.ks);
            join(cloth.enable_structural, i, j - 1, cloth.ks);
            join(cloth.enable_shearing, i - 1, j - 1, cloth.ks);
            join(cloth.enable_shearing, i + 1, j - 1, cloth.ks);
            join(cloth.enable_bending, i - 2, j, 0.2 * cloth.ks);
            join(cloth.enable_bending, i, j - 2, 0.2 * cloth.ks);
        }
    }
    springs
}

/// Scrambles the bits of a number (Steele, Lea and Flood 2014).
fn splitmix64(x: u64) -> u64 {
    let mut x = x.wrapping_add(0x9E3779B97F4A7C15);
    x = (x ^ (x >> 30)).wrapping_mul(0xBF58476D1CE4E5B9);
    x = (x ^ (x >> 27)).wrapping_mul(0x94D049BB133111EB);
    x ^ (x >> 31)
}

/// Drops the cloth of scenes/sphere.json and prints what happens, every tenth of a second.
#[cfg(not(test))]
#[allow(clippy::print_stdout, reason = "people read it")]
fn main() -> drape::error::Result<()> {
    let scene = drape::scene::load("scenes/sphere.json".as_ref(), &Default::default())?.scene;
    let (mut cloth, mut library) = (Cloth::new(&scene), drape::simulation::Simulation::new(&scene)?);
    println!("time/s  lowest point/m  longest spring/rest length  same bits as the library");
    for frame in 0..=90 {
        if frame % 9 == 0 {
            let lowest = cloth.x.iter().map(|x| x[1]).fold(f64::INFINITY, f64::min);
            let stretch = cloth.springs.iter().map(|s| length(sub(cloth.x[s.b], cloth.x[s.a])) / s.rest);
            let same = (0..cloth.x.len()).all(|p| cloth.x[p] == <Vector>::from(library.positions().get(p)));
            let (time, longest) = (f64::from(frame) / scene.sim.fps, stretch.fold(0.0, f64::max));
            println!("{time:6.1}  {lowest:14.4}  {longest:26.4}  {}", if same { "yes" } else { "NO" });
        }
        (0..scene.sim.steps_per_frame).for_each(|_| cloth.step());
        library.advance_frame()?;
    }
    Ok(())
}
