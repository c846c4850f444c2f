//! The method as a plain program, with mistakes that no scene can express.
//!
//! It is slower than the engine and does what the engine does for a scene with the default options of `sim`.

use std::collections::BTreeMap;

use drape::cloth::Points;
use drape::cloth::springs::SpringKind;
use drape::math::length;
use drape::scene::{
    Cloth, Contact, Damping, Integrator, Plane, Precision, Scene, SelfCollision, Sphere, Start, Vec3,
};

/// What a plain program does differently.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Faults {
    /// What self-collision moves.
    pub(super) push: Push,
    /// Self-collision is not spread over the steps of a frame.
    pub(super) whole_push: bool,
    /// Cells are 3 width / (W - 1) wide, not 3 width / W.
    pub(super) wide_cells: bool,
    /// The stretch limit moves along the spring's vector, not along its direction.
    pub(super) unnormalised_limit: bool,
    /// Forces of earlier steps stay.
    pub(super) kept_forces: bool,
}

/// What a point that is too close to others moves.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) enum Push {
    /// Itself, by the mean.
    #[default]
    Mean,
    /// Itself by the mean, and each of the others by what separates the two.
    MeanAndEach,
    /// Itself by the mean, and each of the others by the same backwards.
    MeanBack,
    /// Itself and the other, pair after pair.
    Both,
    /// Itself and the other by half, pair after pair.
    BothHalf,
}

/// A spring.
struct Spring {
    ends: [usize; 2],
    stiffness: f64,
    rest: f64,
}

/// A cloth in motion.
pub(super) struct Plain<'a> {
    scene: &'a Scene,
    cloth: &'a Cloth,
    faults: Faults,
    x: Vec<Vec3>,
    last: Vec<Vec3>,
    pinned: Vec<bool>,
    springs: Vec<Spring>,
    forces: Vec<Vec3>,
}

impl<'a> Plain<'a> {
    /// Whether a plain program can do what `scene` asks for.
    pub(super) fn can(scene: &Scene) -> bool {
        let sim = &scene.sim;
        sim.integrator == Integrator::Verlet
            && sim.precision == Precision::F64
            && sim.start == Start::Report
            && sim.damping == Damping::PerStep
            && sim.contact == Contact::Report
            && sim.self_collision != SelfCollision::Neighbors
            && scene.planes().count() + scene.spheres().count() == scene.colliders.len()
    }

    /// The cloth of a scene with its points at `start`, where its springs are at rest.
    pub(super) fn new(scene: &'a Scene, cloth: &'a Cloth, start: &Points, faults: Faults) -> Self {
        let w = cloth.num_width_points;
        let x: Vec<Vec3> = (0..start.len()).map(|p| start.get(p)).collect();
        let mut pinned = vec![false; x.len()];
        cloth.pinned.iter().for_each(|&[i, j]| pinned[j * w + i] = true);
        let mut springs = Vec::new();
        for p in 0..x.len() {
            let (i, j) = (p % w, p / w);
            for (kind, left, up) in ORDER.into_iter().filter(|(kind, ..)| kind.is_enabled(cloth)) {
                let to = i.checked_add_signed(-left).filter(|&to| to < w).zip(j.checked_sub(up));
                let Some(q) = to.map(|(i, j)| j * w + i) else { continue };
                let stiffness = if kind == SpringKind::Bending { 0.2 * cloth.ks } else { cloth.ks };
                springs.push(Spring { ends: [p, q], stiffness, rest: length(x[p] - x[q]) });
            }
        }
        Self {
            scene,
            cloth,
            faults,
            last: x.clone(),
            forces: vec![Vec3::zeros(); x.len()],
            x,
            pinned,
            springs,
        }
    }

    /// The points.
    pub(super) fn positions(&self) -> Points {
        let component = |axis: usize| self.x.iter().map(|x| x[axis]).collect();
        Points { x: component(0), y: component(1), z: component(2) }
    }

    /// The steps of a frame; false when a point is no longer at a finite place.
    pub(super) fn advance_frame(&mut self) -> bool {
        for _ in 0..self.scene.sim.steps_per_frame {
            self.integrate();
            if self.scene.sim.self_collision == SelfCollision::SameBox {
                self.collide_with_itself();
            }
            self.collide_with_objects();
            self.limit_stretch();
        }
        self.x.iter().all(|x| x.iter().all(|c| c.is_finite()))
    }

    fn integrate(&mut self) {
        let Cloth { width, height, num_width_points, num_height_points, density, damping, .. } = self.cloth;
        let mass = width * height * density / *num_width_points as f64 / *num_height_points as f64;
        let dt = 1.0 / self.scene.sim.fps / f64::from(self.scene.sim.steps_per_frame);
        let weight = self.scene.sim.gravity * mass;
        for force in &mut self.forces {
            *force = if self.faults.kept_forces { *force + weight } else { weight };
        }
        for &Spring { ends: [a, b], stiffness, rest } in &self.springs {
            let along = self.x[b] - self.x[a];
            let l = length(along);
            if l > 0.0 {
                let force = along * (stiffness * (l - rest) / l);
                self.forces[a] += force;
                self.forces[b] -= force;
            }
        }
        let (kept, change) = (1.0 - damping / 100.0, dt * dt / mass);
        for p in (0..self.x.len()).filter(|&p| !self.pinned[p]) {
            let next = self.x[p] + (self.x[p] - self.last[p]) * kept + self.forces[p] * change;
            self.last[p] = self.x[p];
            self.x[p] = next;
        }
    }

    fn collide_with_itself(&mut self) {
        let Cloth { width, height, num_width_points, num_height_points, thickness, .. } = *self.cloth;
        let fewer = usize::from(self.faults.wide_cells);
        let size = |length: f64, points: usize| 3.0 * length / (points - fewer) as f64;
        let (wide, high) = (size(width, num_width_points), size(height, num_height_points));
        let cell = |x: &Vec3| [x.x / wide, x.y / high, x.z / wide.max(high)].map(|c| c.floor().to_bits());
        let cells: Vec<[u64; 3]> = self.x.iter().map(cell).collect();
        let mut members = BTreeMap::<_, Vec<usize>>::new();
        cells.iter().enumerate().for_each(|(p, cell)| members.entry(cell).or_default().push(p));
        let free: Vec<usize> = (0..self.x.len()).filter(|&p| !self.pinned[p]).collect();
        for p in free {
            self.push_apart(p, &members[&cells[p]], 2.0 * thickness);
        }
    }

    /// Moves point `p` away from the other `members` of its cell that are closer than `distance`.
    fn push_apart(&mut self, p: usize, members: &[usize], distance: f64) {
        let spread = if self.faults.whole_push { 1.0 } else { f64::from(self.scene.sim.steps_per_frame) };
        let (mut sum, mut close) = (Vec3::zeros(), Vec::new());
        for &other in members.iter().filter(|&&other| other != p) {
            let away = self.x[p] - self.x[other];
            let l = length(away);
            if !(0.0 < l && l < distance) {
                continue;
            }
            let apart = away * ((distance - l) / l);
            sum += apart;
            close.push(other);
            match self.faults.push {
                Push::Mean | Push::MeanBack => {}
                Push::MeanAndEach => self.shift(other, -apart / spread),
                Push::Both | Push::BothHalf => {
                    let part = if self.faults.push == Push::Both { 1.0 } else { 0.5 };
                    self.x[p] += apart * (part / spread);
                    self.shift(other, -apart * (part / spread));
                }
            }
        }
        if close.is_empty() || matches!(self.faults.push, Push::Both | Push::BothHalf) {
            return;
        }
        let mean = sum * (1.0 / close.len() as f64 / spread);
        self.x[p] += mean;
        if self.faults.push == Push::MeanBack {
            close.into_iter().for_each(|other| self.shift(other, -mean));
        }
    }

    /// Moves a point that is not pinned.
    fn shift(&mut self, p: usize, by: Vec3) {
        if !self.pinned[p] {
            self.x[p] += by;
        }
    }

    fn collide_with_objects(&mut self) {
        let scene = self.scene;
        for p in (0..self.x.len()).filter(|&p| !self.pinned[p]) {
            for plane in scene.planes() {
                self.x[p] = beside_plane(self.x[p], self.last[p], plane);
            }
            for sphere in scene.spheres() {
                self.x[p] = outside_sphere(self.x[p], self.last[p], sphere);
            }
        }
    }

    fn limit_stretch(&mut self) {
        let Some(limit) = self.scene.sim.stretch_limit else { return };
        for _ in 0..self.scene.sim.stretch_passes {
            for i in 0..self.springs.len() {
                let Spring { ends: [a, b], rest, .. } = self.springs[i];
                let along = self.x[b] - self.x[a];
                let (l, longest) = (length(along), (1.0 + limit) * rest);
                if l <= longest {
                    continue;
                }
                let by = if self.faults.unnormalised_limit { 1.0 } else { l };
                let excess = along * ((l - longest) / by);
                let part = if self.pinned[a] || self.pinned[b] { 1.0 } else { 0.5 };
                self.shift(a, excess * part);
                self.shift(b, -excess * part);
            }
        }
    }
}

/// The springs that a point owns: their kind, how far to the left (or right) the other end is, and how far up.
const ORDER: [(SpringKind, isize, usize); 6] = [
    (SpringKind::Structural, 1, 0),
    (SpringKind::Structural, 0, 1),
    (SpringKind::Shearing, 1, 1),
    (SpringKind::Shearing, -1, 1),
    (SpringKind::Bending, 2, 0),
    (SpringKind::Bending, 0, 2),
];

fn beside_plane(x: Vec3, last: Vec3, plane: &Plane) -> Vec3 {
    let normal = plane.normal / length(plane.normal);
    let (way, height) = (x - last, (last - plane.point).dot(&normal));
    let part = -height / way.dot(&normal);
    if !(0.0..=1.0).contains(&part) {
        return x;
    }
    let surface = last + way * part + normal * if height >= 0.0 { 1e-4 } else { -1e-4 };
    last + (surface - last) * (1.0 - plane.friction)
}

fn outside_sphere(x: Vec3, last: Vec3, sphere: &Sphere) -> Vec3 {
    let out = x - sphere.origin;
    let l = length(out);
    if !(0.0 < l && l < sphere.radius) {
        return x;
    }
    let surface = sphere.origin + out * (sphere.radius / l);
    last + (surface - last) * (1.0 - sphere.friction)
}

#[cfg(test)]
mod tests {
    use super::*;
    use drape::scene::{Overrides, load_stock};
    use drape::simulation::Simulation;

    /// Only rounding is between them: a cloth that falls onto a ball, and one that folds onto a plane.
    #[test]
    fn without_faults_it_is_the_method() {
        for (file, frames) in [("scenes/sphere.json", 60), ("scenes/selfCollision.json", 60)] {
            let sets = ["cloth.num_width_points=12", "cloth.num_height_points=13", "cloth.thickness=0.03"];
            let overrides = Overrides { sets: sets.map(String::from).to_vec(), ..Overrides::default() };
            let scene = load_stock(file.as_ref(), &overrides).unwrap().scene;
            assert!(Plain::can(&scene), "{file}");
            let mut engine = Simulation::new(&scene).unwrap();
            let mut plain =
                Plain::new(&scene, scene.cloth.as_ref().unwrap(), engine.positions(), Faults::default());
            for _ in 0..frames {
                engine.advance_frame().unwrap();
                assert!(plain.advance_frame());
            }
            let (ours, theirs) = (engine.positions(), plain.positions());
            let off = (0..ours.len()).map(|p| length(ours.get(p) - theirs.get(p))).fold(0.0, f64::max);
            let counters = engine.counters();
            assert!(off < 1e-9, "{file}: {off}");
            assert!(
                counters.springs_limited > 0 && counters.self_collision_moves + counters.object_moves > 0
            );
        }
    }
}
