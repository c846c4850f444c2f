//! Triangles and lines to draw: the cloth, the ball and the plane.
//!
//! Geometry is computed in f64 and rounded once to f32. An attribute that no shader reads is not
//! computed: its array stays empty.

use nalgebra::Vector3;
use rayon::prelude::*;

use crate::{
    cloth::{
        Points,
        grid::Grid,
        springs::{self, SpringKind},
    },
    math::{cos, sin},
    scene::{Cloth, Needs, Plane, Sphere, Vec3},
};

/// Rows of a grid that one thread takes at a time.
const BAND: usize = 32;

/// Points that one thread takes at a time.
const PIECE: usize = 4096;

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
    ///
    /// # Panics
    /// It may when a side of the cloth has fewer than two points, or there are not as many `points` as the
    /// cloth has; the cloth of a scene that was loaded has two a side or more.
    pub fn cloth(cloth: &Cloth, points: &Points, needs: Needs) -> Self {
        let (w, h) = (cloth.num_width_points, cloth.num_height_points);
        let normals_of = |read: bool, f: &(dyn Fn(usize, Vec3) -> Vec3 + Sync)| {
            if read { per_normal(points, w, h, f) } else { Vec::new() }
        };
        Self {
            positions: (0..points.len())
                .into_par_iter()
                .with_min_len(PIECE)
                .map(|i| round(points.get(i)))
                .collect(),
            normals: normals_of(needs.normal || needs.tangent, &|_, normal| normal),
            tangents: normals_of(needs.tangent, &|i, normal| row_tangent(points, w, i, &normal)),
            uvs: if needs.uv { grid_uvs(w, h) } else { Vec::new() },
            triangles: grid_triangles(w, h, |a, b, c, d| [[a, c, b], [b, c, d]]),
        }
    }

    /// The unit ball of a sphere's resolution: (lat + 1)(lon + 1) vertices, latitude outer.
    /// With v = i/lat and u = j/lon, λ = πv and θ as in `turn`.
    ///
    /// # Panics
    /// When there are no longitudes; the spheres of a scene that was loaded have some.
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
    split: impl Fn(u32, u32, u32, u32) -> [[u32; 3]; 2] + Sync,
) -> Vec<[u32; 3]> {
    let cells = columns - 1;
    let mut triangles = vec![[0; 3]; 2 * cells * (rows - 1)];
    triangles.par_chunks_mut(2 * cells * BAND).enumerate().for_each(|(band, triangles)| {
        for (i, pair) in (band * BAND * cells..).zip(triangles.chunks_exact_mut(2)) {
            let a = index(i / cells * columns + i % cells);
            let c = a + index(columns);
            pair.copy_from_slice(&split(a, a + 1, c, c + 1));
        }
    });
    triangles
}

/// uv = (x / (W-1), y / (H-1)), row-major.
fn grid_uvs(w: usize, h: usize) -> Vec<[f32; 2]> {
    let fraction = |k: usize, n: usize| to_f32(f64::from(index(k)) / f64::from(index(n - 1)));
    (0..w * h).map(|i| [fraction(i % w, w), fraction(i / w, h)]).collect()
}

/// Area-weighted vertex normals: the unit sum of the cross products of the triangles around each
/// point, in triangle order. A point whose triangles have no area gets the normal +y.
/// What `attribute` makes of each point's number and normal is rounded.
fn per_normal(
    points: &Points,
    w: usize,
    h: usize,
    attribute: impl Fn(usize, Vec3) -> Vec3 + Sync,
) -> Vec<[f32; 3]> {
    let mut attributes = vec![[0.0; 3]; w * h];
    attributes.par_chunks_mut(w * BAND).enumerate().for_each(|(band, attributes)| {
        let first = band * BAND;
        let (mut above, mut below) = (crosses(w), crosses(w));
        if let Some(row) = first.checked_sub(1) {
            set_crosses(&mut above, points, w, h, row);
        }
        for (row, attributes) in (first..).zip(attributes.chunks_exact_mut(w)) {
            set_crosses(&mut below, points, w, h, row);
            for (x, attribute_of) in attributes.iter_mut().enumerate() {
                let ([_, a1], [b0, b1]) = (above[x], above[x + 1]);
                let ([c0, c1], [d0, _]) = (below[x], below[x + 1]);
                let sum = Vec3::zeros() + a1 + b0 + b1 + c0 + c1 + d0;
                *attribute_of = round(attribute(row * w + x, unit_or(sum, Vector3::y())));
            }
            std::mem::swap(&mut above, &mut below);
        }
    });
    attributes
}

/// Cross products of both triangles of each cell in a row of cells, all zero. The first and the last stay
/// so, before the row and after it: sums of the others are the same with them.
fn crosses(w: usize) -> Vec<[Vec3; 2]> {
    vec![[Vec3::zeros(); 2]; w + 1]
}

/// Computes the cross products of a row of cells; those of the row after the last are zero.
fn set_crosses(crosses: &mut [[Vec3; 2]], points: &Points, w: usize, h: usize, row: usize) {
    if row + 1 == h {
        return crosses.fill([Vec3::zeros(); 2]);
    }
    let of_row = |row: usize| [&points.x, &points.y, &points.z].map(|c| &c[row * w..(row + 1) * w]);
    let (top, bottom) = (of_row(row), of_row(row + 1));
    let point = |[px, py, pz]: [&[f64]; 3], x: usize| Vec3::new(px[x], py[x], pz[x]);
    let cross = |a: Vec3, b: Vec3, c: Vec3| (b - a).cross(&(c - a));
    for (x, both) in crosses[1..w].iter_mut().enumerate() {
        let (a, b) = (point(top, x), point(top, x + 1));
        let (c, d) = (point(bottom, x), point(bottom, x + 1));
        *both = [cross(a, c, b), cross(b, c, d)];
    }
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
        let [structural, shearing, bending] = SpringKind::ALL.map(|kind| kind.is_enabled(cloth));
        Self { structural, shearing, bending }
    }

    /// The kinds as a list.
    fn list(self) -> Vec<SpringKind> {
        let shown = [self.structural, self.shearing, self.bending];
        SpringKind::ALL.into_iter().zip(shown).filter(|(_, shown)| *shown).map(|(kind, _)| kind).collect()
    }
}

/// The springs of a cloth as lines between its points, in the order in which they are created.
pub fn spring_lines(cloth: &Cloth, kinds: SpringKinds) -> Vec<[u32; 2]> {
    let grid = Grid { width: cloth.num_width_points, height: cloth.num_height_points };
    springs::ends(grid, &kinds.list()).map(|ends| ends.map(index)).collect()
}
