//! The orbit camera: eye, view and projection in f64, rounded to f32 once at the end.

use nalgebra::{Matrix4, Vector3};

use crate::{
    cloth::grid::{Grid, start_of},
    error::{Error, Kind, Result},
    math::{sin_cos_degrees, tan},
    scene::{Camera as Settings, Cloth, Scene, Vec3},
};

/// A scene without a cloth is seen as if the stock cloth (1 m × 1 m, at y = 1) were there.
const TARGET_WITHOUT_CLOTH: Vec3 = Vec3::new(0.5, 0.5, 0.5);

/// A 4 × 4 matrix as GLSL holds it: four columns.
pub type Columns = [[f32; 4]; 4];

/// What the vertex and fragment stages need of a camera.
#[derive(Clone, Debug, PartialEq)]
pub struct Camera {
    /// `u_view_projection`: world space to clip space.
    pub view_projection: Columns,
    /// `u_cam_pos`: the eye in world space, in metres.
    pub position: [f32; 3],
}

impl Camera {
    /// The point that the camera of a scene looks at, and how far it is from there, in metres: those that the
    /// scene gives or the defaults for its cloth.
    ///
    /// # Errors
    /// A cloth that does not fit in memory.
    pub fn target_and_distance(scene: &Scene) -> Result<(Vec3, f64)> {
        let target = match (scene.camera.target, &scene.cloth) {
            (Some(target), _) => target,
            (None, Some(cloth)) => default_target(cloth)?,
            (None, None) => TARGET_WITHOUT_CLOTH,
        };
        let distance = scene.camera.distance.unwrap_or_else(|| default_distance(scene.cloth.as_ref()));
        Ok((target, distance))
    }

    /// The camera of a scene, for the picture size that the scene asks for.
    ///
    /// # Errors
    /// A cloth that does not fit in memory; a distance that is lost in the target's rounding.
    pub fn of(scene: &Scene) -> Result<Self> {
        let settings = &scene.camera;
        let (target, distance) = Self::target_and_distance(scene)?;
        let (sin_polar, cos_polar) = sin_cos_degrees(settings.polar);
        let (sin_azimuth, cos_azimuth) = sin_cos_degrees(settings.azimuth);
        let direction = Vector3::new(sin_polar * sin_azimuth, cos_polar, sin_polar * cos_azimuth);
        let eye = target + direction * distance;
        // Looking straight along y leaves the picture's up to the limit of a small tilt.
        let up = if sin_polar == 0.0 {
            Vector3::new(-cos_polar * sin_azimuth, 0.0, -cos_polar * cos_azimuth)
        } else {
            Vector3::y()
        };
        if eye == target {
            return Err(Error::new(Kind::Scene, "the camera stands in its target")
                .with_help("raise camera.distance, or move camera.target nearer to the origin"));
        }
        let [width, height] = scene.render.size.map(f64::from);
        let product = projection(settings, width / height) * view(&eye, &target, &up);
        Ok(Self { view_projection: columns(&product), position: [eye.x, eye.y, eye.z].map(round) })
    }
}

/// World space to eye space: the eye at the origin, looking along -z.
fn view(eye: &Vec3, target: &Vec3, up: &Vec3) -> Matrix4<f64> {
    let z = unit(eye - target);
    let x = unit(up.cross(&z));
    let y = z.cross(&x);
    Matrix4::new(
        x.x,
        x.y,
        x.z,
        -x.dot(eye), //
        y.x,
        y.y,
        y.z,
        -y.dot(eye), //
        z.x,
        z.y,
        z.z,
        -z.dot(eye), //
        0.0,
        0.0,
        0.0,
        1.0,
    )
}

/// Eye space to clip space. Whichever field of view is too small for `aspect` is widened.
fn projection(settings: &Settings, aspect: f64) -> Matrix4<f64> {
    let half = |degrees: f64| tan(degrees * (std::f64::consts::PI / 360.0));
    let tan_half_vfov = half(settings.vfov).max(half(settings.hfov) / aspect);
    let k = 1.0 / tan_half_vfov;
    let (n, f) = (settings.near, settings.far);
    Matrix4::new(
        k / aspect,
        0.0,
        0.0,
        0.0, //
        0.0,
        k,
        0.0,
        0.0, //
        0.0,
        0.0,
        -(n + f) / (f - n),
        -2.0 * n * f / (f - n), //
        0.0,
        0.0,
        -1.0,
        0.0,
    )
}

/// The mean of the starting points, at half its height.
fn default_target(cloth: &Cloth) -> Result<Vec3> {
    let grid = Grid::new(cloth)?;
    let sum = (0..grid.len()).fold(Vec3::zeros(), |sum, point| sum + start_of(cloth, grid, point));
    let mean = sum / grid.len() as f64;
    Ok(Vec3::new(mean.x, mean.y / 2.0, mean.z))
}

/// 1.8 times the larger side of the cloth, in metres.
fn default_distance(cloth: Option<&Cloth>) -> f64 {
    1.8 * cloth.map_or(1.0, |cloth| cloth.width.max(cloth.height))
}

fn unit(v: Vec3) -> Vec3 {
    v / v.dot(&v).sqrt()
}

fn columns(matrix: &Matrix4<f64>) -> Columns {
    std::array::from_fn(|column| std::array::from_fn(|row| round(matrix[(row, column)])))
}

#[expect(clippy::cast_possible_truncation, reason = "the one rounding to f32 of the geometry")]
fn round(value: f64) -> f32 {
    value as f32
}
