//! The mistakes that programs of students make, each run here as a changed scene or simulation.

use std::num::Wrapping;

use super::case::Ours;
use super::plain::{Faults, Plain, Push};
use drape::cloth::springs::SpringKind;
use drape::cloth::{Counters, Points};
use drape::error::{Error, Kind, Result};
use drape::scene::{Cloth, Collider, Orientation, Scene, SelfCollision};
use drape::simulation::Simulation;

/// A mistake, and the simulation that does what the mistaken program does.
pub(super) struct Mistake {
    /// What the mistaken program does, and what it should do.
    pub(super) name: String,
    scene: Scene,
    /// A change that a scene cannot express.
    change: Option<Change>,
}

/// A change of a simulation.
#[derive(Clone, Copy)]
enum Change {
    /// Stiffness of bending springs, in N/m.
    Bending(f64),
    /// Height above a plane at which points are put back, in metres.
    PlaneOffset(f64),
    /// What tells the cells of self-collision apart.
    CellHash(fn([i64; 3]) -> i64),
    /// What only a plain program can do.
    Plain(Faults),
}

impl Mistake {
    /// The mistake of having another scene.
    pub(super) fn of(name: impl Into<String>, scene: Scene) -> Self {
        Self { name: name.into(), scene, change: None }
    }

    /// A simulation that makes the mistake, from `start` on if that is given.
    ///
    /// # Errors
    /// As [`Simulation::new`].
    pub(super) fn simulation(&self, start: Option<&Points>) -> Result<Simulation> {
        let mut simulation = Simulation::starting_at(&self.scene, start)?;
        match self.change {
            Some(Change::Bending(k)) => simulation.set_stiffness(SpringKind::Bending, k),
            Some(Change::PlaneOffset(offset)) => simulation.set_plane_offset(offset),
            Some(Change::CellHash(hash)) => simulation.set_cell_hash(hash),
            Some(Change::Plain(_)) | None => {}
        }
        simulation.allow_unstable();
        Ok(simulation)
    }

    /// What the mistaken program has at `count` frames from `first` on, started at `start` if that is given.
    /// `watch` is called after every frame.
    ///
    /// # Errors
    /// Those of the simulation, of [`Kind::Unstable`] when a point has no finite place, and of `watch`.
    pub(super) fn states(
        &self,
        start: Option<&Points>,
        first: u64,
        count: usize,
        watch: &dyn Fn() -> Result<()>,
    ) -> Result<Vec<Ours>> {
        let simulation = self.simulation(start)?;
        let (Some(Change::Plain(faults)), Some(cloth)) = (self.change, &self.scene.cloth) else {
            return Ours::simulate(simulation, first, count, |_| watch());
        };
        let mut plain = Plain::new(&self.scene, cloth, simulation.positions(), faults);
        let mut states = Vec::new();
        for frame in 0..first + count as u64 {
            if frame >= first {
                states.push(Ours { positions: plain.positions(), counters: Counters::default() });
            }
            watch()?;
            if !plain.advance_frame() {
                return Err(Error::new(Kind::Unstable, "a point has no finite place"));
            }
        }
        Ok(states)
    }

    /// The mistake of another stiffness of bending springs, in N/m.
    pub(super) fn of_bending(name: impl Into<String>, scene: &Scene, stiffness: f64) -> Self {
        Self { name: name.into(), scene: scene.clone(), change: Some(Change::Bending(stiffness)) }
    }
}

/// The mistakes that have an effect in `scene`.
pub(super) fn all(scene: &Scene) -> Vec<Mistake> {
    let Some(cloth) = &scene.cloth else { return Vec::new() };
    let fits = |cloth: &Cloth| {
        cloth.pinned.iter().all(|&[i, j]| i < cloth.num_width_points && j < cloth.num_height_points)
    };
    let mut mistakes = scenes(scene);
    mistakes.retain(|mistake| mistake.scene != *scene && mistake.scene.cloth.as_ref().is_some_and(fits));
    if cloth.enable_bending && cloth.ks > 0.0 {
        mistakes.extend(bending(scene, cloth.ks));
    }
    if scene.planes().next().is_some() {
        mistakes.extend(plane_offsets(scene));
    }
    if scene.sim.self_collision == SelfCollision::SameBox {
        mistakes.extend(cell_hashes(scene));
    }
    if Plain::can(scene) {
        mistakes.extend(plain(scene));
    }
    mistakes
}

/// The mistakes that neither a scene nor the engine can make.
fn plain(scene: &Scene) -> Vec<Mistake> {
    let none = Faults::default();
    let pushes = |push| Faults { push, ..none };
    let mut faults =
        vec![("forces that are not set to 0 before each step", Faults { kept_forces: true, ..none })];
    if scene.sim.self_collision == SelfCollision::SameBox {
        faults.extend([
            (
                "self-collision that pushes the other points too, each by its own distance",
                pushes(Push::MeanAndEach),
            ),
            ("self-collision that pushes the other points too, by the mean", pushes(Push::MeanBack)),
            ("self-collision that pushes both points of each pair by the whole distance", pushes(Push::Both)),
            (
                "self-collision that pushes both points of each pair by half of the distance",
                pushes(Push::BothHalf),
            ),
            ("self-collision not divided by the steps of a frame", Faults { whole_push: true, ..none }),
            ("cells of 3 width / (W - 1) instead of 3 width / W", Faults { wide_cells: true, ..none }),
        ]);
    }
    if scene.sim.stretch_limit.is_some() {
        let limit = "a stretch limit along the vector between the points, which has not the length 1";
        faults.push((limit, Faults { unnormalised_limit: true, ..none }));
    }
    faults.into_iter().map(|(name, faults)| changed(name, scene, Change::Plain(faults))).collect()
}

/// The mistakes that a changed scene makes.
fn scenes(scene: &Scene) -> Vec<Mistake> {
    let with = |name: &str, change: fn(&mut Scene)| {
        let mut scene = scene.clone();
        change(&mut scene);
        Mistake::of(name, scene)
    };
    let with_cloth = |name: &str, change: fn(&mut Cloth)| {
        let mut scene = scene.clone();
        scene.cloth.as_mut().into_iter().for_each(change);
        Mistake::of(name, scene)
    };
    vec![
        with_cloth("points width / W apart instead of width / (W - 1)", wide_pitch),
        with_cloth("pins read as [row, column] instead of [column, row]", |cloth| {
            cloth.pinned.iter_mut().for_each(|pin| pin.reverse());
        }),
        with_cloth("pin k read as a list of columns of row k", |cloth| cloth.pinned = lists(&cloth.pinned)),
        with_cloth("the other orientation", |cloth| {
            cloth.orientation = match cloth.orientation {
                Orientation::Horizontal => Orientation::Vertical,
                Orientation::Vertical => Orientation::Horizontal,
            };
        }),
        with_cloth("no pins", |cloth| cloth.pinned.clear()),
        with_cloth("damping not divided by 100", |cloth| cloth.damping *= 100.0),
        with_cloth("no damping", |cloth| cloth.damping = 0.0),
        with_cloth("mass of a point by (W - 1) (H - 1) instead of W H", |cloth| {
            cloth.density *= few_points(cloth)
        }),
        with_cloth("no bending springs", |cloth| cloth.enable_bending = false),
        with_cloth("no shearing springs", |cloth| cloth.enable_shearing = false),
        with("gravity of 9.81 instead of 9.8 m/s²", |scene| scene.sim.gravity *= 9.81 / 9.8),
        with("gravity upwards", |scene| scene.sim.gravity = -scene.sim.gravity),
        with("a step as long as a frame", |scene| scene.sim.fps /= f64::from(scene.sim.steps_per_frame)),
        with("no stretch limit", |scene| scene.sim.stretch_limit = None),
        with("no self-collision", |scene| scene.sim.self_collision = SelfCollision::Off),
        with_cloth("self-collision from thickness on, not from twice that", |cloth| cloth.thickness *= 0.5),
        with("self-collision with points of other cells too (cells told apart by a hash)", |scene| {
            scene.sim.self_collision = SelfCollision::Neighbors;
        }),
        with("friction f where 1 - f belongs", |scene| {
            let frictions = scene.colliders.iter_mut().map(Collider::friction_mut);
            frictions.for_each(|friction| *friction = (1.0 - *friction).max(0.0));
        }),
    ]
}

fn bending(scene: &Scene, ks: f64) -> [Mistake; 2] {
    let mut soft = scene.clone();
    soft.cloth.iter_mut().for_each(|cloth| cloth.ks = ks * 0.2);
    [
        changed("bending springs as stiff as the others, without the 0.2", scene, Change::Bending(ks)),
        changed("0.2 ks for all springs, not for bending springs alone", &soft, Change::Bending(ks * 0.2)),
    ]
}

fn plane_offsets(scene: &Scene) -> [Mistake; 2] {
    [
        changed("points put onto the plane, not 0.0001 m above it", scene, Change::PlaneOffset(0.0)),
        changed("points put 0.0001 m behind the plane, not above it", scene, Change::PlaneOffset(-1e-4)),
    ]
}

/// Faulty hashes by which programs were found to tell cells apart. A hash shows only where it merges
/// neighbouring cells: points of other cells are not close.
fn cell_hashes(scene: &Scene) -> [Mistake; 2] {
    let cut = "cells by coordinates cut towards zero, not rounded down, so that those beside 0 are one";
    let sum = "cells told apart by x² + y² + z³ of coordinates cut towards zero";
    [
        changed(cut, scene, Change::CellHash(|numbers| joined(numbers.map(towards_zero)))),
        changed(
            sum,
            scene,
            Change::CellHash(|numbers| {
                let [x, y, z] = numbers.map(towards_zero).map(Wrapping);
                (x * x + y * y + z * z * z).0
            }),
        ),
    ]
}

/// The number that truncation gives for what rounding down gives `number`.
fn towards_zero(number: i64) -> i64 {
    if number < 0 { number + 1 } else { number }
}

/// Three numbers of 21 bits as one.
fn joined([x, y, z]: [i64; 3]) -> i64 {
    let bits = |number: i64| number & 0x1F_FFFF;
    bits(x) << 42 | bits(y) << 21 | bits(z)
}

fn changed(name: &str, scene: &Scene, change: Change) -> Mistake {
    Mistake { name: name.to_owned(), scene: scene.clone(), change: Some(change) }
}

/// A smaller cloth of the same mass and with the same number of points.
fn wide_pitch(cloth: &mut Cloth) {
    let smaller = |length: f64, points: usize| length * (points - 1) as f64 / points as f64;
    let area = cloth.width * cloth.height;
    cloth.width = smaller(cloth.width, cloth.num_width_points);
    cloth.height = smaller(cloth.height, cloth.num_height_points);
    cloth.density *= area / (cloth.width * cloth.height);
}

/// W H / ((W - 1) (H - 1)).
fn few_points(cloth: &Cloth) -> f64 {
    let ratio = |points: usize| points as f64 / (points - 1) as f64;
    ratio(cloth.num_width_points) * ratio(cloth.num_height_points)
}

/// The points of row k whose columns pin k names, each once.
fn lists(pins: &[[usize; 2]]) -> Vec<[usize; 2]> {
    let mut points: Vec<[usize; 2]> =
        pins.iter().enumerate().flat_map(|(row, columns)| columns.map(|column| [column, row])).collect();
    points.sort_unstable();
    points.dedup();
    points
}
