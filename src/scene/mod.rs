//! What a scene is: the validated, strongly typed form of a scene file.
//!
//! Data flows `file -> json -> patch -> keys of each object -> validate -> Scene -> Plan`. A [`Scene`] exists
//! only when every value in the file is finite and in range, so nothing further down checks them again.
//! Each key of a file is one row beside the struct that holds its value: the row has the field, its meaning,
//! its default and its rule, from which reading, errors, schema, `docs/scene.md` and flags come. Where a
//! range has no upper end, it ends at 1e15; "above 0" means at least 1e-15, so that squares and
//! quotients of such numbers stay finite too.

mod camera;
mod cloth;
mod collider;
mod document;
mod json;
mod keys;
mod light;
mod load;
mod material;
mod motion;
mod needs;
mod set;
mod plan;
mod render;
mod seen;
mod shader;
mod sim;
mod stock;
pub mod sweep;
mod without_effect;
mod doubtful;
mod validate;

use json::key::Row;
use json::object::{Object, defaults};

pub use crate::math::Vec3;
pub use camera::Camera;
pub use cloth::{Cloth, MAX_POINTS, Orientation};
pub use collider::{Collider, ColliderKind, Cuboid, MAX_RESOLUTION, PerKind, Plane, Sphere};
pub use document::{Difference, differences};
pub use json::key::{Key, Shape};
pub use keys::{keys, schema};
pub use light::Light;
pub use load::{
    Flag, Loaded, MAX_FILE, Overrides, check_value, load, load_stock, load_text, read_text, stock_name,
};
pub use material::{Bitangent, Material};
pub use needs::Needs;
pub use plan::{Images, Item, plan};
pub use render::{Filter, Render};
pub use seen::{SEEN, lies_in};
pub use shader::Shader;
pub use sim::{Contact, Damping, Integrator, Precision, SelfCollision, Sim, Start};
pub use validate::{MAX_OBJECTS, MAX_SAMPLES};

/// Everything a scene file says, with every default filled in. By default it is the scene of a file that
/// says nothing: `{}`.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// The cloth, if the scene has one.
    pub cloth: Option<Cloth>,
    /// What the cloth collides with: the planes, then the spheres, then the boxes, each in file order.
    pub colliders: Vec<Collider>,
    /// How the cloth is moved.
    pub sim: Sim,
    /// Where the picture is taken from.
    pub camera: Camera,
    /// The one point light.
    pub light: Light,
    /// Size, samples, background and moment of the picture.
    pub render: Render,
}

const CLOTH: Row = Row::new(
    "cloth",
    &["The cloth: a rectangle of point masses joined by springs. Without it, the scene has none."],
);
const SIM: Row = Row::new("sim", &["How the cloth is moved."]);
const CAMERA: Row = Row::new("camera", &["Where the picture is taken from."]);
const LIGHT: Row = Row::new("light", &["The one light, a point."]);
const MATERIAL: Row = Row::new(
    "material",
    &["What every object looks like, except for what the object's own `material` says."],
);
const RENDER: Row = Row::new("render", &["Size, samples, background and moment of the picture."]);

impl Scene {
    /// Reads every key of a scene file.
    fn read(at: &mut Object) -> Self {
        let cloth = at.maybe(CLOTH, Cloth::read);
        let colliders = Collider::read_all(at);
        let sim = at.group(SIM, Sim::read).unwrap_or_default();
        let camera = at.group(CAMERA, Camera::read).unwrap_or_default();
        let light = at.group(LIGHT, Light::read).unwrap_or_default();
        // Each object reads it again, for the keys that its own material leaves out.
        at.group(MATERIAL, Material::read);
        let render = at.group(RENDER, Render::read).unwrap_or_default();
        Self { cloth, colliders, sim, camera, light, render }
    }

    /// How far the camera is from its target, in metres: 1.8 times the longer side of the cloth if that is not given.
    pub fn camera_distance(&self) -> f64 {
        let side = |cloth: &Cloth| cloth.width.max(cloth.height);
        self.camera.distance.unwrap_or_else(|| 1.8 * self.cloth.as_ref().map_or(1.0, side))
    }

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

    /// Whether the cloth moves in both alike: all but what pictures show is equal.
    pub fn moves_like(&self, other: &Self) -> bool {
        let cloth = match (&self.cloth, &other.cloth) {
            (Some(a), Some(b)) => Cloth { material: b.material.clone(), ..a.clone() } == *b,
            (a, b) => a.is_none() && b.is_none(),
        };
        let colliders = self.colliders.len() == other.colliders.len()
            && self.colliders.iter().zip(&other.colliders).all(|(a, b)| a.collides_like(b));
        cloth && colliders && self.sim == other.sim
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

impl Default for Scene {
    fn default() -> Self {
        defaults(Self::read)
    }
}
