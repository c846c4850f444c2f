//! Mistakes that programs of students make, each run here as a changed scene.

use crate::cloth::springs::SpringKind;
use crate::error::Result;
use crate::scene::{Cloth, Scene, SelfCollision};
use crate::simulation::Simulation;

/// A mistake, and the scene with which the method does what the mistaken program does.
pub(super) struct Mistake {
    /// What is done instead of what.
    pub(super) name: &'static str,
    scene: Scene,
    /// Stiffness of bending springs, in N/m, if it is not that of the scene.
    bending: Option<f64>,
}

impl Mistake {
    /// A simulation that makes the mistake.
    ///
    /// # Errors
    /// As [`Simulation::new`].
    pub(super) fn simulation(&self) -> Result<Simulation> {
        let mut simulation = Simulation::new(&self.scene)?;
        self.bending.into_iter().for_each(|k| simulation.set_stiffness(SpringKind::Bending, k));
        simulation.allow_unstable();
        Ok(simulation)
    }
}

/// The mistakes that change anything in `scene`.
pub(super) fn all(scene: &Scene) -> Vec<Mistake> {
    let Some(cloth) = &scene.cloth else { return Vec::new() };
    let with = |name, change: &dyn Fn(&mut Cloth)| {
        let mut scene = scene.clone();
        scene.cloth.as_mut().into_iter().for_each(change);
        Mistake { name, scene, bending: None }
    };
    let ks = cloth.ks;
    let scenes = [
        with("points width / W apart instead of width / (W - 1)", &wide_pitch),
        with("pins read as [row, column] instead of [column, row]", &|cloth| {
            cloth.pinned.iter_mut().for_each(|pin| pin.reverse());
        }),
        with("pin k read as a list of columns of row k", &|cloth| cloth.pinned = lists(&cloth.pinned)),
        with("damping not divided by 100", &|cloth| cloth.damping *= 100.0),
        without("no self-collision", scene, |scene| scene.sim.self_collision = SelfCollision::Off),
        without(
            "self-collision with points of other boxes too (boxes told apart by a rounded or cut number)",
            scene,
            |scene| {
                scene.sim.self_collision = SelfCollision::Neighbors;
            },
        ),
        without("no stretch limit", scene, |scene| scene.sim.stretch_limit = None),
    ];
    let fits = |cloth: &Cloth| {
        cloth.pinned.iter().all(|&[i, j]| i < cloth.num_width_points && j < cloth.num_height_points)
    };
    let changed = scenes.into_iter().filter(|mistake| mistake.scene != *scene);
    let possible = changed.filter(|mistake| mistake.scene.cloth.as_ref().is_some_and(fits));
    let mut mistakes: Vec<Mistake> = possible.collect();
    if cloth.enable_bending && ks > 0.0 {
        let stiff = with("bending springs as stiff as the others, without the 0.2", &|_| ());
        mistakes.push(Mistake { bending: Some(ks), ..stiff });
        let soft =
            with("0.2 ks for all springs, not for bending springs alone", &|cloth| cloth.ks = ks * 0.2);
        mistakes.push(Mistake { bending: Some(ks * 0.2), ..soft });
    }
    mistakes
}

fn without(name: &'static str, scene: &Scene, change: impl Fn(&mut Scene)) -> Mistake {
    let mut scene = scene.clone();
    change(&mut scene);
    Mistake { name, scene, bending: None }
}

/// A smaller cloth of the same mass and with the same number of points.
fn wide_pitch(cloth: &mut Cloth) {
    let smaller = |length: f64, points: usize| length * (points - 1) as f64 / points as f64;
    let area = cloth.width * cloth.height;
    cloth.width = smaller(cloth.width, cloth.num_width_points);
    cloth.height = smaller(cloth.height, cloth.num_height_points);
    cloth.density *= area / (cloth.width * cloth.height);
}

/// The points of row k whose columns pin k names, each once.
fn lists(pins: &[[usize; 2]]) -> Vec<[usize; 2]> {
    let mut points: Vec<[usize; 2]> =
        pins.iter().enumerate().flat_map(|(row, columns)| columns.map(|column| [column, row])).collect();
    points.sort_unstable();
    points.dedup();
    points
}
