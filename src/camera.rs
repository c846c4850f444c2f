//! The orbit camera: eye, view and projection in f64, rounded to f32 once at the end.

use nalgebra::{Matrix4, Vector3};

use crate::{
    cloth::grid::{Grid, start_of},
    error::{Error, Kind, Result},
    math::{sin_cos_degrees, tan, unit},
    scene::{Camera as Settings, Cloth, Collider, Scene, Vec3},
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
    /// The distances of the near and the far plane, in metres.
    pub planes: [f64; 2],
}

impl Camera {
    /// The point that the camera of a scene looks at, and how far it is from there, in metres: those that the
    /// scene gives or the defaults for its cloth.
    ///
    /// # Errors
    /// A cloth that does not fit in memory.
    pub fn target_and_distance(scene: &Scene) -> Result<(Vec3, f64)> {
        Ok((target(scene)?, scene.camera_distance()))
    }

    /// The camera of a scene, for the picture size that the scene asks for.
    ///
    /// # Errors
    /// A cloth that does not fit in memory; a distance that is lost in the target's rounding.
    pub fn of(scene: &Scene) -> Result<Self> {
        let settings = &scene.camera;
        let (target, distance) = Self::target_and_distance(scene)?;
        let (direction, up) = orbit(settings);
        let eye = target + direction * distance;
        if eye == target {
            return Err(Error::new(Kind::Scene, "the camera stands in its target")
                .with_help("raise camera.distance, or move camera.target nearer to the origin"));
        }
        let [width, height] = scene.render.size.map(f64::from);
        let product = projection(settings, width / height) * view(&eye, &target, &up);
        let position = [eye.x, eye.y, eye.z].map(round);
        Ok(Self { view_projection: columns(&product), position, planes: [settings.near, settings.far] })
    }

    /// The distance along the view axis, in metres, of what has a window depth; infinite for 1, where nothing was drawn.
    /// It is the inverse of the projection. Depths below 1 are multiples of 2⁻²⁴ there, so at a distance z it knows
    /// `z² (far - near) / (far near)` times as much.
    pub fn distance(&self, depth: f32) -> f32 {
        let [near, far] = self.planes;
        if depth == 1.0 { f32::INFINITY } else { round(near * far / (far - f64::from(depth) * (far - near))) }
    }
}

impl Camera {
    /// The camera that `camera.fit` asks for: `points` just fit into the picture, with a margin. Where the near or the
    /// far plane of the scene would cut them, or leave no depths to tell them apart by, it is moved.
    ///
    /// # Errors
    /// As [`Camera::of`].
    pub fn fitting(scene: &Scene, points: &[Vec3]) -> Result<Self> {
        let mut scene = scene.clone();
        let (direction, up) = orbit(&scene.camera);
        let x = unit(up.cross(&direction));
        let y = direction.cross(&x);
        let largest = |of: &dyn Fn(&Vec3) -> f64| points.iter().map(of).fold(f64::NEG_INFINITY, f64::max);
        let [width, height] = scene.render.size.map(f64::from);
        let vertical = tan_half_vfov(&scene.camera, width / height);
        // From a distance d the picture reaches from -tan (d - z) to tan (d - z) at depth z.
        let along = |axis: Vec3, tan: f64| {
            let high = largest(&|point| point.dot(&axis) + tan * point.dot(&direction));
            let low = largest(&|point| -point.dot(&axis) + tan * point.dot(&direction));
            ((high - low) / 2.0, (high + low) / (2.0 * tan))
        };
        let (right, by_width) = along(x, vertical * width / height);
        let (above, by_height) = along(y, vertical);
        let (front, back) =
            (largest(&|point| point.dot(&direction)), -largest(&|point| -point.dot(&direction)));
        let from =
            front + (by_width.max(by_height) - front).max((front - back) * 1e-3).max(1e-9) * FIT_MARGIN;
        // The target lies in the middle of what is seen, in depth too.
        let middle = (front + back) / 2.0;
        scene.camera.target = Some(x * right + y * above + direction * middle);
        let distance = from - middle;
        scene.camera.distance = Some(distance);
        let nearest = from - front;
        if scene.camera.near > nearest || scene.camera.near < distance * LEAST_NEAR {
            scene.camera.near = (distance * 1e-3).min(nearest / 2.0);
        }
        scene.camera.far = scene.camera.far.max(2.0 * (from - back));
        Self::of(&scene)
    }
}

/// How much farther away the camera stands than where what it shows would touch the edge of the picture.
const FIT_MARGIN: f64 = 1.05;

/// Part of the distance below which a near plane leaves too few depths.
const LEAST_NEAR: f64 = 1.0 / 16_384.0;

/// How much farther than the camera's distance its target must be from the origin for the origin to be moved there.
const FAR_AWAY: f64 = 256.0;

/// The point that is drawn as the origin. It is the origin itself, unless the camera's target has a coordinate of
/// more than 256 times the camera's distance (of a camera that fits, of the size of what it shows): there the rounding of world coordinates to 32 bits would show (at 1024 x
/// 800 pixels from 1/40 of a pixel on), so the target is subtracted first, in 64 bits.
///
/// # Errors
/// A cloth that does not fit in memory.
pub fn origin(scene: &Scene) -> Result<Vec3> {
    let (target, distance) = match framed(scene)? {
        Some(framed) if scene.camera.fit => framed,
        _ => (target(scene)?, scene.camera_distance()),
    };
    let away = target.iter().map(|c| c.abs()).fold(0.0, f64::max);
    Ok(if away > FAR_AWAY * distance { target } else { Vec3::zeros() })
}

/// Where a camera that fits goes, and how large what is there is: the cloth at its start, else a ball or a box, else a
/// plane.
fn framed(scene: &Scene) -> Result<Option<(Vec3, f64)>> {
    if let Some(cloth) = &scene.cloth {
        return Ok(Some((start_mean(cloth)?, cloth.width.max(cloth.height))));
    }
    let bounded = scene.colliders.iter().find(|collider| !matches!(collider, Collider::Plane(_)));
    Ok(bounded.or(scene.colliders.first()).map(|collider| match collider {
        Collider::Sphere(sphere) => (sphere.origin, sphere.radius),
        Collider::Cuboid(cuboid) => (cuboid.origin, cuboid.size.max()),
        Collider::Plane(plane) => (plane.point, 1.0),
    }))
}

/// The target that is given, or that of the report.
///
/// # Errors
/// A cloth that does not fit in memory.
pub fn target(scene: &Scene) -> Result<Vec3> {
    match (scene.camera.target, &scene.cloth) {
        (Some(target), _) => Ok(target),
        (None, Some(cloth)) => default_target(cloth),
        (None, None) => Ok(TARGET_WITHOUT_CLOTH),
    }
}

/// The direction from the target to the eye, and a direction that is up in the picture.
fn orbit(settings: &Settings) -> (Vec3, Vec3) {
    let (sin_polar, cos_polar) = sin_cos_degrees(settings.polar);
    let (sin_azimuth, cos_azimuth) = sin_cos_degrees(settings.azimuth);
    let direction = Vector3::new(sin_polar * sin_azimuth, cos_polar, sin_polar * cos_azimuth);
    // Looking straight along y leaves the picture's up to the limit of a small tilt.
    let up = if sin_polar == 0.0 {
        Vector3::new(-cos_polar * sin_azimuth, 0.0, -cos_polar * cos_azimuth)
    } else {
        Vector3::y()
    };
    (direction, up)
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
    let k = 1.0 / tan_half_vfov(settings, aspect);
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

/// The tangent of half of the vertical field of view that is drawn.
fn tan_half_vfov(settings: &Settings, aspect: f64) -> f64 {
    let half = |degrees: f64| tan(degrees * (std::f64::consts::PI / 360.0));
    half(settings.vfov).max(half(settings.hfov) / aspect)
}

/// The mean of the starting points.
fn start_mean(cloth: &Cloth) -> Result<Vec3> {
    let grid = Grid::new(cloth)?;
    let sum = (0..grid.len()).fold(Vec3::zeros(), |sum, point| sum + start_of(cloth, grid, point));
    Ok(sum / grid.len() as f64)
}

/// The mean of the starting points, at half its height.
fn default_target(cloth: &Cloth) -> Result<Vec3> {
    let mean = start_mean(cloth)?;
    Ok(Vec3::new(mean.x, mean.y / 2.0, mean.z))
}

fn columns(matrix: &Matrix4<f64>) -> Columns {
    std::array::from_fn(|column| std::array::from_fn(|row| round(matrix[(row, column)])))
}

#[expect(clippy::cast_possible_truncation, reason = "the one rounding to f32 of the geometry")]
fn round(value: f64) -> f32 {
    value as f32
}
