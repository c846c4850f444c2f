//! What a scene is: the validated, strongly typed form of a scene file.
//!
//! Data flows `text -> format -> patch -> fields -> checks -> Scene -> Plan`. A [`Scene`] exists only
//! when every value in it is finite and in range, so nothing further down checks input again.
//! Where a range below has no upper end, it ends at 1e15; "> 0" means at least 1e-15, so that
//! squares and quotients of such numbers stay finite too.

mod checks;
mod compound;
mod fields;
mod format;
mod load;
mod names;
mod nearest;
mod patch;
mod path;
mod plan;
mod range;
mod reader;
mod render;
mod report;
mod rule;
mod scalar;
mod schema;
mod source;
mod stock;
mod words;

use nalgebra::Vector3;

pub use checks::{MAX_OBJECTS, MAX_POINTS, MAX_RESOLUTION};
pub use load::{Loaded, MAX_FILE, Overrides, load, load_stock, load_text};
pub use plan::{Item, Needs, ObjectPlan, Plan};
pub use schema::schema;

/// A point or direction in metres, world space, y up.
pub type Vec3 = Vector3<f64>;

/// Everything a scene file says, with every default filled in.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// The cloth, if the scene has one.
    pub cloth: Option<Cloth>,
    /// The planes, in file order.
    pub planes: Vec<Plane>,
    /// The spheres, in file order.
    pub spheres: Vec<Sphere>,
    /// How the cloth is moved.
    pub sim: Sim,
    /// Where the picture is taken from.
    pub camera: Camera,
    /// The one point light.
    pub light: Light,
    /// Picture size, samples, background and moment.
    pub render: Render,
}

/// A rectangular cloth of point masses.
#[derive(Clone, Debug, PartialEq)]
pub struct Cloth {
    /// Extent along the grid's x, in metres (> 0).
    pub width: f64,
    /// Extent along the grid's y, in metres (> 0).
    pub height: f64,
    /// Points along x (>= 2): `W` of the method. `W` x `H` is at most [`MAX_POINTS`].
    pub num_width_points: usize,
    /// Points along y (>= 2): `H` of the method.
    pub num_height_points: usize,
    /// Half the distance that self-collision keeps between two points, in metres (>= 0).
    pub thickness: f64,
    /// How the cloth lies at the start.
    pub orientation: Orientation,
    /// Grid points `[x, y]` that never move, each once.
    pub pinned: Vec<[usize; 2]>,
    /// Percent of a point's displacement that is lost per step (0..=100).
    pub damping: f64,
    /// Mass per area, in kg/m² (> 0).
    pub density: f64,
    /// Stiffness of structural and shearing springs, in N/m (>= 0); bending springs have 0.2 of it.
    pub ks: f64,
    /// Whether structural springs exist.
    pub enable_structural: bool,
    /// Whether shearing springs exist.
    pub enable_shearing: bool,
    /// Whether bending springs exist.
    pub enable_bending: bool,
    /// What the cloth looks like.
    pub material: Material,
}

/// How the cloth lies at the start.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Orientation {
    /// File value 0: in the plane y = 1.
    Horizontal,
    /// File value 1: in the plane z = 0 but for an offset of at most 1 mm per point.
    Vertical,
}

/// A ball that the cloth collides with.
#[derive(Clone, Debug, PartialEq)]
pub struct Sphere {
    /// Centre, in metres.
    pub origin: Vec3,
    /// Radius, in metres (> 0).
    pub radius: f64,
    /// Part of the sliding that contact takes away (0..=1).
    pub friction: f64,
    /// Latitude and longitude counts of the drawn mesh (latitude 2..=[`MAX_RESOLUTION`],
    /// longitude 3..=[`MAX_RESOLUTION`]).
    pub resolution: [u32; 2],
    /// What the ball looks like.
    pub material: Material,
}

/// An infinite plane that the cloth collides with, drawn as a square of 4 m.
#[derive(Clone, Debug, PartialEq)]
pub struct Plane {
    /// A point of the plane, in metres.
    pub point: Vec3,
    /// Its normal as the file gives it: any length but 0.
    pub normal: Vec3,
    /// Part of the sliding that contact takes away (0..=1).
    pub friction: f64,
    /// What the plane looks like.
    pub material: Material,
}

/// How the cloth is moved.
#[derive(Clone, Debug, PartialEq)]
pub struct Sim {
    /// Frames per second of simulated time (1e-6..=1e9).
    pub fps: f64,
    /// Steps per frame (1..=1e9): `T` of the method.
    pub steps_per_frame: u32,
    /// Acceleration, in m/s².
    pub gravity: Vec3,
    /// The scheme that advances the positions.
    pub integrator: Integrator,
    /// Passes over the springs in a step of [`Integrator::Xpbd`] (1..=1e6); others do not read it.
    /// More steps help more than more passes do.
    pub iterations: u32,
    /// Part of the forces that [`Integrator::ImplicitEuler`] and [`Integrator::Bdf2`] may leave
    /// unbalanced at the end of a step (1e-15..=1); others do not read it. On the stock cloth the
    /// default is within 1 % of the error of an exact solution at 600 and 2700 steps a second.
    pub tolerance: f64,
    /// The arithmetic of the positions.
    pub precision: Precision,
    /// How the first step knows the velocity.
    pub start: Start,
    /// What the damping percentage refers to.
    pub damping: Damping,
    /// Largest strain left by the stretch limit (>= 0; 0.1 = 10 %), or none.
    pub stretch_limit: Option<f64>,
    /// Passes of the stretch limit per step (1..=1e6).
    pub stretch_passes: u32,
    /// How close pairs of points of the cloth are found.
    pub self_collision: SelfCollision,
    /// What is promised of points that touched an object.
    pub contact: Contact,
}

/// The scheme that advances the positions (`sim.integrator`).
///
/// Measured on the stock pinned2 cloth without damping, limit and self-collision: root mean
/// square of the distance from a converged run, in m at 0.5 s, by steps a second; and at 600 what
/// the total energy gained, in J, of about 1100 J that fall.
///
/// | integrator | 60 | 600 | 2700 | energy |
/// |---|---|---|---|---|
/// | verlet, half_step | unstable | 2.1e-4 | 1.2e-5 | +0.1 |
/// | verlet, report | unstable | 2.5e-3 | 5.5e-4 | +0.1 |
/// | xpbd, 1 iteration | 5.2e-1 | 4.5e-2 | 3.0e-3 | +73 |
/// | xpbd, 20 iterations | 1.3e-1 | 5.2e-3 | | -34 |
/// | implicit_euler | 2.1e-2 | 4.1e-3 | 1.5e-3 | -32 |
/// | bdf2 | 1.1e-2 | 7.0e-4 | 8.4e-5 | -2 |
///
/// Where Verlet's scheme is stable it is the cheapest by far; the others are for cloth so stiff and
/// light that it would need thousands of steps a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Integrator {
    /// Position Verlet, the report's. Explicit: stable for small steps only, which are checked
    /// before the first.
    Verlet,
    /// Extended position-based dynamics, first order, with `sim.iterations`: `src/cloth/xpbd.rs`. Never
    /// refused, but wrong and gaining energy where its passes are too few; then the run is stopped.
    Xpbd,
    /// Implicit Euler, first order, solved to `sim.tolerance`: `src/cloth/implicit_euler.rs`. Stable for
    /// every step; takes energy.
    ImplicitEuler,
    /// The second backward differentiation formula, solved to `sim.tolerance`: `src/cloth/bdf2.rs`.
    /// Second order and stable for every step.
    Bdf2,
}

/// The arithmetic of the positions (`sim.precision`).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Precision {
    /// binary64, the report's.
    F64,
    /// binary32 for positions, displacements and forces of [`Integrator::Verlet`], in displacement
    /// form: `src/cloth/single.rs`. Measured on the stock pinned2 cloth without limit and
    /// self-collision, at 0.5 s, against binary64: at most 2.5e-6 m apart at 30 steps a frame, 7.4e-6 m
    /// at 120 and 3.4e-5 m at 480. It saves about a twentieth of the time: for comparison, not speed.
    F32,
}

/// How the first step knows the velocity (`sim.start`), of [`Integrator::Verlet`] only: the others have
/// it at the start, where it is 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Start {
    /// `last = x`: the report's, first order.
    Report,
    /// `last = x - v dt + f dt² / (2 m)` at speed v = 0: second order. Free fall then falls by
    /// `g t² / 2` exactly, where the report's start is off by `g dt t / 2`. Measured on an undamped
    /// hanging cloth of 8 x 8 points at 0.2 s and 30 steps a frame: 2.1e-7 m off instead of 3.7e-4 m.
    HalfStep,
}

/// What the damping percentage refers to (`sim.damping`).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Damping {
    /// Per step, the report's: the part of a displacement, or of a velocity, that each step takes.
    PerStep,
    /// Per second, at the rate `c = -2700 ln(1 - damping / 100)` per second, which is the report's at
    /// its 2700 steps a second; as a force `-c m v` at the middle of the step, second order, and at
    /// the end of the step for integrators beside Verlet's scheme.
    /// Free fall ends at `g / c` for every number of steps. Measured on a hanging cloth of 8 x 8
    /// points at 0.2 s, with the half-step start: 2.4e-7 m off at 30 steps a frame; with damping
    /// per step it is another cloth, 35 mm off at 10 and 71 mm at 120 steps a frame.
    PerSecond,
}

/// How close pairs of points are found (`sim.self_collision`).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SelfCollision {
    /// Only within a point's own box, the report's.
    SameBox,
    /// All, as comparing each point with every other would: `src/cloth/neighbors.rs`.
    Neighbors,
    /// Not at all.
    Off,
}

/// What is promised of points that touched an object (`sim.contact`).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Contact {
    /// Nothing, the report's: friction and the stretch limit leave points inside.
    Report,
    /// After every step no free point is inside a sphere, or beyond a plane from where it
    /// started, but for rounding: `src/cloth/contact.rs`.
    Outside,
}

/// The orbit camera of the report's viewer.
#[derive(Clone, Debug, PartialEq)]
pub struct Camera {
    /// The point looked at, in metres; absent: derived from the cloth's start.
    pub target: Option<Vec3>,
    /// Distance from the target, in metres (> 0); absent: derived from the cloth's size.
    pub distance: Option<f64>,
    /// Angle from the +y axis, in degrees (0..=180).
    pub polar: f64,
    /// Angle around the y axis from +z towards +x, in degrees.
    pub azimuth: f64,
    /// Smallest horizontal field of view, in degrees (0.001..=179.999).
    pub hfov: f64,
    /// Smallest vertical field of view, in degrees (0.001..=179.999).
    pub vfov: f64,
    /// Distance of the near plane, in metres (> 0).
    pub near: f64,
    /// Distance of the far plane, in metres (> near).
    pub far: f64,
}

/// The point light.
#[derive(Clone, Debug, PartialEq)]
pub struct Light {
    /// Position, in metres.
    pub position: Vec3,
    /// Radiant intensity per channel (>= 0).
    pub intensity: Vec3,
    /// Colour of the light for the glossy ceramic (>= 0, not all 0).
    pub color: Vec3,
}

/// What an object looks like: a shader and the constants of its formula.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// Which program draws the object.
    pub shader: Shader,
    /// Surface colour c, linear, per channel (>= 0).
    pub color: Vec3,
    /// Ambient weight (>= 0).
    pub ka: f64,
    /// Diffuse weight (>= 0).
    pub kd: f64,
    /// Specular weight (>= 0).
    pub ks: f64,
    /// Specular exponent p (>= 0).
    pub shininess: f64,
    /// Mirror weight of the glossy ceramic (>= 0).
    pub km: f64,
    /// kn: scales the slope that bump takes from the height map.
    pub normal_scaling: f64,
    /// kh: height of a white texel, in model units.
    pub height_scaling: f64,
    /// Name of the colour texture, such as `texture_1`: letters, digits, `_` and `-`, as all names.
    pub texture: String,
    /// Name of the height map, such as `texture_2`.
    pub height_map: String,
    /// Name of the cube map's folder, such as `cube`.
    pub environment: String,
}

/// Which program draws an object (`material.shader`).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shader {
    /// Springs as lines; other objects in their flat colour.
    Wireframe,
    /// The normal as a colour.
    Normal,
    /// Lambert's law alone.
    Diffuse,
    /// Blinn-Phong.
    Phong,
    /// The colour texture alone.
    Texture,
    /// Blinn-Phong with normals from the height map.
    Bump,
    /// Bump, and the surface moved along its normal.
    Displacement,
    /// The environment, mirrored.
    Mirror,
    /// A glossy ceramic: displacement, texture and mirror together.
    Custom,
}

/// Picture size, samples, background and moment.
#[derive(Clone, Debug, PartialEq)]
pub struct Render {
    /// Width and height in pixels (1..=16384).
    pub size: [u32; 2],
    /// Samples per pixel: 1, 4, 8 or 16.
    pub samples: u32,
    /// Clear colour, linear, per channel (>= 0).
    pub background: Vec3,
    /// Simulated time of the picture, in seconds (0..=1e6).
    pub time: f64,
    /// How textures are looked up.
    pub filter: Filter,
}

/// How textures are looked up (`render.filter`).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Filter {
    /// The texel under the point.
    Nearest,
    /// Four texels, weighted.
    Bilinear,
}
