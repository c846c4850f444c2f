//! The cube map `cube`: a footbridge over a lake, low sun. Every colour follows from a direction.

use drape::math::exp;

use super::bridge;
use super::color::{Color, add, mix, scale};
use super::landscape;
use super::{Picture, SIZE, paint as paint_each};

/// A direction of length 1. +y is up, the horizon is at y = 0.
pub(super) type Ray = [f64; 3];

/// The faces with the direction of their middle, of rising s and of rising t (OpenGL 4.6, table 8.19).
const FACES: [(&str, [Ray; 3]); 6] = [
    ("cube/posx", [[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, -1.0, 0.0]]),
    ("cube/negx", [[-1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]]),
    ("cube/posy", [[0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]),
    ("cube/negy", [[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, -1.0]]),
    ("cube/posz", [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, -1.0, 0.0]]),
    ("cube/negz", [[0.0, 0.0, -1.0], [-1.0, 0.0, 0.0], [0.0, -1.0, 0.0]]),
];

/// Rays a texel is the mean of, along each side.
const FINE: usize = 3;

pub(super) fn paint() -> [(&'static str, Picture); 6] {
    FACES.map(|(name, axes)| (name, paint_each(|u, v| mean(axes, u, v))))
}

/// The mean colour of a texel whose middle is (u, v). The bridge has hard edges and is met by many
/// rays; the landscape is smooth and looked up once.
fn mean(axes: [Ray; 3], u: f64, v: f64) -> Color {
    let place = |i: usize| ((i as f64 + 0.5) / FINE as f64 - 0.5) / SIZE as f64;
    let rays = (0..FINE * FINE).map(|i| direction(axes, u + place(i % FINE), v + place(i / FINE)));
    let hits: Vec<Color> = rays.filter_map(bridge).collect();
    let mut sum = hits.iter().copied().fold([0.0; 3], add);
    let open = FINE * FINE - hits.len();
    if open > 0 {
        sum = add(sum, scale(landscape::seen(direction(axes, u, v)), open as f64));
    }
    scale(sum, 1.0 / (FINE * FINE) as f64)
}

/// The bridge along a ray, paler far away.
fn bridge(ray: Ray) -> Option<Color> {
    let hit = bridge::hit(ray)?;
    Some(mix(hit.color, landscape::haze(ray), 1.0 - exp(-hit.distance / 160.0)))
}

/// The direction through a place of a face, of length 1.
fn direction([middle, right, down]: [Ray; 3], u: f64, v: f64) -> Ray {
    let (s, t) = (2.0 * u - 1.0, 2.0 * v - 1.0);
    let length = (1.0 + s * s + t * t).sqrt();
    [0, 1, 2].map(|i| (middle[i] + right[i] * s + down[i] * t) / length)
}
