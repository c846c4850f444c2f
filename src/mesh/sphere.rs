//! The mesh of a sphere: the unit ball.

use nalgebra::Vector3;

use super::{Mesh, Placement, round, set_grid_triangles, to_f32};
use crate::math::{cos, sin};
use crate::scene::{Needs, Sphere};

/// Part of its radius at which a ball is drawn, so that the cloth's flat triangles do not cut it.
const DRAWN_RADIUS: f64 = 0.92;

impl Placement {
    /// Where the unit ball is drawn as `sphere`.
    pub(super) fn of_sphere(sphere: &Sphere) -> Self {
        Self { origin: sphere.origin, scale: sphere.radius * DRAWN_RADIUS }
    }
}

impl Mesh {
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
        set_grid_triangles(&mut mesh.triangles, columns, rows, |a, b, c, d| [[a, c, d], [d, b, a]]);
        mesh
    }
}

/// u, sin θ and cos θ of a ball's meridian: θ = 2π((u + 0.5) mod 1).
fn turn(u: f64) -> (f64, f64, f64) {
    let turn = u + 0.5;
    let theta = 2.0 * std::f64::consts::PI * (turn - turn.floor());
    (u, sin(theta), cos(theta))
}
