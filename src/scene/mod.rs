//! What a scene is: the validated, strongly typed form of a scene file.
//!
//! Data flows `text -> format -> patch -> fields -> checks -> Scene -> Plan`. A [`Scene`] exists only
//! when every value in the file is finite and in range, so nothing further down checks them again.
//! Where a range below has no upper end, it ends at 1e15; "> 0" means at least 1e-15, so that
//! squares and quotients of such numbers stay finite too.

mod checks;
mod collider;
mod compound;
mod fields;
mod format;
mod load;
mod meanings;
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
mod sim;
mod schema;
mod source;
mod stock;
mod words;

use nalgebra::Vector3;

pub use checks::{MAX_OBJECTS, MAX_POINTS, MAX_RESOLUTION};
pub use collider::{Collider, ColliderKind, PerKind, Plane, Sphere};
pub use load::{Loaded, MAX_FILE, Overrides, load, load_stock, load_text};
pub use plan::{Item, Needs, ObjectPlan, Plan};
pub use schema::schema;
pub use sim::{Contact, Damping, Integrator, Precision, SelfCollision, Sim, Start};

/// A point or direction in metres, world space, y up.
pub type Vec3 = Vector3<f64>;

/// Everything a scene file says, with every default filled in.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// The cloth, if the scene has one.
    pub cloth: Option<Cloth>,
    /// What the cloth collides with: the planes, then the spheres, each in file order.
    pub colliders: Vec<Collider>,
    /// How the cloth is moved.
    pub sim: Sim,
    /// Where the picture is taken from.
    pub camera: Camera,
    /// The one point light.
    pub light: Light,
    /// Picture size, samples, background and moment.
    pub render: Render,
}

impl Scene {
    /// The planes, in file order.
    pub fn planes(&self) -> impl Iterator<Item = &Plane> {
        self.colliders.iter().filter_map(|collider| match collider {
            Collider::Plane(plane) => Some(plane),
            _ => None,
        })
    }

    /// The spheres, in file order.
    pub fn spheres(&self) -> impl Iterator<Item = &Sphere> {
        self.colliders.iter().filter_map(|collider| match collider {
            Collider::Sphere(sphere) => Some(sphere),
            _ => None,
        })
    }

    /// How many colliders there are of each kind.
    pub fn collider_counts(&self) -> PerKind<usize> {
        let mut counts = PerKind::default();
        self.colliders.iter().for_each(|collider| counts[collider.kind()] += 1);
        counts
    }

    /// What each drawn object looks like, in draw order: the cloth, then the colliders.
    pub fn materials(&self) -> impl Iterator<Item = &Material> {
        let cloth = self.cloth.iter().map(|cloth| &cloth.material);
        cloth.chain(self.colliders.iter().map(Collider::material))
    }

    /// The same, to be changed.
    pub fn materials_mut(&mut self) -> impl Iterator<Item = &mut Material> {
        let cloth = self.cloth.iter_mut().map(|cloth| &mut cloth.material);
        cloth.chain(self.colliders.iter_mut().map(Collider::material_mut))
    }
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
    /// Percent of a point's displacement that is lost per step, or what `sim.damping` makes of it
    /// (0..=100).
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
