//! The mesh of a box: six flat faces.
//!
//! Each has the whole picture, readable from outside. It is upright as on a plane of the same normal: up is +y on the four
//! sides, -z on the top and +z on the bottom.

use super::{Mesh, round, to_f32, upwards};
use crate::scene::{Cuboid, Needs, Vec3};

/// Part of its size at which a box is drawn, so that the cloth's flat triangles do not cut it.
const DRAWN_SIZE: f64 = 0.98;

impl Mesh {
    /// The faces of a box, in the order +x, -x, +y, -y, +z, -z: four vertices each.
    pub fn cuboid(cuboid: &Cuboid, needs: Needs) -> Self {
        let mut mesh = Self::default();
        let half = cuboid.size * (0.5 * DRAWN_SIZE);
        for (face, (axis, side)) in (0..).zip((0..3).flat_map(|axis| [(axis, 1.0), (axis, -1.0)])) {
            let along = |axis: usize| Vec3::ith(axis % 3, 1.0);
            let (normal, first) = (along(axis) * side, along(axis + 1));
            let second = normal.cross(&first);
            let up = upwards(&normal);
            let right = up.cross(&normal);
            let uv =
                |corner: Vec3| [1.0 + corner.dot(&right), 1.0 - corner.dot(&up)].map(|c| to_f32(c / 2.0));
            for (s, t) in [(-1.0, -1.0), (1.0, -1.0), (-1.0, 1.0), (1.0, 1.0)] {
                let corner = normal + first * s + second * t;
                mesh.positions.push(round(cuboid.origin + corner.component_mul(&half)));
                mesh.normals.extend(needs.normal.then(|| round(normal)));
                mesh.tangents.extend(needs.tangent.then(|| round(right)));
                mesh.uvs.extend(needs.uv.then(|| uv(corner)));
            }
            let [a, b, c, d] = [0, 1, 2, 3].map(|corner| 4 * face + corner);
            mesh.triangles.extend([[a, b, c], [c, b, d]]);
        }
        mesh
    }
}
