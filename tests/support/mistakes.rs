//! The textbook cloth with the mistakes that programs of students make.

use drape::scene::Scene;

use crate::textbook_cloth::{Cloth, Vector};

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

/// The cloth of `scene` with `mistakes`.
pub(crate) fn cloth(scene: &Scene, mistakes: Mistakes) -> Cloth<'_> {
    let mut cloth = Cloth::new(scene);
    let settings = scene.cloth.as_ref().expect("a cloth");
    let w = settings.num_width_points;
    if mistakes.pitch {
        let apart = |size: f64, k: usize, points: usize| size * k as f64 / points as f64;
        let place = |p: usize| {
            [apart(settings.width, p % w, w), 1.0, apart(settings.height, p / w, settings.num_height_points)]
        };
        let x = (0..cloth.x.len()).map(place).collect();
        start_at(&mut cloth, x);
    }
    if mistakes.pins_are_rows || mistakes.pins_are_lists {
        cloth.pinned.fill(false);
    }
    for (k, &[i, j]) in settings.pinned.iter().enumerate() {
        if mistakes.pins_are_rows {
            cloth.pinned[i * w + j] = true;
        }
        if mistakes.pins_are_lists {
            [i, j].into_iter().for_each(|column| cloth.pinned[k * w + column] = true);
        }
    }
    for spring in &mut cloth.springs {
        if mistakes.soft_springs {
            spring.stiffness = settings.ks * 0.2;
        } else if mistakes.stiff_bending {
            spring.stiffness = settings.ks;
        }
    }
    if mistakes.damping_is_a_fraction {
        cloth.velocity_retention = 1.0 - settings.damping;
    }
    if mistakes.no_plane_offset {
        cloth.plane_offset = 0.0;
    }
    if mistakes.cut_boxes {
        cloth.box_of = |x| x.map(|value| value.trunc() as i64);
    }
    if mistakes.float_hash {
        cloth.box_of = |x| {
            let [x, y, z] = x.map(|value| value.trunc() as f32);
            [(x * x + y * y + z * z * z) as i64, 0, 0]
        };
    }
    cloth
}

/// A phase that is done differently from the method.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Fault {
    /// The forces of earlier steps stay.
    KeptForces,
    /// Both points of a pair that is too close are pushed, one after the other pair.
    PushBoth,
    /// A point is pushed by the whole mean, not by that over the steps of a frame.
    WholePush,
    /// The stretch limit multiplies the excess by the vector between the points, not by its direction.
    UnnormalisedLimit,
}

/// One step of `cloth` with a fault; `kept` are the forces of earlier steps.
pub(crate) fn faulty_step(scene: &Scene, cloth: &mut Cloth<'_>, fault: Fault, kept: &mut Vec<Vector>) {
    let mut forces = cloth.forces();
    if matches!(fault, Fault::KeptForces) {
        kept.resize(forces.len(), [0.0; 3]);
        for (force, kept) in forces.iter_mut().zip(kept.iter_mut()) {
            *force = [0, 1, 2].map(|c| force[c] + kept[c]);
            *kept = *force;
        }
    }
    cloth.integrate(&forces);
    match fault {
        Fault::PushBoth | Fault::WholePush => push(scene, cloth, matches!(fault, Fault::PushBoth)),
        _ => cloth.collide_with_itself(),
    }
    cloth.collide_with_objects();
    match fault {
        Fault::UnnormalisedLimit => limit(cloth),
        _ => cloth.limit_stretch(),
    }
}

fn push(scene: &Scene, cloth: &mut Cloth<'_>, both: bool) {
    let settings = scene.cloth.as_ref().expect("a cloth");
    let spread = if both { f64::from(scene.sim.steps_per_frame) } else { 1.0 };
    let size = |length: f64, points: usize| 3.0 * length / points as f64;
    let sizes =
        [size(settings.width, settings.num_width_points), size(settings.height, settings.num_height_points)];
    let sizes = [sizes[0], sizes[1], sizes[0].max(sizes[1])];
    let boxes: Vec<[i64; 3]> =
        cloth.x.iter().map(|x| [0, 1, 2].map(|c| (x[c] / sizes[c]).floor() as i64)).collect();
    for p in (0..cloth.x.len()).filter(|&p| !cloth.pinned[p]).collect::<Vec<_>>() {
        let (mut sum, mut count) = ([0.0; 3], 0.0);
        for other in (0..cloth.x.len()).filter(|&other| other != p && boxes[other] == boxes[p]) {
            let l = length(cloth.x[p], cloth.x[other]);
            if !(0.0 < l && l < 2.0 * settings.thickness) {
                continue;
            }
            let part = (2.0 * settings.thickness - l) / l;
            let away = [0, 1, 2].map(|c| (cloth.x[p][c] - cloth.x[other][c]) * part);
            if both {
                cloth.x[p] = [0, 1, 2].map(|c| cloth.x[p][c] + away[c] / spread);
                if !cloth.pinned[other] {
                    cloth.x[other] = [0, 1, 2].map(|c| cloth.x[other][c] - away[c] / spread);
                }
            }
            sum = [0, 1, 2].map(|c| sum[c] + away[c]);
            count += 1.0;
        }
        if count > 0.0 && !both {
            cloth.x[p] = [0, 1, 2].map(|c| cloth.x[p][c] + sum[c] / count / spread);
        }
    }
}

fn limit(cloth: &mut Cloth<'_>) {
    for i in 0..cloth.springs.len() {
        let (a, b, longest) = (cloth.springs[i].a, cloth.springs[i].b, 1.1 * cloth.springs[i].rest);
        let l = length(cloth.x[a], cloth.x[b]);
        if l > longest {
            let excess = [0, 1, 2].map(|c| (cloth.x[b][c] - cloth.x[a][c]) * (l - longest));
            let part = if cloth.pinned[a] || cloth.pinned[b] { 1.0 } else { 0.5 };
            if !cloth.pinned[a] {
                cloth.x[a] = [0, 1, 2].map(|c| cloth.x[a][c] + part * excess[c]);
            }
            if !cloth.pinned[b] {
                cloth.x[b] = [0, 1, 2].map(|c| cloth.x[b][c] - part * excess[c]);
            }
        }
    }
}

/// Puts the points of `cloth` at `x`, where the springs are at rest.
pub(crate) fn start_at(cloth: &mut Cloth<'_>, x: Vec<Vector>) {
    for spring in &mut cloth.springs {
        spring.rest = length(x[spring.a], x[spring.b]);
    }
    cloth.last.clone_from(&x);
    cloth.x = x;
}

/// The distance of two points, with the squares summed from left to right.
fn length(a: Vector, b: Vector) -> f64 {
    let [x, y, z] = [0, 1, 2].map(|c| (a[c] - b[c]) * (a[c] - b[c]));
    (x + y + z).sqrt()
}
