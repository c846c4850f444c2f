//! Meshes have the attributes that their formulas give, and no others.

use crate::scenes;
use drape::{
    cloth::{Points, grid},
    math::{cos, sin},
    mesh::Mesh,
    scene::{Cloth, Needs, Plane, Vec3},
};

const ALL: Needs =
    Needs { normal: true, tangent: true, uv: true, texture: false, height_map: false, environment: false };

fn vector([x, y, z]: [f32; 3]) -> Vec3 {
    Vec3::new(x.into(), y.into(), z.into())
}

/// Every normal and tangent is unit, and they are orthogonal, to the rounding of f32.
fn assert_frames(mesh: &Mesh) {
    assert_eq!(mesh.normals.len(), mesh.positions.len());
    assert_eq!(mesh.tangents.len(), mesh.positions.len());
    for (&normal, &tangent) in mesh.normals.iter().zip(&mesh.tangents) {
        let (n, t) = (vector(normal), vector(tangent));
        assert!((n.dot(&n) - 1.0).abs() < 3e-7, "normal {n}");
        assert!((t.dot(&t) - 1.0).abs() < 3e-7, "tangent {t}");
        assert!(n.dot(&t).abs() < 3e-7, "{n} and {t}");
    }
}

/// The picture is not mirrored: seen from the side of the normal, v grows to the right of where u grows. And the
/// tangent is dp/du where triangles are flat.
fn assert_reads_from_outside(mesh: &Mesh) {
    for &triangle in &mesh.triangles {
        let [p, q, r] = triangle.map(|i| vector(mesh.positions[i as usize]));
        let [a, b, c] = triangle.map(|i| mesh.uvs[i as usize].map(f64::from));
        let ([u1, v1], [u2, v2]) = ([b[0] - a[0], b[1] - a[1]], [c[0] - a[0], c[1] - a[1]]);
        let turn = u1 * v2 - u2 * v1;
        let (along_u, along_v) = (((q - p) * v2 - (r - p) * v1) / turn, ((r - p) * u1 - (q - p) * u2) / turn);
        for vertex in triangle {
            let (n, t) = (vector(mesh.normals[vertex as usize]), vector(mesh.tangents[vertex as usize]));
            // A triangle at a pole of a ball has no area.
            let flat = (q - p).cross(&(r - p)).norm() < 1e-9;
            assert!(flat || t.dot(&along_u) > 0.0, "u grows along the tangent");
            assert!(flat || n.cross(&t).dot(&along_v) < 0.0, "v grows along t x n: {triangle:?}");
        }
    }
}

fn stock_cloth() -> Cloth {
    scenes::pinned2().cloth.expect("a cloth")
}

#[test]
fn a_sphere_has_its_analytic_normals_and_tangents() {
    let sphere = scenes::ball();
    let mesh = Mesh::sphere(&sphere, ALL);
    assert_eq!((mesh.positions.len(), mesh.triangles.len()), (41 * 41, 2 * 40 * 40));
    assert_eq!(mesh.positions, mesh.normals);
    assert_frames(&mesh);
    for (&[x, _, z], &tangent) in mesh.positions.iter().zip(&mesh.tangents).skip(41).take(39 * 41) {
        let around = Vec3::new(z.into(), 0.0, -f64::from(x)).normalize();
        assert!((vector(tangent) - around).norm() < 1e-6, "the tangent runs along the latitude");
    }
    assert_eq!((mesh.uvs[0], mesh.uvs[41 * 41 - 1]), ([0.0, 0.0], [1.0, 1.0]));
    assert_reads_from_outside(&mesh);
}

#[test]
fn a_cloth_reads_from_the_side_of_its_normal() {
    for scene in [scenes::pinned2(), scenes::self_collision()] {
        let cloth = scene.cloth.expect("a cloth");
        let points = grid::start(&cloth, grid::Grid::new(&cloth).expect("a grid")).expect("points");
        assert_reads_from_outside(&Mesh::cloth(&cloth, &points, ALL));
    }
}

#[test]
fn a_plane_has_one_frame_whatever_the_length_of_its_normal() {
    for normal in [Vec3::y(), Vec3::new(0.0, 7.0, 0.0), Vec3::new(1.0, 2.0, -3.0), Vec3::new(1.0, 1.0, 1.0)] {
        let material = scenes::material();
        let plane = Plane { point: Vec3::new(0.1, 0.2, 0.3), normal, friction: 0.0, material };
        let mesh = Mesh::plane(&plane, ALL);
        assert_frames(&mesh);
        assert!((vector(mesh.normals[0]) - normal.normalize()).norm() < 1e-7);
        for &corner in &mesh.positions {
            assert!((vector(corner) - plane.point).dot(&normal).abs() < 1e-5, "in the plane");
        }
        let [a, b, c, d] = [0, 1, 2, 3].map(|i| vector(mesh.positions[i]));
        let sides = [(a - b).norm(), (a - c).norm(), (b - d).norm(), (c - d).norm()];
        assert!(sides.iter().all(|side| (side - 4.0).abs() < 1e-6), "4 m wide: {sides:?}");
        assert_reads_from_outside(&mesh);
    }
}

/// A cloth rolled around the z axis: the tangent runs around, the normal outwards or inwards.
#[test]
fn a_cloth_s_tangent_is_its_derivative_along_the_row() {
    let cloth = stock_cloth();
    let mut points: Points = grid::start(&cloth, grid::Grid::new(&cloth).expect("a grid")).expect("points");
    let angles: Vec<f64> = points.x.clone();
    for (i, &angle) in angles.iter().enumerate() {
        (points.x[i], points.y[i]) = (sin(angle), cos(angle));
    }
    let mesh = Mesh::cloth(&cloth, &points, ALL);
    assert_frames(&mesh);
    // At the border a point has triangles on one side only, which tilts its normal.
    let inner = |i: usize| !matches!(i % 50, 0 | 49) && !matches!(i / 50, 0 | 49);
    for (i, &angle) in angles.iter().enumerate().filter(|&(i, _)| inner(i)) {
        let around = Vec3::new(cos(angle), -sin(angle), 0.0);
        assert!((vector(mesh.tangents[i]) - around).norm() < 1e-3, "point {i}: {:?}", mesh.tangents[i]);
        let outwards = vector(mesh.normals[i]).dot(&Vec3::new(sin(angle), cos(angle), 0.0));
        assert!(outwards > 0.999, "point {i}: {:?}", mesh.normals[i]);
    }
}

#[test]
fn what_is_not_read_is_not_computed() {
    let cloth = stock_cloth();
    let points = grid::start(&cloth, grid::Grid::new(&cloth).expect("a grid")).expect("points");
    let mesh = Mesh::cloth(&cloth, &points, Needs::default());
    assert!(mesh.normals.is_empty() && mesh.tangents.is_empty() && mesh.uvs.is_empty());
    let sphere = Mesh::sphere(&scenes::ball(), Needs { uv: true, ..Needs::default() });
    assert!(sphere.normals.is_empty() && sphere.tangents.is_empty() && sphere.uvs.len() == 41 * 41);
}
