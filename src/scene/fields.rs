//! Every key of a scene file: one line each, with its default and what it must be. What it means
//! stands in `meanings.rs`.

use super::checks::MAX_RESOLUTION;
use super::compound::{Counts, Direction, GridPoints, OrNull, Vector};
use super::names::{CONTACTS, DAMPINGS, FILTERS, PRECISIONS, SELF_COLLISIONS, STARTS};
use super::range::{ANY, NOT_NEGATIVE, POSITIVE, from_to};
use super::reader::Object;
use super::scalar::{Choice, Coded, Count, Flag, Name, Number};
use super::{
    Camera, Cloth, Collider, ColliderKind, Contact, Damping, Filter, Integrator, Light, Material,
    Orientation, Plane, Precision, Render, Scene, SelfCollision, Shader, Sim, Sphere, Start, Vec3,
};

/// The sample counts of `render.samples`.
const SAMPLES: &[(i64, &str, u32)] = &[(1, "", 1), (4, "", 4), (8, "", 8), (16, "", 16)];
/// The codes of `cloth.orientation`.
const ORIENTATIONS: &[(i64, &str, Orientation)] =
    &[(0, "horizontal", Orientation::Horizontal), (1, "vertical", Orientation::Vertical)];
/// Most points along one side of a cloth; `checks.rs` limits their product.
const SIDE: Count = Count(2, 1 << 21);
/// Latitude and longitude counts whose triangles can still be numbered in 24 bits.
const RESOLUTION: Counts = Counts([Count(2, MAX_RESOLUTION), Count(3, MAX_RESOLUTION)]);
/// Fields of view whose tangent is neither 0 nor infinite in binary32.
const FIELD_OF_VIEW: Number = Number(from_to(0.001, 179.999).unit("degrees"));
/// Width and height of a picture.
const SIZE: Counts = Counts([Count(1, 16384), Count(1, 16384)]);

/// The scene; its cross-checks are in `checks.rs`.
pub(super) fn scene(at: &mut Object) -> Option<Scene> {
    let common = at.group("material", |at| material(at, &standard()));
    let common = common.unwrap_or_else(|| (standard(), false));
    let on_plane =
        if common.1 { common.0.clone() } else { Material { color: grey(0.7), ..common.0.clone() } };
    let cloth = at.maybe("cloth", |at| cloth(at, &common.0));
    let mut collider = |kind: ColliderKind| {
        at.each(kind.key(), |at| match kind {
            ColliderKind::Plane => Collider::Plane(plane(at, &on_plane)),
            ColliderKind::Sphere => Collider::Sphere(sphere(at, &common.0)),
        })
    };
    let colliders = ColliderKind::ALL.iter().flat_map(|&kind| collider(kind)).collect();
    Some(Scene {
        cloth,
        colliders,
        sim: at.group("sim", sim)?,
        camera: at.group("camera", camera)?,
        light: at.group("light", light)?,
        render: at.group("render", render)?,
    })
}

fn cloth(at: &mut Object, common: &Material) -> Cloth {
    Cloth {
        width: at.required("width", Number(POSITIVE.unit("m"))),
        height: at.required("height", Number(POSITIVE.unit("m"))),
        num_width_points: at.required("num_width_points", SIDE) as usize,
        num_height_points: at.required("num_height_points", SIDE) as usize,
        thickness: at.required("thickness", Number(NOT_NEGATIVE.unit("m"))),
        orientation: at.required("orientation", Coded(ORIENTATIONS)),
        pinned: pins(&at.optional("pinned", Vec::new(), GridPoints)),
        damping: at.required("damping", Number(from_to(0.0, 100.0).unit("%"))),
        density: at.required("density", Number(POSITIVE.unit("kg/m²"))),
        ks: at.required("ks", Number(NOT_NEGATIVE.unit("N/m"))),
        enable_structural: at.required("enable_structural", Flag),
        enable_shearing: at.required("enable_shearing", Flag),
        enable_bending: at.required("enable_bending", Flag),
        material: own_material(at, common),
    }
}

/// Grid points as indices; `checks.rs` reports those that do not lie on the grid.
fn pins(points: &[[i64; 2]]) -> Vec<[usize; 2]> {
    let index = |i: i64| usize::try_from(i).unwrap_or(usize::MAX);
    points.iter().map(|point| point.map(index)).collect()
}

fn sphere(at: &mut Object, common: &Material) -> Sphere {
    Sphere {
        origin: at.required("origin", Vector(ANY.unit("m"))),
        radius: at.required("radius", Number(POSITIVE.unit("m"))),
        friction: at.required("friction", Number(from_to(0.0, 1.0))),
        resolution: at.optional("resolution", [40, 40], RESOLUTION),
        material: own_material(at, common),
    }
}

fn plane(at: &mut Object, common: &Material) -> Plane {
    Plane {
        point: at.required("point", Vector(ANY.unit("m"))),
        normal: at.required("normal", Direction(ANY)),
        friction: at.required("friction", Number(from_to(0.0, 1.0))),
        material: own_material(at, common),
    }
}

fn sim(at: &mut Object) -> Sim {
    Sim {
        fps: at.optional("fps", 90.0, Number(from_to(1e-6, 1e9).unit("frames/s"))),
        steps_per_frame: at.optional("steps_per_frame", 30, Count(1, 1_000_000_000)),
        gravity: at.optional("gravity", Vec3::new(0.0, -9.8, 0.0), Vector(ANY.unit("m/s²"))),
        integrator: at.optional("integrator", Integrator::Verlet, Choice(Integrator::NAMES)),
        iterations: at.optional("iterations", 1, Count(1, 1_000_000)),
        tolerance: at.optional("tolerance", 1e-4, Number(from_to(1e-15, 1.0))),
        precision: at.optional("precision", Precision::F64, Choice(PRECISIONS)),
        start: at.optional("start", Start::Report, Choice(STARTS)),
        damping: at.optional("damping", Damping::PerStep, Choice(DAMPINGS)),
        stretch_limit: at.optional("stretch_limit", Some(0.1), OrNull(Number(NOT_NEGATIVE))),
        stretch_passes: at.optional("stretch_passes", 1, Count(1, 1_000_000)),
        self_collision: at.optional("self_collision", SelfCollision::SameBox, Choice(SELF_COLLISIONS)),
        contact: at.optional("contact", Contact::Report, Choice(CONTACTS)),
    }
}

fn camera(at: &mut Object) -> Camera {
    Camera {
        target: at.optional("target", None, OrNull(Vector(ANY.unit("m")))),
        distance: at.optional("distance", None, OrNull(Number(POSITIVE.unit("m")))),
        polar: at.optional("polar", 90.0, Number(from_to(0.0, 180.0).unit("degrees"))),
        azimuth: at.optional("azimuth", 0.0, Number(ANY.unit("degrees"))),
        hfov: at.optional("hfov", 50.0, FIELD_OF_VIEW),
        vfov: at.optional("vfov", 35.0, FIELD_OF_VIEW),
        near: at.optional("near", 0.01, Number(POSITIVE.unit("m"))),
        far: at.optional("far", 10_000.0, Number(POSITIVE.unit("m"))),
    }
}

fn light(at: &mut Object) -> Light {
    Light {
        position: at.optional("position", Vec3::new(0.5, 2.0, 2.0), Vector(ANY.unit("m"))),
        intensity: at.optional("intensity", grey(3.0), Vector(NOT_NEGATIVE)),
        color: at.optional("color", grey(1.0), Direction(NOT_NEGATIVE)),
    }
}

fn render(at: &mut Object) -> Render {
    Render {
        size: at.optional("size", [1024, 800], SIZE),
        samples: at.optional("samples", 1, Coded(SAMPLES)),
        background: at.optional("background", grey(0.25), Vector(NOT_NEGATIVE)),
        time: at.optional("time", 2.0, Number(from_to(0.0, 1e6).unit("s"))),
        filter: at.optional("filter", Filter::Bilinear, Choice(FILTERS)),
    }
}

/// A material whose keys default to those of `common`, and whether its colour is given.
fn material(at: &mut Object, common: &Material) -> (Material, bool) {
    let material = Material {
        shader: at.optional("shader", common.shader, Choice(Shader::NAMES)),
        color: at.optional("color", common.color, Vector(NOT_NEGATIVE)),
        ka: at.optional("ka", common.ka, Number(NOT_NEGATIVE)),
        kd: at.optional("kd", common.kd, Number(NOT_NEGATIVE)),
        ks: at.optional("ks", common.ks, Number(NOT_NEGATIVE)),
        shininess: at.optional("shininess", common.shininess, Number(NOT_NEGATIVE)),
        km: at.optional("km", common.km, Number(NOT_NEGATIVE)),
        normal_scaling: at.optional("normal_scaling", common.normal_scaling, Number(ANY)),
        height_scaling: at.optional("height_scaling", common.height_scaling, Number(ANY)),
        texture: at.optional("texture", common.texture.clone(), Name),
        height_map: at.optional("height_map", common.height_map.clone(), Name),
        environment: at.optional("environment", common.environment.clone(), Name),
    };
    (material, at.has("color"))
}

/// The material of one object: key by key its own, else the common one.
fn own_material(at: &mut Object, common: &Material) -> Material {
    at.group("material", |at| material(at, common).0).unwrap_or_else(|| common.clone())
}

/// The material of an object about which the file says nothing.
fn standard() -> Material {
    Material {
        shader: Shader::Phong,
        color: grey(1.0),
        ka: 0.1,
        kd: 0.7,
        ks: 1.0,
        shininess: 64.0,
        km: 0.25,
        normal_scaling: 2.0,
        height_scaling: 0.1,
        texture: "texture_1".into(),
        height_map: "texture_2".into(),
        environment: "cube".into(),
    }
}

fn grey(level: f64) -> Vec3 {
    Vec3::repeat(level)
}
