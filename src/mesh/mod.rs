//! Triangles and lines to draw: of the cloth, and of each kind of collider.
//!
//! Geometry is computed in f64 and rounded once to f32. An attribute that no shader reads is not
//! computed: its array stays empty.

use nalgebra::Vector3;

use crate::math::{length, unit};
use crate::scene::{Collider, Needs, Vec3};
use crate::share::share_out;

mod cloth;
mod cuboid;
mod lines;
mod plane;
mod sphere;

pub use lines::{SpringKinds, spring_lines};

/// Rows of a grid that one thread takes at a time.
const BAND: usize = 32;

/// Attributes per vertex and the triangles over them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// `in_position`, model space, metres.
    pub positions: Vec<[f32; 3]>,
    /// `in_normal`, unit; empty when not read.
    pub normals: Vec<[f32; 3]>,
    /// `in_tangent`, unit; empty when not read.
    pub tangents: Vec<[f32; 3]>,
    /// `in_uv`; empty when not read.
    pub uvs: Vec<[f32; 2]>,
    /// Vertex indices of each triangle.
    pub triangles: Vec<[u32; 3]>,
}

/// The attributes of one vertex, as a vertex program gets them. What is not read is zero.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Attributes {
    /// `in_position`
    pub in_position: [f32; 3],
    /// `in_normal`
    pub in_normal: [f32; 3],
    /// `in_tangent`
    pub in_tangent: [f32; 3],
    /// `in_uv`
    pub in_uv: [f32; 2],
}

/// Where a mesh stands in the world: it is scaled, then moved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placement {
    /// Where the origin of the mesh goes, in metres.
    pub origin: Vec3,
    /// The scale.
    pub scale: f64,
}

impl Placement {
    /// Of a mesh in world space.
    pub const WORLD: Self = Self { origin: Vec3::new(0.0, 0.0, 0.0), scale: 1.0 };
}

impl Mesh {
    /// The mesh of `collider`, and where it stands.
    pub fn collider(collider: &Collider, needs: Needs) -> (Self, Placement) {
        match collider {
            Collider::Plane(plane) => (Self::plane(plane, needs), Placement::WORLD),
            Collider::Sphere(sphere) => (Self::sphere(sphere, needs), Placement::of_sphere(sphere)),
            Collider::Cuboid(cuboid) => (Self::cuboid(cuboid, needs), Placement::WORLD),
        }
    }

    /// The attributes of vertex `index`.
    pub fn vertex(&self, index: usize) -> Attributes {
        Attributes {
            in_position: self.positions[index],
            in_normal: self.normals.get(index).copied().unwrap_or_default(),
            in_tangent: self.tangents.get(index).copied().unwrap_or_default(),
            in_uv: self.uvs.get(index).copied().unwrap_or_default(),
        }
    }
}

/// Two triangles per cell of a `columns` × `rows` grid of vertices, cells row-major, made by
/// `split` from the corners (x, y), (x+1, y), (x, y+1), (x+1, y+1).
fn set_grid_triangles(
    triangles: &mut Vec<[u32; 3]>,
    columns: usize,
    rows: usize,
    split: impl Fn(u32, u32, u32, u32) -> [[u32; 3]; 2] + Sync,
) {
    let cells = columns - 1;
    triangles.resize(2 * cells * (rows - 1), [0; 3]);
    share_out(triangles.chunks_mut(2 * cells * BAND).enumerate(), |(band, triangles)| {
        for (i, pair) in (band * BAND * cells..).zip(triangles.chunks_exact_mut(2)) {
            let a = index(i / cells * columns + i % cells);
            let c = a + index(columns);
            pair.copy_from_slice(&split(a, a + 1, c, c + 1));
        }
    });
}

/// The direction in a plane of unit normal `n` that is up in its picture, unit.
fn upwards(n: &Vec3) -> Vec3 {
    let flat = n.y * n.y >= 0.5;
    let up = if flat { Vec3::new(0.0, 0.0, -n.y.signum()) } else { Vec3::new(0.0, 1.0, 0.0) };
    unit(up - n * up.dot(n))
}

/// The report's first direction inside a plane of unit normal n: unit, unless n is (1,1,1)/√3,
/// where its formula gives zero and +x made orthogonal stands in.
fn in_plane(n: &Vec3) -> Vec3 {
    let p = Vector3::new(n.y - n.z, n.z - n.x, n.x - n.y);
    unit_or(p, unit_or(Vector3::x() - n * n.x, Vector3::y()))
}

/// The unit vector of `v`, or `otherwise` when `v` has no direction.
fn unit_or(v: Vec3, otherwise: Vec3) -> Vec3 {
    let length = length(v);
    if length > 0.0 && length.is_finite() { v / length } else { otherwise }
}

fn round(v: Vec3) -> [f32; 3] {
    [v.x, v.y, v.z].map(to_f32)
}

#[expect(clippy::cast_possible_truncation, reason = "the one rounding to f32 of the geometry")]
fn to_f32(value: f64) -> f32 {
    value as f32
}

/// A vertex number as the index buffer holds it; scenes are limited to fewer than 2^32 points.
#[expect(clippy::cast_possible_truncation, reason = "the loader limits the number of points")]
fn index(i: usize) -> u32 {
    i as u32
}
