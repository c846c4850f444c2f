//! Where the geometry of a scene cannot hold, known before the first step: contact is of points, so what fits between
//! the points passes through the cloth; and what starts inside an object starts wrong.

use crate::cloth::Points;
use crate::cloth::grid::{self, Grid, Pins};
use crate::error::Result;
use crate::math::unit;
use crate::scene::{Cloth, Collider, Contact, Cuboid, Plane, Scene, SelfCollision, Sphere, Vec3};

/// The code of points that start inside an object.
pub const STARTS_INSIDE: &str = "geometry::starts_inside";

/// Something that will not hold.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Concern {
    /// What it is, such as `geometry::starts_inside`.
    pub code: &'static str,
    /// The key of the scene that it is about.
    pub key: String,
    /// What does not hold, with its figures.
    pub message: String,
    /// What would do.
    pub help: String,
}

/// Every concern about the geometry of `scene`.
///
/// # Errors
/// [`crate::error::Kind::Scene`] for a cloth that no simulation accepts.
pub fn concerns(scene: &Scene) -> Result<Vec<Concern>> {
    let Some(cloth) = &scene.cloth else { return Ok(Vec::new()) };
    let grid = Grid::new(cloth)?;
    let (x, pins) = (grid::start(cloth, grid)?, Pins::new(cloth, grid)?);
    let start = Start { scene, x: &x, pins: &pins };
    let mut found: Vec<Concern> = too_thin(scene, cloth).into_iter().collect();
    let mut number = 0;
    let mut kind = None;
    for collider in &scene.colliders {
        number = if kind == Some(collider.kind()) { number + 1 } else { 0 };
        kind = Some(collider.kind());
        let several = scene.collider_counts()[collider.kind()] > 1;
        let key = collider.kind().key();
        let key = if several { format!("{key}.{number}") } else { key.to_owned() };
        found.extend(fits_between(cloth, collider, &key));
        found.extend(match collider {
            Collider::Plane(plane) => start.beyond(plane, key),
            Collider::Sphere(ball) => start.inside(key, |x| above_ball(ball, x)),
            Collider::Cuboid(cuboid) => start.inside(key, |x| above_box(cuboid, x)),
        });
    }
    Ok(found)
}

/// Distances of neighbouring points along both sides of the grid, in metres.
fn spacing(cloth: &Cloth) -> [f64; 2] {
    [(cloth.width, cloth.num_width_points), (cloth.height, cloth.num_height_points)]
        .map(|(length, points)| length / (points - 1) as f64)
}

/// Distance of the middle between four points from each of them, in metres: what keeps less passes there.
fn gap(cloth: &Cloth) -> f64 {
    let [dx, dy] = spacing(cloth);
    0.5 * (dx * dx + dy * dy).sqrt()
}

/// The fewest points along each side at which the gap is at most `gap`.
fn points_for(cloth: &Cloth, gap: f64) -> String {
    let side = |length: f64| (length / (gap * std::f64::consts::SQRT_2)).ceil() + 1.0;
    let [w, h] = [side(cloth.width), side(cloth.height)];
    format!("cloth.num_width_points to {w} and cloth.num_height_points to {h}")
}

/// Layers of cloth that pass between each other's points.
fn too_thin(scene: &Scene, cloth: &Cloth) -> Option<Concern> {
    let (gap, kept) = (gap(cloth), 2.0 * cloth.thickness);
    if scene.sim.self_collision == SelfCollision::Off || kept == 0.0 || kept >= gap {
        return None;
    }
    Some(Concern {
        code: "geometry::thin",
        key: "cloth.thickness".into(),
        message: format!(
            "2 x thickness is {kept} m, and a point is {gap:.4} m from the next in the middle of four: the cloth passes \
             through itself there"
        ),
        help: format!("raise cloth.thickness to {}, or {}", rounded_up(0.5 * gap), points_for(cloth, kept)),
    })
}

/// An object that the cloth falls through because it meets none of the points.
fn fits_between(cloth: &Cloth, collider: &Collider, key: &str) -> Option<Concern> {
    let [dx, dy] = spacing(cloth);
    // What it has, whether that is enough, how much would be, and the gap that would be small enough for it.
    let (has, holds, enough, small) = match collider {
        Collider::Plane(_) => return None,
        Collider::Sphere(ball) => {
            let gap = gap(cloth);
            (format!("a radius of {} m", ball.radius), ball.radius >= gap, gap, ball.radius)
        }
        Collider::Cuboid(Cuboid { size, .. }) => {
            let mut sides = [size.x, size.y, size.z];
            sides.sort_unstable_by(f64::total_cmp);
            let [thin, wide, _] = sides;
            let holds = thin >= dx.min(dy) || wide >= dx.max(dy);
            let has = format!("edges of only {thin} m and {wide} m");
            (has, holds, dx.min(dy), thin / std::f64::consts::SQRT_2)
        }
    };
    (!holds).then(|| Concern {
        code: "geometry::fits_between",
        key: key.to_owned(),
        message: format!("`{key}` has {has} and fits between the points of the cloth: it may fall through"),
        help: format!("make that at least {} m, or raise {}", rounded_up(enough), points_for(cloth, small)),
    })
}

/// The points at the start.
struct Start<'a> {
    scene: &'a Scene,
    x: &'a Points,
    pins: &'a Pins,
}

impl Start<'_> {
    fn free(&self) -> impl Iterator<Item = Vec3> {
        self.pins.free.iter().cloned().flatten().map(|p| self.x.get(p))
    }

    /// Points inside an object whose surface `above` tells how far straight up a point inside would have to go.
    fn inside(&self, key: String, above: impl Fn(Vec3) -> Option<f64>) -> Option<Concern> {
        let heights: Vec<f64> = self.free().filter_map(&above).collect();
        let up = heights.iter().copied().fold(0.0, f64::max);
        if heights.is_empty() {
            return None;
        }
        let what = match self.scene.sim.contact {
            Contact::Coulomb => "they are put on its surface, at rest",
            _ => {
                "they get a speed that nothing gave them when they are put outside (not with `sim.contact` = `coulomb`)"
            }
        };
        Some(Concern {
            code: STARTS_INSIDE,
            message: format!("{} points of the cloth start inside `{key}`: {what}", heights.len()),
            help: format!("start above it: raise cloth.offset.1 by {}", rounded_up(up)),
            key,
        })
    }

    /// Points under a plane, on the side from which its normal points away.
    fn beyond(&self, plane: &Plane, key: String) -> Option<Concern> {
        let normal = unit(plane.normal);
        let heights: Vec<f64> = self.free().map(|x| (x - plane.point).dot(&normal)).collect();
        let deepest = heights.iter().copied().fold(0.0, f64::min);
        let under = heights.iter().filter(|height| **height < 0.0).count();
        if under == 0 {
            return None;
        }
        let message = if under == heights.len() {
            format!("the cloth starts under `{key}`: a plane is a sheet, and below it nothing is held up")
        } else {
            format!(
                "the cloth starts across `{key}`: {under} of {} points are below it, and stay there",
                heights.len()
            )
        };
        let by = normal * rounded_up(-deepest);
        let help = format!("start above it: add [{}, {}, {}] to cloth.offset", by.x, by.y, by.z);
        Some(Concern { code: "geometry::under_plane", key, message, help })
    }
}

/// How far above `x`, which is inside the ball, its surface is.
fn above_ball(ball: &Sphere, x: Vec3) -> Option<f64> {
    let e = x - ball.origin;
    let flat = e.x * e.x + e.z * e.z;
    (flat + e.y * e.y < ball.radius * ball.radius).then(|| (ball.radius * ball.radius - flat).sqrt() - e.y)
}

/// How far above `x`, which is inside the box, its top is.
fn above_box(cuboid: &Cuboid, x: Vec3) -> Option<f64> {
    let [lower, upper] = cuboid.corners();
    let inside = (0..3).all(|axis| lower[axis] < x[axis] && x[axis] < upper[axis]);
    inside.then(|| upper.y - x.y)
}

/// A number of three digits that is not below `value`, and at most 1 % above it.
fn rounded_up(value: f64) -> f64 {
    let parse = |value: f64| format!("{value:.2e}").parse().unwrap_or(value);
    let near: f64 = parse(value);
    if near >= value { near } else { parse(value * 1.01) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_rounded_up_to_three_digits() {
        for (value, expected) in [(0.0, 0.0), (1.0, 1.0), (0.123_41, 0.125), (0.123_6, 0.124), (9.991, 10.1)]
        {
            let found = rounded_up(value);
            assert!(found >= value && (found - expected).abs() < 1e-12, "{value}: {found}");
        }
    }
}
