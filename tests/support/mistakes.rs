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
