//! Triangles and lines to draw: the cloth, the ball and the plane.
//!
//! Geometry is computed in f64 and rounded once to f32. An attribute that no shader reads is not
//! computed: its array stays empty.

use nalgebra::Vector3;

use crate::{
    cloth::Points,
    math::{cos, sin},
    scene::{Cloth, Needs, Plane, Sphere, Vec3},
};

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

impl Mesh {
    /// The attributes of vertex `index`.
    pub fn vertex(&self, index: usize) -> Attributes {
        Attributes {
            in_position: self.positions[index],
            in_normal: self.normals.get(index).copied().unwrap_or_default(),
            in_tangent: self.tangents.get(index).copied().unwrap_or_default(),
            in_uv: self.uvs.get(index).copied().unwrap_or_default(),
        }
    }

    /// The cloth at `points`: per cell with corners A (x, y), B (x+1, y), C (x, y+1), D (x+1, y+1)
    /// the triangles (A, C, B) and (B, C, D).
    pub fn cloth(cloth: &Cloth, points: &Points, needs: Needs) -> Self {
        let (w, h) = (cloth.num_width_points, cloth.num_height_points);
        let mut mesh = Self {
            positions: (0..points.len()).map(|i| round(points.get(i))).collect(),
            triangles: grid_triangles(w, h, |a, b, c, d| [[a, c, b], [b, c, d]]),
            ..Self::default()
        };
        if needs.normal || needs.tangent {
            let normals = vertex_normals(points, &mesh.triangles);
            if needs.tangent {
                mesh.tangents =
                    (0..points.len()).map(|i| round(row_tangent(points, w, i, &normals[i]))).collect();
            }
            mesh.normals = normals.into_iter().map(round).collect();
        }
        if needs.uv {
            mesh.uvs = grid_uvs(w, h);
        }
        mesh
    }

    /// The unit ball of a sphere's resolution: (lat + 1)(lon + 1) vertices, latitude outer.
    /// With v = i/lat and u = j/lon, λ = πv and θ as in `turn`.
    pub fn sphere(sphere: &Sphere, needs: Needs) -> Self {
        let [lat, lon] = sphere.resolution;
        let mut mesh = Self::default();
        let turns: Vec<_> = (0..=lon).map(|j| turn(f64::from(j) / f64::from(lon))).collect();
        for i in 0..=lat {
            let v = f64::from(i) / f64::from(lat);
            let lambda = std::f64::consts::PI * v;
            let (sin_lambda, cos_lambda) = (sin(lambda), cos(lambda));
            for &(u, sin_theta, cos_theta) in &turns {
                let normal = Vector3::new(sin_lambda * sin_theta, cos_lambda, sin_lambda * cos_theta);
                mesh.positions.push(round(normal));
                if needs.normal {
                    mesh.normals.push(round(normal));
                }
                if needs.tangent {
                    mesh.tangents.push(round(Vector3::new(cos_theta, 0.0, -sin_theta)));
                }
                if needs.uv {
                    mesh.uvs.push([u, v].map(to_f32));
                }
            }
        }
        let (columns, rows) = (lon as usize + 1, lat as usize + 1);
        mesh.triangles = grid_triangles(columns, rows, |a, b, c, d| [[a, c, d], [d, b, a]]);
        mesh
    }

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

/// u, sin θ and cos θ of a ball's meridian: θ = 2π((u + 0.5) mod 1).
fn turn(u: f64) -> (f64, f64, f64) {
    let turn = u + 0.5;
    let theta = 2.0 * std::f64::consts::PI * (turn - turn.floor());
    (u, sin(theta), cos(theta))
}

/// Two triangles per cell of a `columns` × `rows` grid of vertices, cells row-major, made by
/// `split` from the corners (x, y), (x+1, y), (x, y+1), (x+1, y+1).
fn grid_triangles(
    columns: usize,
    rows: usize,
    split: impl Fn(u32, u32, u32, u32) -> [[u32; 3]; 2],
) -> Vec<[u32; 3]> {
    let mut triangles = Vec::with_capacity(2 * (columns - 1) * (rows - 1));
    for y in 0..rows - 1 {
        for x in 0..columns - 1 {
            let a = index(y * columns + x);
            let c = index((y + 1) * columns + x);
            triangles.extend(split(a, a + 1, c, c + 1));
        }
    }
    triangles
}

/// uv = (x / (W-1), y / (H-1)), row-major.
fn grid_uvs(w: usize, h: usize) -> Vec<[f32; 2]> {
    let fraction = |k: usize, n: usize| to_f32(f64::from(index(k)) / f64::from(index(n - 1)));
    (0..w * h).map(|i| [fraction(i % w, w), fraction(i / w, h)]).collect()
}

/// Area-weighted vertex normals: the unit sum of the cross products of the triangles around each
/// point, in triangle order. A point whose triangles have no area gets the normal +y.
fn vertex_normals(points: &Points, triangles: &[[u32; 3]]) -> Vec<Vec3> {
    let mut sums = vec![Vector3::zeros(); points.len()];
    for triangle in triangles {
        let [a, b, c] = triangle.map(|i| i as usize);
        let origin = points.get(a);
        let cross = (points.get(b) - origin).cross(&(points.get(c) - origin));
        for corner in [a, b, c] {
            sums[corner] += cross;
        }
    }
    sums.into_iter().map(|sum| unit_or(sum, Vector3::y())).collect()
}

/// ∂p/∂u along the row (central, one-sided at the ends), made orthogonal to the normal, unit.
/// Where the row stands still it is any direction orthogonal to the normal.
fn row_tangent(points: &Points, w: usize, i: usize, normal: &Vec3) -> Vec3 {
    let left = if i.is_multiple_of(w) { i } else { i - 1 };
    let right = if i % w == w - 1 { i } else { i + 1 };
    let along = points.get(right) - points.get(left);
    unit_or(along - normal * along.dot(normal), unit_or(in_plane(normal), Vector3::x()))
}

/// The report's first direction inside a plane of unit normal n: unit, unless n is (1,1,1)/√3,
/// where its formula gives zero and +x made orthogonal stands in.
fn in_plane(n: &Vec3) -> Vec3 {
    let p = Vector3::new(n.y - n.z, n.z - n.x, n.x - n.y);
    unit_or(p, unit_or(Vector3::x() - n * n.x, Vector3::y()))
}

fn unit(v: Vec3) -> Vec3 {
    v / v.dot(&v).sqrt()
}

/// The unit vector of `v`, or `otherwise` when `v` has no direction.
fn unit_or(v: Vec3, otherwise: Vec3) -> Vec3 {
    let length = v.dot(&v).sqrt();
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

/// Kinds of springs to show as lines.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SpringKinds {
    /// To the next point along a row or column.
    pub structural: bool,
    /// To the next point along a diagonal.
    pub shearing: bool,
    /// To the next but one along a row or column.
    pub bending: bool,
}

impl SpringKinds {
    /// The kinds that a cloth has.
    pub fn of(cloth: &Cloth) -> Self {
        Self {
            structural: cloth.enable_structural,
            shearing: cloth.enable_shearing,
            bending: cloth.enable_bending,
        }
    }
}

/// The springs of a cloth as lines between its points, in the order in which they are created.
pub fn spring_lines(cloth: &Cloth, kinds: SpringKinds) -> Vec<[u32; 2]> {
    let (w, h) = (cloth.num_width_points, cloth.num_height_points);
    let mut lines = Vec::new();
    for j in 0..h {
        for i in 0..w {
            let mut add = |exists: bool, back: usize| {
                if exists {
                    lines.push([index(j * w + i), index(j * w + i - back)]);
                }
            };
            add(kinds.structural && i >= 1, 1);
            add(kinds.structural && j >= 1, w);
            add(kinds.shearing && i >= 1 && j >= 1, w + 1);
            add(kinds.shearing && i + 1 < w && j >= 1, w.wrapping_sub(1));
            add(kinds.bending && i >= 2, 2);
            add(kinds.bending && j >= 2, 2 * w);
        }
    }
    lines
}
