//! The mesh of a box: six flat faces.

use super::{Mesh, round};
use crate::scene::{Cuboid, Needs, Vec3};

/// Part of its size at which a box is drawn, so that the cloth's flat triangles do not cut it.
const DRAWN_SIZE: f64 = 0.98;

impl Mesh {
    /// The faces of a box, in the order +x, -x, +y, -y, +z, -z: four vertices each, with the texture once on each face.
    pub fn cuboid(cuboid: &Cuboid, needs: Needs) -> Self {
        let mut mesh = Self::default();
        let half = cuboid.size * (0.5 * DRAWN_SIZE);
        for (face, (axis, side)) in (0..).zip((0..3).flat_map(|axis| [(axis, 1.0), (axis, -1.0)])) {
            let along = |axis: usize| Vec3::ith(axis % 3, 1.0);
            let (normal, tangent) = (along(axis) * side, along(axis + 1));
            let up = normal.cross(&tangent);
            for (u, v) in [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0)] {
                let corner = normal + tangent * (2.0 * f64::from(u) - 1.0) + up * (2.0 * f64::from(v) - 1.0);
                mesh.positions.push(round(cuboid.origin + corner.component_mul(&half)));
                mesh.normals.extend(needs.normal.then(|| round(normal)));
                mesh.tangents.extend(needs.tangent.then(|| round(tangent)));
                mesh.uvs.extend(needs.uv.then_some([u, v]));
            }
            let [a, b, c, d] = [0, 1, 2, 3].map(|corner| 4 * face + corner);
            mesh.triangles.extend([[a, b, c], [c, b, d]]);
        }
        mesh
    }
}
