//! The mesh of the cloth: its points, two triangles a cell.

use nalgebra::Vector3;

use super::{BAND, Mesh, in_plane, index, round, set_grid_triangles, to_f32, unit_or};
use crate::cloth::Points;
use crate::scene::{Cloth, Needs, Vec3};
use crate::share::share_out;

/// Points that one thread takes at a time.
const PIECE: usize = 4096;

impl Mesh {
    /// The cloth at `points`: per cell with corners A (x, y), B (x+1, y), C (x, y+1), D (x+1, y+1)
    /// the triangles (A, C, B) and (B, C, D).
    ///
    /// # Panics
    /// It may when a side of the cloth has fewer than two points, or there are not as many `points` as the
    /// cloth has; the cloth of a scene that was loaded has two a side or more.
    pub fn cloth(cloth: &Cloth, points: &Points, needs: Needs) -> Self {
        let mut mesh = Self::default();
        mesh.set_cloth(cloth, points, needs);
        mesh
    }

    /// Becomes [`Mesh::cloth`], in the memory of what it was.
    pub(crate) fn set_cloth(&mut self, cloth: &Cloth, points: &Points, needs: Needs) {
        let (w, h) = (cloth.num_width_points, cloth.num_height_points);
        self.positions.resize(points.len(), [0.0; 3]);
        share_out(self.positions.chunks_mut(PIECE).enumerate(), |(piece, positions)| {
            for (i, position) in (piece * PIECE..).zip(positions) {
                *position = round(points.get(i));
            }
        });
        self.normals.resize(if needs.normal || needs.tangent { w * h } else { 0 }, [0.0; 3]);
        set_per_normal(&mut self.normals, points, w, h, |_, normal| normal);
        self.tangents.resize(if needs.tangent { w * h } else { 0 }, [0.0; 3]);
        set_per_normal(&mut self.tangents, points, w, h, |i, normal| row_tangent(points, w, i, &normal));
        self.uvs.clear();
        if needs.uv {
            set_grid_uvs(&mut self.uvs, w, h);
        }
        set_grid_triangles(&mut self.triangles, w, h, |a, b, c, d| [[a, c, b], [b, c, d]]);
    }
}

/// uv = (x / (W-1), y / (H-1)), row-major.
fn set_grid_uvs(uvs: &mut Vec<[f32; 2]>, w: usize, h: usize) {
    let fraction = |k: usize, n: usize| to_f32(f64::from(index(k)) / f64::from(index(n - 1)));
    let us: Vec<f32> = (0..w).map(|x| fraction(x, w)).collect();
    for y in 0..h {
        let v = fraction(y, h);
        uvs.extend(us.iter().map(|&u| [u, v]));
    }
}

/// Area-weighted vertex normals: the unit sum of the cross products of the triangles around each
/// point, in triangle order. A point whose triangles have no area gets the normal +y.
/// What `attribute` makes of each point's number and normal is rounded.
fn set_per_normal(
    attributes: &mut [[f32; 3]],
    points: &Points,
    w: usize,
    h: usize,
    attribute: impl Fn(usize, Vec3) -> Vec3 + Sync,
) {
    share_out(attributes.chunks_mut(w * BAND).enumerate(), |(band, attributes)| {
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
