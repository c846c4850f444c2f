//! The mesh of a plane: a square.

use super::{Mesh, in_plane, round, unit};
use crate::scene::{Needs, Plane, Vec3};

impl Mesh {
    /// The 4 m × 4 m square of a plane, a strip of two triangles around its point.
    pub fn plane(plane: &Plane, needs: Needs) -> Self {
        let n = unit(plane.normal);
        let p = in_plane(&n);
        let c = n.cross(&p);
        let corners = [c + p, c - p, -c + p, -c - p].map(|side| round(plane.point + side * 2.0));
        let per_corner = |read: bool, value: Vec3| if read { vec![round(value); 4] } else { Vec::new() };
        Self {
            positions: corners.to_vec(),
            normals: per_corner(needs.normal, n),
            tangents: per_corner(needs.tangent, -p),
            uvs: if needs.uv { vec![[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]] } else { Vec::new() },
            triangles: vec![[0, 1, 2], [2, 1, 3]],
        }
    }
}
