//! The five stock scenes, built by hand, for tests of the simulation.

#![allow(dead_code, reason = "each test uses some of these")]

pub(crate) mod colliders;

use drape::scene::{Cloth, Collider, Material, Orientation, Plane, Render, Scene, Sphere, Vec3};

/// Every stock scene by name.
pub(crate) fn stock() -> [(&'static str, Scene); 5] {
    [
        ("pinned2", pinned2()),
        ("pinned4", pinned4()),
        ("sphere", sphere()),
        ("plane", plane()),
        ("selfCollision", self_collision()),
    ]
}

/// A cloth held at two corners of one side.
pub(crate) fn pinned2() -> Scene {
    with_cloth(Cloth { pinned: vec![[0, 0], [49, 0]], ..cloth() })
}

/// A cloth held at its four corners.
pub(crate) fn pinned4() -> Scene {
    with_cloth(Cloth { pinned: vec![[0, 0], [0, 49], [49, 0], [49, 49]], ..cloth() })
}

/// A cloth that falls on a ball.
pub(crate) fn sphere() -> Scene {
    let mut scene = with_cloth(cloth());
    let origin = Vec3::new(0.5, 0.2, 0.5);
    let resolution = [40, 40];
    let ball = Sphere { origin, radius: 0.2, friction: 0.3, resolution, material: material() };
    scene.colliders.push(Collider::Sphere(ball));
    scene
}

/// A cloth that falls flat on the floor.
pub(crate) fn plane() -> Scene {
    let mut scene = with_cloth(cloth());
    add_plane(&mut scene, floor());
    scene
}

/// An upright cloth that falls on itself.
pub(crate) fn self_collision() -> Scene {
    let mut scene = with_cloth(Cloth { orientation: Orientation::Vertical, ..cloth() });
    add_plane(&mut scene, floor());
    scene
}

/// The stock cloth, held nowhere.
pub(crate) fn cloth() -> Cloth {
    Cloth {
        width: 1.0,
        height: 1.0,
        num_width_points: 50,
        num_height_points: 50,
        thickness: 0.0095,
        orientation: Orientation::Horizontal,
        offset: Vec3::zeros(),
        velocity: Vec3::zeros(),
        pinned: Vec::new(),
        damping: 0.2,
        density: 150.0,
        ks: 5000.0,
        enable_structural: true,
        enable_shearing: true,
        enable_bending: true,
        material: material(),
    }
}

/// The stock floor.
pub(crate) fn floor() -> Plane {
    Plane { point: Vec3::zeros(), normal: Vec3::new(0.0, 1.0, 0.0), friction: 0.5, material: material() }
}

/// Adds a plane where a scene file would have it: before the spheres.
pub(crate) fn add_plane(scene: &mut Scene, plane: Plane) {
    scene.colliders.insert(scene.planes().count(), Collider::Plane(plane));
}

/// The only plane of `scene`, or the first.
pub(crate) fn plane_mut(scene: &mut Scene) -> &mut Plane {
    let mut planes = scene.colliders.iter_mut().filter_map(|collider| match collider {
        Collider::Plane(plane) => Some(plane),
        _ => None,
    });
    planes.next().expect("a plane")
}

/// The only ball of `scene`, or the first.
pub(crate) fn ball_mut(scene: &mut Scene) -> &mut Sphere {
    let mut balls = scene.colliders.iter_mut().filter_map(|collider| match collider {
        Collider::Sphere(ball) => Some(ball),
        _ => None,
    });
    balls.next().expect("a ball")
}

/// The stock ball.
pub(crate) fn ball() -> Sphere {
    ball_mut(&mut sphere()).clone()
}

/// A scene of `cloth` and nothing else.
pub(crate) fn with_cloth(cloth: Cloth) -> Scene {
    Scene { cloth: Some(cloth), render: Render { time: 0.0, ..Render::default() }, ..Scene::default() }
}

/// Any material: the simulation does not read it.
pub(crate) fn material() -> Material {
    Material { kd: 1.0, ks: 0.5, shininess: 32.0, km: 0.5, ..Material::default() }
}
