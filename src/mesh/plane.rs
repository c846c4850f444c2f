//! The mesh of a plane: a square.
//!
//! Its picture lies in its middle, as wide and high as the square's diagonal, so that it does not repeat. Seen from
//! the side of the normal, words on it are readable, and upright for a camera of azimuth 0: up is -z on a floor, +z
//! on a ceiling, and +y on a wall (any plane steeper than 45 degrees).

use super::{Mesh, in_plane, round, to_f32, upwards};
use crate::math::unit;
use crate::scene::{Needs, Plane, Vec3};

/// Length of the sides, in metres.
const SIDE: f64 = 4.0;

/// Length of the sides of the picture.
const PICTURE: f64 = SIDE * std::f64::consts::SQRT_2;

impl Mesh {
    /// The 4 m × 4 m square of a plane, a strip of two triangles around its point.
    pub fn plane(plane: &Plane, needs: Needs) -> Self {
        let n = unit(plane.normal);
        let p = in_plane(&n);
        let c = n.cross(&p);
        let sides = [c + p, c - p, -c + p, -c - p].map(|side| side * SIDE / 2.0);
        let up = upwards(&n);
        let right = up.cross(&n);
        let uv = |side: Vec3| [0.5 + side.dot(&right) / PICTURE, 0.5 - side.dot(&up) / PICTURE].map(to_f32);
        let per_corner = |read: bool, value: Vec3| if read { vec![round(value); 4] } else { Vec::new() };
        Self {
            positions: sides.map(|side| round(plane.point + side)).to_vec(),
            normals: per_corner(needs.normal, n),
            tangents: per_corner(needs.tangent, right),
            uvs: if needs.uv { sides.map(uv).to_vec() } else { Vec::new() },
            triangles: vec![[0, 1, 2], [2, 1, 3]],
        }
    }
}
