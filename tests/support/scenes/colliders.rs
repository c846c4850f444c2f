//! What the tests know of every kind of collider. The compiler names what is missing for a new one.

use drape::scene::{Collider, ColliderKind, Vec3};
use serde_json::{Value, json};

/// A collider of a kind as a scene file has it, with the keys that it must have.
pub(crate) fn example(kind: ColliderKind) -> Value {
    match kind {
        ColliderKind::Plane => json!({ "point": [0, 0, 0], "normal": [0, 1, 0], "friction": 0 }),
        ColliderKind::Sphere => json!({ "origin": [0, 0, 0], "radius": 1, "friction": 0 }),
        ColliderKind::Cuboid => json!({ "origin": [0, 0, 0], "size": [1, 1, 1], "friction": 0 }),
    }
}

/// How deep a point is inside of a collider, in metres; below 0 outside. The inside of a plane is where its normal
/// does not point.
pub(crate) fn depth(collider: &Collider, x: Vec3) -> f64 {
    match collider {
        Collider::Plane(plane) => -(x - plane.point).dot(&plane.normal.normalize()),
        Collider::Sphere(sphere) => sphere.radius - (x - sphere.origin).norm(),
        Collider::Cuboid(cuboid) => (cuboid.size * 0.5 - (x - cuboid.origin).abs()).min(),
    }
}

/// The same for the collider that a point is deepest in.
pub(crate) fn depth_in_any(colliders: &[Collider], x: Vec3) -> f64 {
    colliders.iter().map(|collider| depth(collider, x)).fold(f64::NEG_INFINITY, f64::max)
}
